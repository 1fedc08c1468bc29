// Lanes of a register: masks and selection, loads, and stores of the first few. Intrinsics stand
// here where xsimd 8 has nothing (masked stores come with xsimd 14, portable permutes with 13).
#pragma once

#include <utility>

#include "kernels/simd/interleave.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

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
class TwoMasks {
public:
  SIMDBEZIER_INLINE TwoMasks(MaskOf<V> first, MaskOf<V> second) : first_(first), second_(second) {}
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

/// The same, by the fewest instructions where columns are replaced: four vectors by the same lanes.
template <typename V>
class PairSelector : public TwoMasks<V> {
  using TwoMasks<V>::TwoMasks;
};

#if defined(SIMDBEZIER_KERNELS_AVX512)
// This is one load of the pair into all lanes and one masked in-lane permute: half of the work of
// two masked broadcasts, which matters where every sixth sample is on an edge.
template <typename T>
class PairSelector<xsimd::batch<T, SIMDBEZIER_ARCH>> {
  using V = vec<T>;
  using Lanes = typename MaskOf<V>::register_type;

public:
  SIMDBEZIER_INLINE PairSelector(MaskOf<V> first, MaskOf<V> second)
      : lanes_(static_cast<Lanes>(Lanes(first) | Lanes(second))),
        index_(sizeof(T) == 4 ? _mm512_maskz_set1_epi32(__mmask16(second), 1)
                              : _mm512_maskz_set1_epi64(__mmask8(second), 2)) {}
  SIMDBEZIER_INLINE bool worthwhile() const { return true; }
  SIMDBEZIER_INLINE V replace(V inside, const T* pair) const {
    if constexpr (sizeof(T) == 4) {
      double both;
      __builtin_memcpy(&both, pair, sizeof(both));
      const __m512 pairs = _mm512_castpd_ps(_mm512_set1_pd(both));
      return V(_mm512_mask_permutevar_ps(inside, lanes_, pairs, index_));
    } else {
      const __m512d pairs = _mm512_broadcast_f64x2(_mm_loadu_pd(pair));
      return V(_mm512_mask_permutevar_pd(inside, lanes_, pairs, index_));
    }
  }

private:
  Lanes lanes_;
  __m512i index_;
};
#elif defined(SIMDBEZIER_KERNELS_AVX2)
// As on AVX-512: one load serves both edges and two registers. Of doubles it takes two
// instructions, and loses by it. Curves have one register and one value, and keep their masks.
template <>
class PairSelector<vec<float>> {
public:
  SIMDBEZIER_INLINE PairSelector(MaskOf<vec<float>> first, MaskOf<vec<float>> second)
      : lanes_(first | second), index_(_mm256_srli_epi32(_mm256_castps_si256(second), 31)) {}
  SIMDBEZIER_INLINE bool worthwhile() const { return any(lanes_); }
  SIMDBEZIER_INLINE vec<float> replace(vec<float> inside, const float* pair) const {
    double both;
    __builtin_memcpy(&both, pair, sizeof(both));
    const __m256 pairs = _mm256_castpd_ps(_mm256_set1_pd(both));
    return select(lanes_, vec<float>(_mm256_permutevar_ps(pairs, index_)), inside);
  }

private:
  MaskOf<vec<float>> lanes_;
  __m256i index_; ///< which of the pair each lane takes
};
#elif defined(SIMDBEZIER_KERNELS_SIMD128)
// Likewise: one load, and a swizzle that leaves zeros in the other lanes. V8 makes three
// instructions of a selection by a mask, and two of most loads into all lanes.
template <typename T>
class PairSelector<xsimd::batch<T, SIMDBEZIER_ARCH>> {
  using V = vec<T>;

public:
  SIMDBEZIER_INLINE PairSelector(MaskOf<V> first, MaskOf<V> second)
      : bytes_(wasm_v128_or(wasm_v128_not(__builtin_bit_cast(v128_t, first | second)),
                            in_pair(__builtin_bit_cast(v128_t, second)))),
        kept_(wasm_i8x16_shr(bytes_, 7)) {} // clang would select by a comparison
  SIMDBEZIER_INLINE bool worthwhile() const { return !wasm_i8x16_all_true(kept_); }
  SIMDBEZIER_INLINE V replace(V inside, const T* pair) const {
    const v128_t both = sizeof(T) == 4 ? wasm_v128_load64_splat(pair) : wasm_v128_load(pair);
    const v128_t others = wasm_v128_and(__builtin_bit_cast(v128_t, inside), kept_);
    return __builtin_bit_cast(V, wasm_v128_or(others, wasm_i8x16_swizzle(both, bytes_)));
  }

private:
  /// Returns which bytes of the pair each lane takes.
  static SIMDBEZIER_INLINE v128_t in_pair(v128_t second) {
    const v128_t first =
        sizeof(T) == 4 ? wasm_u32x4_splat(0x03020100) : wasm_u64x2_splat(0x0706050403020100);
    return wasm_i8x16_add(first, wasm_v128_and(second, wasm_i8x16_splat(sizeof(T))));
  }

