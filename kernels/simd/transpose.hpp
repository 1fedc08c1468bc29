// Turns arrays of structures into registers whose lanes are structures, and back, in blocks of 8
// values. Arithmetic is in double; memory holds float or double. Shuffles inside of 128 bits are
// nearly free where those across are not, so 4x4 blocks of floats are turned in place and the
// halves of registers are joined on their way from or to memory.
#pragma once

#include "kernels/simd/lanes.hpp"
#include "kernels/simd/quad_transpose.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Doubles whose lanes are structures (patches).
using Wide = vec<double>;
inline constexpr std::size_t kWideLanes = kLanes<Wide>;
inline constexpr std::size_t kTransposed = 8;

/// Returns x rounded to T.
template <typename T>
SIMDBEZIER_INLINE Wide rounded_to(Wide x) {
  if constexpr (sizeof(T) == sizeof(double)) {
    return x;
  } else {
#if defined(SIMDBEZIER_KERNELS_AVX512)
    return Wide(_mm512_cvtps_pd(_mm512_cvtpd_ps(x)));
#elif defined(SIMDBEZIER_KERNELS_AVX2)
    return Wide(_mm256_cvtps_pd(_mm256_cvtpd_ps(x)));
#elif defined(SIMDBEZIER_KERNELS_SSE2)
    return Wide(_mm_cvtps_pd(_mm_cvtpd_ps(x)));
#elif defined(SIMDBEZIER_KERNELS_NEON64)
    return Wide(vcvt_f64_f32(vcvt_f32_f64(x)));
#else
    alignas(64) double lanes[kWideLanes];
    store_vector<Wide>(lanes, x);
    for (std::size_t p = 0; p < kWideLanes; ++p) {
      lanes[p] = static_cast<double>(static_cast<float>(lanes[p]));
    }
    return load_vector<Wide>(lanes);
#endif
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

#if defined(SIMDBEZIER_KERNELS_AVX512)
SIMDBEZIER_INLINE void turn_8x8(__m512d m[8]) {
  __m512d pair[8]; // [2i]: even columns of rows 2i and 2i+1, [2i+1]: odd ones
  for (int i = 0; i < 8; i += 2) {
    pair[i] = _mm512_unpacklo_pd(m[i], m[i + 1]);
    pair[i + 1] = _mm512_unpackhi_pd(m[i], m[i + 1]);
  }
  for (int odd = 0; odd < 2; ++odd) {
    const __m512d a0 = _mm512_shuffle_f64x2(pair[odd], pair[2 + odd], 0x88);
    const __m512d a1 = _mm512_shuffle_f64x2(pair[odd], pair[2 + odd], 0xdd);
    const __m512d b0 = _mm512_shuffle_f64x2(pair[4 + odd], pair[6 + odd], 0x88);
    const __m512d b1 = _mm512_shuffle_f64x2(pair[4 + odd], pair[6 + odd], 0xdd);
    m[odd] = _mm512_shuffle_f64x2(a0, b0, 0x88);
    m[4 + odd] = _mm512_shuffle_f64x2(a0, b0, 0xdd);
    m[2 + odd] = _mm512_shuffle_f64x2(a1, b1, 0x88);
    m[6 + odd] = _mm512_shuffle_f64x2(a1, b1, 0xdd);
  }
}
#elif defined(SIMDBEZIER_KERNELS_AVX2)
SIMDBEZIER_INLINE void turn_4x4(__m256d m[4]) {
  const __m256d a0 = _mm256_unpacklo_pd(m[0], m[1]);
  const __m256d a1 = _mm256_unpackhi_pd(m[0], m[1]);
  const __m256d b0 = _mm256_unpacklo_pd(m[2], m[3]);
  const __m256d b1 = _mm256_unpackhi_pd(m[2], m[3]);
  m[0] = _mm256_permute2f128_pd(a0, b0, 0x20);
  m[1] = _mm256_permute2f128_pd(a1, b1, 0x20);
  m[2] = _mm256_permute2f128_pd(a0, b0, 0x31);
  m[3] = _mm256_permute2f128_pd(a1, b1, 0x31);
}
#endif

/// Loads from[p][at] to lane p. Lanes do not pass through memory where there are instructions that
/// join them: a register that is loaded from parts which have just been stored waits for all of
/// them.
template <typename T>
SIMDBEZIER_INLINE Wide load_each(const T* const from[kWideLanes], std::ptrdiff_t at) {
  const auto value = [&](std::size_t p)
                         SIMDBEZIER_INLINE_LAMBDA { return static_cast<double>(from[p][at]); };
#if defined(SIMDBEZIER_KERNELS_AVX512)
  return Wide(_mm512_set_pd(value(7), value(6), value(5), value(4), value(3), value(2), value(1),
                            value(0)));
#elif defined(SIMDBEZIER_KERNELS_AVX2)
  return Wide(_mm256_set_pd(value(3), value(2), value(1), value(0)));
#elif defined(SIMDBEZIER_KERNELS_SSE2)
  return Wide(_mm_set_pd(value(1), value(0)));
#else
  alignas(64) double lanes[kWideLanes];
  for (std::size_t p = 0; p < kWideLanes; ++p) {
    lanes[p] = value(p);
  }
  return load_vector<Wide>(lanes);
#endif
}

/// This is load_transposed() for any instruction set, by way of memory.
template <typename T>
SIMDBEZIER_INLINE void load_lanes_transposed(const T* from, std::ptrdiff_t stride,
                                             Wide values[kTransposed]) {
  alignas(64) double lanes[kWideLanes];
  for (std::size_t k = 0; k < kTransposed; ++k) {
    for (std::size_t p = 0; p < kWideLanes; ++p) {
      lanes[p] = static_cast<double>(
          from[static_cast<std::ptrdiff_t>(p) * stride + static_cast<std::ptrdiff_t>(k)]);
    }
    values[k] = load_vector<Wide>(lanes);
  }
}

/// Loads values[k], lane p = from[p * stride + k].
SIMDBEZIER_INLINE void load_transposed(const float* from, std::ptrdiff_t stride,
                                       Wide values[kTransposed]) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  for (int half = 0; half < 2; ++half) {
    __m256 r[4];
    for (int p = 0; p < 4; ++p) {
      const float* const at = from + 4 * half + p * stride;
      r[p] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at)),
                                  _mm_loadu_ps(at + 4 * stride), 1);
    }
    transpose_quads<float>(r);
    for (int i = 0; i < 4; ++i) {
      values[4 * half + i] = Wide(_mm512_cvtps_pd(r[i]));
    }
  }
