// The vector type of the instruction set being compiled, its arithmetic, and every xsimd quirk of
// the project; lanes.hpp has the rest of what kernels are written in.
//
// A kernel is written over a value type V, which is vec<T> (one register) or T itself (one sample,
// same operations, same bits). Only this folder knows xsimd and raw intrinsics.
//   - xsimd::fma on AVX-512 is not fused before xsimd 11, so the intrinsic is called directly;
//   - sqrt and division of floats on NEON are estimates in xsimd 8, so the instructions stand here;
//   - argument-dependent lookup finds xsimd's load and store, which want alignment: ours have names
//     of their own;
//   - operators on batches may be contracted by the compiler, hence -ffp-contract=off and madd().
#pragma once

#include <cstddef>

// Headers that toolchains for WebAssembly bring along write SSE2's intrinsics as those of simd128.
#if defined(SIMDBEZIER_KERNELS_SIMD128)
#define SIMDBEZIER_KERNELS_SSE2
#endif
#if !defined(SIMDBEZIER_KERNELS_SCALAR)
#include <xsimd/xsimd.hpp>
#endif
#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__wasm__)
#include <wasm_simd128.h>
#endif

#define SIMDBEZIER_PASTE_(a, b) a##b
#define SIMDBEZIER_PASTE(a, b) SIMDBEZIER_PASTE_(a, b)
/// Every symbol of this object lives in here, so that the linker cannot merge it with another's.
#define SIMDBEZIER_ISA_NAMESPACE SIMDBEZIER_PASTE(isa_, SIMDBEZIER_ISA)

// Three kinds of functions. A KERNEL is compiled as a function of its own, with all its PARTs in
// it. What is INLINE goes into whatever calls it at once: formulas, and what takes or is a
// callable, so that captured variables are in registers before the PARTs come together. g++
// optimises a function that is always inlined once for each level above it, which would be half of
// the compile time if PARTs were; clang does not, and its flatten reaches one level only.
#if defined(__clang__)
#define SIMDBEZIER_KERNEL __attribute__((noinline))
#define SIMDBEZIER_PART inline __attribute__((always_inline))
#else
#define SIMDBEZIER_KERNEL __attribute__((noinline, flatten))
#define SIMDBEZIER_PART inline
#endif
#define SIMDBEZIER_INLINE inline __attribute__((always_inline))
/// Lambdas say it so: [&](int a) SIMDBEZIER_INLINE_LAMBDA { … }
#define SIMDBEZIER_INLINE_LAMBDA __attribute__((always_inline))
/// A kernel that seldom runs: small rather than fast, and out of the way of the others.
#define SIMDBEZIER_RARE SIMDBEZIER_KERNEL __attribute__((cold))

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

// These are two columns of the table in cmake/isa.cmake.

/// Whether a multiplication and an addition have one rounding.
inline constexpr bool kFused = SIMDBEZIER_FUSES != 0;

/// Whether this is one of the instruction sets that hardly any machine depends on. They are there
/// to be right everywhere, and get one kernel for each purpose: no special code for a size, a
/// degree or an arrangement that another kernel can handle as well.
inline constexpr bool kCompact = SIMDBEZIER_COMPACT == 1;

/// Whether that holds for patches that are not bicubic or not points in space.
inline constexpr bool kCompactShapes = SIMDBEZIER_COMPACT != 0;

/// Whether registers are those of SSE2, of which a row of few columns has many.
#if defined(SIMDBEZIER_KERNELS_SSE2)
inline constexpr bool kSse2 = true;
#else
inline constexpr bool kSse2 = false;
#endif
/// Whether these are WebAssembly's, which V8 compiles: it has fewer registers left than SSE2, and
/// takes two or three instructions for some that are one.
#if defined(SIMDBEZIER_KERNELS_SIMD128)
inline constexpr bool kSimd128 = true;
#else
inline constexpr bool kSimd128 = false;
#endif

// Which V holds what -----------------------------------------------------------------------------

/// Of a single value, unless V is a register.
template <typename V>
struct Traits {
  using Scalar = V;
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

/// Returns a * b + c: rounded once in the FMA class, after each operation elsewhere. Every product
/// that is added to something goes through here.
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

/// Returns a * b - c, as madd() does. (xsimd 8.1 negates by subtracting from +0, which does not
/// make -0 of +0.)
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

/// Returns the correctly rounded root, on every instruction set.
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

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
