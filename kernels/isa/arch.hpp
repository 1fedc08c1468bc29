// The vector type of the instruction set being compiled, and every xsimd quirk of the project.
//
// A kernel is written over a value type V, which is vec<T> (one register) or T itself (one sample,
// same operations, same bits). Only this file knows xsimd's versions and raw intrinsics.
//   - xsimd::fma on AVX-512 is not fused before xsimd 11, so the intrinsic is called directly;
//   - sqrt and division of floats on NEON are estimates in xsimd 8, not the correctly rounded
//   values;
//   - masked stores exist only from xsimd 14;
//   - argument-dependent lookup finds xsimd's load and store, which want alignment: ours have names
//     of their own;
//   - operators on batches may be contracted by the compiler, hence -ffp-contract=off and madd().
#pragma once

#include <cstddef>

#if !defined(SIMDBEZIER_KERNELS_SCALAR)
#include <xsimd/xsimd.hpp>
#endif
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#define SIMDBEZIER_PASTE_(a, b) a##b
#define SIMDBEZIER_PASTE(a, b) SIMDBEZIER_PASTE_(a, b)
/// Every symbol of this object lives in here, so that the linker cannot merge it with another's.
#define SIMDBEZIER_ISA_NAMESPACE SIMDBEZIER_PASTE(isa_, SIMDBEZIER_ISA)

#define SIMDBEZIER_INLINE inline __attribute__((always_inline))

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_AVX512) ||                      \
    defined(SIMDBEZIER_KERNELS_NEON64)
inline constexpr bool kFused = true;
#else
inline constexpr bool kFused = false;
#endif

// Which V holds what -----------------------------------------------------------------------------

template <typename V>
struct Traits;

template <>
struct Traits<float> {
  using Scalar = float;
  using Mask = bool;
  static constexpr std::size_t kLanes = 1;
};
template <>
struct Traits<double> {
  using Scalar = double;
  using Mask = bool;
  static constexpr std::size_t kLanes = 1;
};

#if defined(SIMDBEZIER_KERNELS_SCALAR)
template <typename T>
using vec = T;
#else
template <typename T>
using vec = xsimd::batch<T, SIMDBEZIER_ARCH>;

template <typename T>
struct Traits<xsimd::batch<T, SIMDBEZIER_ARCH>> {
  using Scalar = T;
  using Mask = xsimd::batch_bool<T, SIMDBEZIER_ARCH>;
  static constexpr std::size_t kLanes = xsimd::batch<T, SIMDBEZIER_ARCH>::size;
};
#endif

template <typename V>
using ScalarOf = typename Traits<V>::Scalar;
template <typename V>
using MaskOf = typename Traits<V>::Mask;
template <typename V>
inline constexpr std::size_t kLanes = Traits<V>::kLanes;
template <typename V>
inline constexpr bool kIsScalar = kLanes<V> == 1;

// Arithmetic -------------------------------------------------------------------------------------

template <typename V>
SIMDBEZIER_INLINE V broadcast(ScalarOf<V> value) {
  return V(value);
}