#elif defined(SIMDBEZIER_KERNELS_AVX2)
  for (int k = 0; k < 8; k += 4) {
    __m128 r[4];
    for (int p = 0; p < 4; ++p) {
      r[p] = _mm_loadu_ps(from + k + p * stride);
    }
    transpose_quads<float>(r);
    for (int i = 0; i < 4; ++i) {
      values[k + i] = Wide(_mm256_cvtps_pd(r[i]));
    }
  }
#elif defined(SIMDBEZIER_KERNELS_SSE2)
  for (int k = 0; k < 8; k += 4) {
    const __m128 a = _mm_loadu_ps(from + k);
    const __m128 b = _mm_loadu_ps(from + k + stride);
    const __m128 low = _mm_unpacklo_ps(a, b);
    const __m128 high = _mm_unpackhi_ps(a, b);
    values[k] = Wide(_mm_cvtps_pd(low));
    values[k + 1] = Wide(_mm_cvtps_pd(_mm_movehl_ps(low, low)));
    values[k + 2] = Wide(_mm_cvtps_pd(high));
    values[k + 3] = Wide(_mm_cvtps_pd(_mm_movehl_ps(high, high)));
  }
#else
  load_lanes_transposed(from, stride, values);
#endif
}

SIMDBEZIER_INLINE void load_transposed(const double* from, std::ptrdiff_t stride,
                                       Wide values[kTransposed]) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  __m512d m[8];
  for (int p = 0; p < 8; ++p) {
    m[p] = _mm512_loadu_pd(from + p * stride);
  }
  turn_8x8(m);
  for (int k = 0; k < 8; ++k) {
    values[k] = Wide(m[k]);
  }
#elif defined(SIMDBEZIER_KERNELS_AVX2)
  for (int k = 0; k < 8; k += 4) {
    __m256d m[4];
    for (int p = 0; p < 4; ++p) {
      m[p] = _mm256_loadu_pd(from + k + p * stride);
    }
    turn_4x4(m);
    for (int i = 0; i < 4; ++i) {
      values[k + i] = Wide(m[i]);
    }
  }
