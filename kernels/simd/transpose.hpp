// Turns arrays of structures into registers whose lanes are structures, and back, in blocks of 8
// values. Arithmetic is in double; memory holds float or double. Shuffles inside of 128 bits are
// nearly free where those across are not, so 4x4 blocks of floats are turned in place and the
// halves of registers are joined on their way from or to memory.
#pragma once

#include "kernels/simd/structures_across.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Doubles whose lanes are structures (patches).
using Wide = vec<double>;
inline constexpr std::size_t kWideLanes = kLanes<Wide>;
inline constexpr std::size_t kTransposed = 8;

// Floats as doubles, and doubles rounded to floats; of the first lanes on SSE2.
#if defined(SIMDBEZIER_KERNELS_AVX512)
SIMDBEZIER_INLINE Wide widened(__m256 x) { return Wide(_mm512_cvtps_pd(x)); }
SIMDBEZIER_INLINE __m256 narrowed(Wide x) { return _mm512_cvtpd_ps(x); }
#elif defined(SIMDBEZIER_KERNELS_AVX2)
SIMDBEZIER_INLINE Wide widened(__m128 x) { return Wide(_mm256_cvtps_pd(x)); }
SIMDBEZIER_INLINE __m128 narrowed(Wide x) { return _mm256_cvtpd_ps(x); }
#elif defined(SIMDBEZIER_KERNELS_SSE2)
SIMDBEZIER_INLINE Wide widened(__m128 x) { return Wide(_mm_cvtps_pd(x)); }
SIMDBEZIER_INLINE __m128 narrowed(Wide x) { return _mm_cvtpd_ps(x); }
#elif defined(SIMDBEZIER_KERNELS_NEON64)
SIMDBEZIER_INLINE Wide widened(float32x2_t x) { return Wide(vcvt_f64_f32(x)); }
SIMDBEZIER_INLINE float32x2_t narrowed(Wide x) { return vcvt_f32_f64(x); }
#else
SIMDBEZIER_INLINE Wide widened(float x) { return static_cast<double>(x); }
SIMDBEZIER_INLINE float narrowed(Wide x) { return static_cast<float>(x); }
#endif

/// Returns x rounded to T.
template <typename T>
SIMDBEZIER_INLINE Wide rounded_to(Wide x) {
  if constexpr (sizeof(T) == sizeof(double)) {
    return x;
  } else {
    return widened(narrowed(x));
  }
}

/// Returns x without its 27 lowest bits: two such values have an exact product.
SIMDBEZIER_INLINE Wide leading_bits(Wide x) {
  constexpr unsigned long long kKept = ~0ULL << 27;
#if defined(SIMDBEZIER_KERNELS_SCALAR)
  return __builtin_bit_cast(double, __builtin_bit_cast(unsigned long long, x) & kKept);
#else
  return x & Wide(__builtin_bit_cast(double, kKept));
#endif
}

SIMDBEZIER_INLINE Wide magnitude(Wide x) {
#if defined(SIMDBEZIER_KERNELS_SCALAR)
  return __builtin_fabs(x);
#else
  return abs(x);
#endif
}

/// Loads from[p][at] to lane p. Lanes do not pass through memory: a register that is loaded from
/// parts which have just been stored waits for all of them.
template <typename T>
SIMDBEZIER_INLINE Wide load_each(const T* const from[kWideLanes], std::ptrdiff_t at) {
  return [&]<std::size_t... p>(std::index_sequence<p...>) SIMDBEZIER_INLINE_LAMBDA {
    return __builtin_bit_cast(Wide, Bits<Wide>{static_cast<double>(from[p][at])...});
  }
  (std::make_index_sequence<kWideLanes>());
}

/// Loads values[k], lane p = from[p * stride + k].
SIMDBEZIER_INLINE void load_transposed(const float* from, std::ptrdiff_t stride,
                                       Wide values[kTransposed]) {
#if defined(SIMDBEZIER_KERNELS_AVX512) || defined(SIMDBEZIER_KERNELS_AVX2)
  for (int k = 0; k < 8; k += 4) {
    decltype(narrowed(Wide())) r[4];
    for (int p = 0; p < 4; ++p) {
      const float* const at = from + k + p * stride;
#if defined(SIMDBEZIER_KERNELS_AVX512)
      r[p] = _mm256_loadu2_m128(at + 4 * stride, at);
#else
      r[p] = _mm_loadu_ps(at);
#endif
    }
    transpose_quads<float>(r);
    for (int i = 0; i < 4; ++i) {
      values[k + i] = widened(r[i]);
    }
  }
#elif defined(SIMDBEZIER_KERNELS_SSE2)
  for (int k = 0; k < 8; k += 4) {
    const __m128 a = _mm_loadu_ps(from + k);
    const __m128 b = _mm_loadu_ps(from + k + stride);
    const __m128 low = _mm_unpacklo_ps(a, b);
    const __m128 high = _mm_unpackhi_ps(a, b);
    values[k] = widened(low);
    values[k + 1] = widened(_mm_movehl_ps(low, low));
    values[k + 2] = widened(high);
    values[k + 3] = widened(_mm_movehl_ps(high, high));
  }
#else
  const float* place[kWideLanes];
  for (std::size_t p = 0; p < kWideLanes; ++p) {
    place[p] = from + static_cast<std::ptrdiff_t>(p) * stride;
  }
  for (std::size_t k = 0; k < kTransposed; ++k) {
    values[k] = load_each(place, static_cast<std::ptrdiff_t>(k));
  }
#endif
}