  v128_t bytes_; ///< where lanes come from, or negative
  v128_t kept_;
};
#endif

/// What replaces the ends of curves.
#if defined(SIMDBEZIER_KERNELS_AVX2)
template <typename V>
using EndSelector = TwoMasks<V>;
#else
template <typename V>
using EndSelector = PairSelector<V>;
#endif

#if defined(SIMDBEZIER_KERNELS_SSE2)
/// Returns a bit for each lane.
SIMDBEZIER_INLINE unsigned lane_bits(MaskOf<vec<float>> mask) {
  return static_cast<unsigned>(_mm_movemask_ps(mask));
}
SIMDBEZIER_INLINE unsigned lane_bits(MaskOf<vec<double>> mask) {
  return static_cast<unsigned>(_mm_movemask_pd(mask));
}

template <std::size_t kLane, typename V>
SIMDBEZIER_INLINE V with_lane(V v, const ScalarOf<V>* value) {
  Bits<V> bits = __builtin_bit_cast(Bits<V>, v);
  bits[kLane] = *value;
  return __builtin_bit_cast(V, bits);
}
#endif

/// Returns the power of two at or below |x|; 0 for a denormal x, infinity where x is not finite.
template <typename V>
SIMDBEZIER_INLINE V power_of_two_below(V x) {
  if constexpr (!kIsScalar<V>) {
    return x & V(static_cast<ScalarOf<V>>(__builtin_inf())); // whose bits are the exponent's
  } else if constexpr (sizeof(V) == sizeof(float)) {
    return __builtin_bit_cast(float, __builtin_bit_cast(unsigned, x) & 0xffU << 23);
  } else {
    return __builtin_bit_cast(double, __builtin_bit_cast(unsigned long long, x) & 0x7ffULL << 52);
  }
}

// Memory -----------------------------------------------------------------------------------------

template <typename V>
SIMDBEZIER_INLINE V load_vector(const ScalarOf<V>* from) {
  if constexpr (kIsScalar<V>) {
    return *from;
  } else {
    return V::load_unaligned(from);
  }
}

/// Returns at(i) in lane i, put together in registers: a reload of what single stores have put
/// together would wait for all of them.
template <typename V, typename At>
SIMDBEZIER_INLINE V from_lanes(const At& at) {
  return [&]<std::size_t... i>(std::index_sequence<i...>) SIMDBEZIER_INLINE_LAMBDA {
    return __builtin_bit_cast(V, Bits<V>{at(i)...});
  }
  (std::make_index_sequence<kLanes<V>>());
}

template <typename V>
SIMDBEZIER_INLINE void store_vector(ScalarOf<V>* to, V value) {
  if constexpr (kIsScalar<V>) {
    *to = value;
  } else {
    value.store_unaligned(to);
  }
}

/// Whether one register is one cache line: only then may a kernel stream by itself. Half a line
/// that is streamed alone costs three times as much.
template <typename V>
inline constexpr bool kLineWide = kLanes<V> * sizeof(ScalarOf<V>) == 64;

/// Stores a register past the caches; `to` is at a line's start. The call ends with
/// streaming_fence().
template <typename V>
SIMDBEZIER_INLINE void store_streaming(ScalarOf<V>* to, V value) {
  store_any<kLineWide<V>>(to, __builtin_bit_cast(Bits<V>, value));
}

/// Stores past the caches where a call streams, and through them elsewhere. Registers of less than
/// a line never stream.
template <typename V>
SIMDBEZIER_INLINE void store_line(ScalarOf<V>* to, V value, bool streams) {
  if constexpr (kLineWide<V>) {
    if (streams) {
      store_streaming(to, value);
      return;
    }
  }
  store_vector(to, value);
}

/// Returns entry i, below 8, of one table in the lanes of the mask, and of another one in the rest.
/// Either table has 8 values that can be read.
template <typename V>
SIMDBEZIER_INLINE V select_entry(MaskOf<V> first, const ScalarOf<V>* a, const ScalarOf<V>* b,
                                 std::size_t i) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  // Both tables are in one register, of which each entry is one permutation.
  if constexpr (std::is_same_v<V, vec<float>>) {
    const int entry = static_cast<int>(i);
    const __m512i lane = _mm512_mask_set1_epi32(_mm512_set1_epi32(8 + entry), first, entry);
    return V(
        _mm512_permutexvar_ps(lane, _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(a)),
                                                       _mm256_loadu_ps(b), 1)));
  }
#endif
  return select_where<V>(first, broadcast<V>(a[i]), broadcast<V>(b[i]));
}

#if defined(SIMDBEZIER_KERNELS_AVX512)
SIMDBEZIER_INLINE void masked_store(float* to, vec<float> value, std::size_t n) {
  _mm512_mask_storeu_ps(to, static_cast<__mmask16>((1U << n) - 1U), value);
}
SIMDBEZIER_INLINE void masked_store(double* to, vec<double> value, std::size_t n) {
  _mm512_mask_storeu_pd(to, static_cast<__mmask8>((1U << n) - 1U), value);
}
#elif defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_SSE2)
// This stores halves: on some processors vmaskmovps to memory costs as much as twenty stores.
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