#elif defined(SIMDBEZIER_KERNELS_SSE2)
  for (int k = 0; k < 8; k += 2) {
    const __m128d a = _mm_loadu_pd(from + k);
    const __m128d b = _mm_loadu_pd(from + k + stride);
    values[k] = Wide(_mm_unpacklo_pd(a, b));
    values[k + 1] = Wide(_mm_unpackhi_pd(a, b));
  }
#else
  load_lanes_transposed(from, stride, values);
#endif
}

/// This is store_transposed() for any instruction set, by way of memory.
template <typename T>
SIMDBEZIER_INLINE void store_lanes_transposed(const Wide values[kTransposed], T* to,
                                              std::ptrdiff_t stride) {
  alignas(64) double lanes[kWideLanes];
  for (std::size_t k = 0; k < kTransposed; ++k) {
    store_vector<Wide>(lanes, values[k]);
    for (std::size_t p = 0; p < kWideLanes; ++p) {
      to[static_cast<std::ptrdiff_t>(p) * stride + static_cast<std::ptrdiff_t>(k)] =
          static_cast<T>(lanes[p]) + T(0);
    }
  }
}

/// Stores to[p * stride + k] = lane p of values[k], rounded, with +0 for -0. streams says that rows
/// that are lines go past the caches.
SIMDBEZIER_INLINE void store_transposed(const Wide values[kTransposed], float* to,
                                        std::ptrdiff_t stride, bool /*streams*/ = false) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  __m512 r[4]; // values k and k + 4, four places twice
  for (int k = 0; k < 4; ++k) {
    const __m256 high = _mm512_cvtpd_ps(values[k + 4]);
    r[k] = _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(values[k])), high, 1);
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
    r[k] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(values[k])),
                                _mm256_cvtpd_ps(values[k + 4]), 1);
  }
  transpose_quads<float>(r);
  for (int p = 0; p < 4; ++p) {
    _mm256_storeu_ps(to + p * stride, _mm256_add_ps(r[p], _mm256_setzero_ps()));
  }
#elif defined(SIMDBEZIER_KERNELS_SSE2)
  for (int k = 0; k < 8; k += 4) {
    const __m128 a = _mm_movelh_ps(_mm_cvtpd_ps(values[k]), _mm_cvtpd_ps(values[k + 1]));
    const __m128 b = _mm_movelh_ps(_mm_cvtpd_ps(values[k + 2]), _mm_cvtpd_ps(values[k + 3]));
    const __m128 zero = _mm_setzero_ps();
    _mm_storeu_ps(to + k, _mm_add_ps(_mm_shuffle_ps(a, b, 0x88), zero));
    _mm_storeu_ps(to + k + stride, _mm_add_ps(_mm_shuffle_ps(a, b, 0xdd), zero));
  }
#else
  store_lanes_transposed(values, to, stride);
#endif
}

SIMDBEZIER_INLINE void store_transposed(const Wide values[kTransposed], double* to,
                                        std::ptrdiff_t stride,
                                        [[maybe_unused]] bool streams = false) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  __m512d m[8];
  for (int k = 0; k < 8; ++k) {
    m[k] = _mm512_add_pd(values[k], _mm512_setzero_pd());
  }
  turn_8x8(m);
  for (int p = 0; p < 8; ++p) {
    store_line<vec<double>>(to + p * stride, m[p], streams);
  }
#elif defined(SIMDBEZIER_KERNELS_AVX2)
  for (int k = 0; k < 8; k += 4) {
    __m256d m[4];
    for (int i = 0; i < 4; ++i) {
      m[i] = _mm256_add_pd(values[k + i], _mm256_setzero_pd());
    }
    turn_4x4(m);
    for (int p = 0; p < 4; ++p) {
      _mm256_storeu_pd(to + k + p * stride, m[p]);
    }
  }
#elif defined(SIMDBEZIER_KERNELS_SSE2)
  for (int k = 0; k < 8; k += 2) {
    const __m128d a = _mm_add_pd(values[k], _mm_setzero_pd());
    const __m128d b = _mm_add_pd(values[k + 1], _mm_setzero_pd());
    _mm_storeu_pd(to + k, _mm_unpacklo_pd(a, b));
    _mm_storeu_pd(to + k + stride, _mm_unpackhi_pd(a, b));
  }
#else
  store_lanes_transposed(values, to, stride);
#endif
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
    r[i] = _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(values[k])),
                              _mm512_cvtpd_ps(values[k + 4]), 1);
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