SIMDBEZIER_INLINE void load_transposed(const double* from, std::ptrdiff_t stride,
                                       Wide values[kTransposed]) {
  load_values_across<kTransposed>(from, stride, values);
}

/// Stores to[p * stride + k] = lane p of values[k], rounded, with +0 for -0. streams says that rows
/// that are lines go past the caches.
SIMDBEZIER_INLINE void store_transposed(const Wide values[kTransposed], float* to,
                                        std::ptrdiff_t stride, bool /*streams*/ = false) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  __m512 r[4]; // values k and k + 4, four places twice
  for (int k = 0; k < 4; ++k) {
    r[k] =
        _mm512_insertf32x8(_mm512_castps256_ps512(narrowed(values[k])), narrowed(values[k + 4]), 1);
  }
  transpose_quads<float>(r);
  for (int p = 0; p < 4; ++p) { // 128 bits: place p, p + 4, then their values 4 to 7
    const __m512 row = _mm512_add_ps(_mm512_shuffle_f32x4(r[p], r[p], 0xd8), _mm512_setzero_ps());
    _mm256_storeu_ps(to + p * stride, _mm512_castps512_ps256(row));
    _mm256_storeu_ps(to + (p + 4) * stride, _mm512_extractf32x8_ps(row, 1));
  }
#elif defined(SIMDBEZIER_KERNELS_AVX2)
  __m256 r[4];
  for (int k = 0; k < 4; ++k) {
    r[k] = _mm256_insertf128_ps(_mm256_castps128_ps256(narrowed(values[k])),
                                narrowed(values[k + 4]), 1);
  }
  transpose_quads<float>(r);
  for (int p = 0; p < 4; ++p) {
    _mm256_storeu_ps(to + p * stride, _mm256_add_ps(r[p], _mm256_setzero_ps()));
  }
#elif defined(SIMDBEZIER_KERNELS_SSE2)
  for (int k = 0; k < 8; k += 4) {
    const __m128 a = _mm_movelh_ps(narrowed(values[k]), narrowed(values[k + 1]));
    const __m128 b = _mm_movelh_ps(narrowed(values[k + 2]), narrowed(values[k + 3]));
    const __m128 zero = _mm_setzero_ps();
    _mm_storeu_ps(to + k, _mm_add_ps(_mm_shuffle_ps(a, b, 0x88), zero));
    _mm_storeu_ps(to + k + stride, _mm_add_ps(_mm_shuffle_ps(a, b, 0xdd), zero));
  }
#else
  alignas(64) double lanes[kWideLanes];
  for (std::size_t k = 0; k < kTransposed; ++k) {
    store_vector<Wide>(lanes, values[k]);
    for (std::size_t p = 0; p < kWideLanes; ++p) {
      to[static_cast<std::ptrdiff_t>(p) * stride + static_cast<std::ptrdiff_t>(k)] =
          static_cast<float>(lanes[p]) + 0.0F;
    }
  }
#endif
}

SIMDBEZIER_INLINE void store_transposed(const Wide values[kTransposed], double* to,
                                        std::ptrdiff_t stride, bool streams = false) {
  Wide sum[kTransposed];
  for (std::size_t k = 0; k < kTransposed; ++k) {
    sum[k] = values[k] + Wide(0.0);
  }
  store_values_across<kTransposed>(sum, to, stride, streams);
}

/// Stores two blocks side by side. 16 floats of one place are a cache line.
template <typename T>
SIMDBEZIER_INLINE void store_transposed_16(const Wide values[2 * kTransposed], T* to,
                                           std::ptrdiff_t stride, bool streams) {
  store_transposed(values, to, stride, streams);
  store_transposed(values + kTransposed, to + kTransposed, stride, streams);
}

#if defined(SIMDBEZIER_KERNELS_AVX512)
template <>
SIMDBEZIER_INLINE void store_transposed_16<float>(const Wide values[2 * kTransposed], float* to,
                                                  std::ptrdiff_t stride, bool streams) {
  __m512 r[8]; // [i]: values i and i + 4, [4 + i]: values 8 + i and 12 + i; four places twice
  for (int i = 0; i < 8; ++i) {
    const int k = i + (i & 4);
    r[i] =
        _mm512_insertf32x8(_mm512_castps256_ps512(narrowed(values[k])), narrowed(values[k + 4]), 1);
  }
  transpose_quads<float>(r);
  transpose_quads<float>(r + 4);
  const __m512 zero = _mm512_setzero_ps();
  for (int p = 0; p < 4; ++p) {
    const __m512 first = _mm512_shuffle_f32x4(r[p], r[4 + p], 0x88);
    const __m512 second = _mm512_shuffle_f32x4(r[p], r[4 + p], 0xdd);
    store_line<vec<float>>(to + p * stride, _mm512_add_ps(first, zero), streams);
    store_line<vec<float>>(to + (p + 4) * stride, _mm512_add_ps(second, zero), streams);
  }
}
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