SIMDBEZIER_INLINE float scalar_fma(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
SIMDBEZIER_INLINE double scalar_fma(double a, double b, double c) { return __builtin_fma(a, b, c); }

#if defined(SIMDBEZIER_KERNELS_AVX512)
SIMDBEZIER_INLINE vec<float> vector_fma(vec<float> a, vec<float> b, vec<float> c) {
  return vec<float>(_mm512_fmadd_ps(a, b, c));
}
SIMDBEZIER_INLINE vec<double> vector_fma(vec<double> a, vec<double> b, vec<double> c) {
  return vec<double>(_mm512_fmadd_pd(a, b, c));
}
SIMDBEZIER_INLINE vec<float> vector_fms(vec<float> a, vec<float> b, vec<float> c) {
  return vec<float>(_mm512_fmsub_ps(a, b, c));
}
SIMDBEZIER_INLINE vec<double> vector_fms(vec<double> a, vec<double> b, vec<double> c) {
  return vec<double>(_mm512_fmsub_pd(a, b, c));
}
#elif defined(SIMDBEZIER_KERNELS_NEON64)
template <typename V>
SIMDBEZIER_INLINE V vector_fma(V a, V b, V c) {
  return xsimd::fma(a, b, c);
}
SIMDBEZIER_INLINE vec<float> vector_fms(vec<float> a, vec<float> b, vec<float> c) {
  return xsimd::fma(a, b, vec<float>(vnegq_f32(c)));
}
SIMDBEZIER_INLINE vec<double> vector_fms(vec<double> a, vec<double> b, vec<double> c) {
  return xsimd::fma(a, b, vec<double>(vnegq_f64(c)));
}
#elif !defined(SIMDBEZIER_KERNELS_SCALAR)
template <typename V>
SIMDBEZIER_INLINE V vector_fma(V a, V b, V c) {
  return xsimd::fma(a, b, c);
}
template <typename V>
SIMDBEZIER_INLINE V vector_fms(V a, V b, V c) {
  return xsimd::fms(a, b, c);
}
#endif

/// a * b + c: rounded once in the FMA class, after each operation elsewhere. Every product that is
/// added to something goes through here.
template <typename V>
SIMDBEZIER_INLINE V madd(V a, V b, V c) {
  if constexpr (!kFused) {
    return a * b + c;
  } else if constexpr (kIsScalar<V>) {
    return scalar_fma(a, b, c);
  } else {
    return vector_fma(a, b, c);
  }
}

/// a * b - c, as madd. (xsimd 8.1 negates by subtracting from +0, which turns +0 into +0.)
template <typename V>
SIMDBEZIER_INLINE V msub(V a, V b, V c) {
  if constexpr (!kFused) {
    return a * b - c;
  } else if constexpr (kIsScalar<V>) {
    return scalar_fma(a, b, -c);
  } else {
    return vector_fms(a, b, c);
  }
}

#if defined(SIMDBEZIER_KERNELS_NEON64)
SIMDBEZIER_INLINE vec<float> vector_sqrt(vec<float> a) { return vec<float>(vsqrtq_f32(a)); }
SIMDBEZIER_INLINE vec<double> vector_sqrt(vec<double> a) { return vec<double>(vsqrtq_f64(a)); }
SIMDBEZIER_INLINE vec<float> vector_divide(vec<float> a, vec<float> b) {
  return vec<float>(vdivq_f32(a, b));
}
SIMDBEZIER_INLINE vec<double> vector_divide(vec<double> a, vec<double> b) {
  return vec<double>(vdivq_f64(a, b));
}
#elif !defined(SIMDBEZIER_KERNELS_SCALAR)
template <typename V>
SIMDBEZIER_INLINE V vector_sqrt(V a) {
  return sqrt(a);
}
template <typename V>
SIMDBEZIER_INLINE V vector_divide(V a, V b) {
  return a / b;
}
#endif

/// Correctly rounded, on every instruction set.
template <typename V>
SIMDBEZIER_INLINE V square_root(V a) {
  if constexpr (!kIsScalar<V>) {
    return vector_sqrt(a);
  } else if constexpr (sizeof(V) == sizeof(float)) {
    return __builtin_sqrtf(a);
  } else {
    return __builtin_sqrt(a);
  }
}

template <typename V>
SIMDBEZIER_INLINE V divide(V a, V b) {
  if constexpr (kIsScalar<V>) {
    return a / b;
  } else {
    return vector_divide(a, b);
  }
}

// Masks ------------------------------------------------------------------------------------------

template <typename V>
SIMDBEZIER_INLINE V select_where(MaskOf<V> mask, V yes, V no) {
  if constexpr (kIsScalar<V>) {
    return mask ? yes : no;
  } else {
    return select(mask, yes, no);
  }
}

template <typename V>
SIMDBEZIER_INLINE bool any_of(MaskOf<V> mask) {
  if constexpr (kIsScalar<V>) {
    return mask;
  } else {
    return any(mask);
  }
}

template <typename V>
SIMDBEZIER_INLINE bool all_of(MaskOf<V> mask) {
  if constexpr (kIsScalar<V>) {
    return mask;
  } else {
    return all(mask);
  }
}

/// Replaces the lanes of a vector that lie on one of two edges by that edge's value. The values
/// stand side by side in memory: pair[0] goes to the lanes of `first`, pair[1] to those of
/// `second`.
template <typename V>
class PairSelector {
public:
  SIMDBEZIER_INLINE PairSelector(MaskOf<V> first, MaskOf<V> second)
      : first_(first), second_(second) {}
  /// Whether replace() can change anything; true where finding out costs more than replacing.
  SIMDBEZIER_INLINE bool worthwhile() const { return any_of<V>(first_ | second_); }
  SIMDBEZIER_INLINE V replace(V inside, const ScalarOf<V>* pair) const {
    return select_where<V>(first_, broadcast<V>(pair[0]),
                           select_where<V>(second_, broadcast<V>(pair[1]), inside));
  }

private:
  MaskOf<V> first_;
  MaskOf<V> second_;
};

#if defined(SIMDBEZIER_KERNELS_AVX512)
// One load of the pair into all lanes and one masked in-lane permute: half of the work of two
// masked broadcasts, which matters where every sixth sample is on an edge.
template <>
class PairSelector<vec<float>> {
public:
  SIMDBEZIER_INLINE PairSelector(MaskOf<vec<float>> first, MaskOf<vec<float>> second)
      : lanes_(static_cast<__mmask16>(__mmask16(first) | __mmask16(second))),
        index_(_mm512_maskz_set1_epi32(__mmask16(second), 1)) {}
  SIMDBEZIER_INLINE bool worthwhile() const { return true; }
  SIMDBEZIER_INLINE vec<float> replace(vec<float> inside, const float* pair) const {
    double both;
    __builtin_memcpy(&both, pair, sizeof(both));
    const __m512 pairs = _mm512_castpd_ps(_mm512_set1_pd(both));
    return vec<float>(_mm512_mask_permutevar_ps(inside, lanes_, pairs, index_));
  }

private:
  __mmask16 lanes_;
  __m512i index_;
};

template <>
class PairSelector<vec<double>> {
public:
  SIMDBEZIER_INLINE PairSelector(MaskOf<vec<double>> first, MaskOf<vec<double>> second)
      : lanes_(static_cast<__mmask8>(__mmask8(first) | __mmask8(second))),
        index_(_mm512_maskz_set1_epi64(__mmask8(second), 2)) {}
  SIMDBEZIER_INLINE bool worthwhile() const { return true; }
  SIMDBEZIER_INLINE vec<double> replace(vec<double> inside, const double* pair) const {
    const __m512d pairs = _mm512_broadcast_f64x2(_mm_loadu_pd(pair));
    return vec<double>(_mm512_mask_permutevar_pd(inside, lanes_, pairs, index_));
  }

private:
  __mmask8 lanes_;
  __m512i index_;
};
#endif

// Memory -----------------------------------------------------------------------------------------

template <typename V>
SIMDBEZIER_INLINE V load_vector(const ScalarOf<V>* from) {
  if constexpr (kIsScalar<V>) {
    return *from;
  } else {
    return V::load_unaligned(from);
  }
}

template <typename V>
SIMDBEZIER_INLINE void store_vector(ScalarOf<V>* to, V value) {
  if constexpr (kIsScalar<V>) {
    *to = value;
  } else {
    value.store_unaligned(to);
  }
}

#if defined(SIMDBEZIER_KERNELS_AVX512)
SIMDBEZIER_INLINE void masked_store(float* to, vec<float> value, std::size_t n) {
  _mm512_mask_storeu_ps(to, static_cast<__mmask16>((1U << n) - 1U), value);
}
SIMDBEZIER_INLINE void masked_store(double* to, vec<double> value, std::size_t n) {
  _mm512_mask_storeu_pd(to, static_cast<__mmask8>((1U << n) - 1U), value);
}
#elif defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_SSE2)
// In halves: on some processors vmaskmovps to memory costs as much as twenty stores.
SIMDBEZIER_INLINE void store_first_of_128(float* to, __m128 value, std::size_t n) {
  if ((n & 2) != 0) {
    _mm_storel_pi(reinterpret_cast<__m64*>(to), value);
    value = _mm_movehl_ps(value, value);
    to += 2;
  }
  if ((n & 1) != 0) {
    _mm_store_ss(to, value);
  }
}
#if defined(SIMDBEZIER_KERNELS_AVX2)
SIMDBEZIER_INLINE void masked_store(float* to, vec<float> value, std::size_t n) {
  __m128 half = _mm256_castps256_ps128(value);
  if ((n & 4) != 0) {
    _mm_storeu_ps(to, half);
    half = _mm256_extractf128_ps(value, 1);
    to += 4;
  }
  store_first_of_128(to, half, n);
}
SIMDBEZIER_INLINE void masked_store(double* to, vec<double> value, std::size_t n) {
  __m128d half = _mm256_castpd256_pd128(value);
  if ((n & 2) != 0) {
    _mm_storeu_pd(to, half);
    half = _mm256_extractf128_pd(value, 1);
    to += 2;
  }
  if ((n & 1) != 0) {
    _mm_store_sd(to, half);
  }
}
#else
SIMDBEZIER_INLINE void masked_store(float* to, vec<float> value, std::size_t n) {
  store_first_of_128(to, value, n);
}
SIMDBEZIER_INLINE void masked_store(double* to, vec<double> value, std::size_t) {
  _mm_store_sd(to, value); // of two lanes, one
}
#endif
#else
template <typename V>
SIMDBEZIER_INLINE void masked_store(ScalarOf<V>* to, V value, std::size_t n) {
  alignas(64) ScalarOf<V> lanes[kLanes<V>];
  store_vector(lanes, value);
  for (std::size_t i = 0; i < n; ++i) {
    to[i] = lanes[i];
  }
}
#endif

/// Stores the first n lanes, 1 <= n < lanes (n = 1 where there is one lane); touches nothing
/// behind them.
template <typename V>
SIMDBEZIER_INLINE void store_first(ScalarOf<V>* to, V value, std::size_t n) {
  if constexpr (kIsScalar<V>) {
    *to = value;
  } else {
    masked_store(to, value, n);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
