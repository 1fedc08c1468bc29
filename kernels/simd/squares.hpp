// Turns as many registers as a register has lanes: lane p of register k becomes lane k of register
// p. This leads from nets that lie one after the other to groups of [value][lane] and back.
#pragma once

#include "kernels/simd/transpose.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether turn_square() exists. Elsewhere values are moved one by one.
template <typename V>
inline constexpr bool kHasSquares = false;

#if defined(SIMDBEZIER_KERNELS_AVX512)
template <>
inline constexpr bool kHasSquares<vec<float>> = true;

/// 4x4 blocks are turned in place, then exchanged.
SIMDBEZIER_INLINE void turn_square(vec<float> values[16]) {
  __m512 m[16];
  for (int p = 0; p < 16; ++p) {
    m[p] = values[p];
  }
  for (int p = 0; p < 16; p += 4) {
    transpose_quads<float>(m + p);
  }
  for (int r = 0; r < 4; ++r) {
    const __m512 ab_low = _mm512_shuffle_f32x4(m[r], m[4 + r], 0x44);
    const __m512 ab_high = _mm512_shuffle_f32x4(m[r], m[4 + r], 0xee);
    const __m512 cd_low = _mm512_shuffle_f32x4(m[8 + r], m[12 + r], 0x44);
    const __m512 cd_high = _mm512_shuffle_f32x4(m[8 + r], m[12 + r], 0xee);
    values[r] = vec<float>(_mm512_shuffle_f32x4(ab_low, cd_low, 0x88));
    values[4 + r] = vec<float>(_mm512_shuffle_f32x4(ab_low, cd_low, 0xdd));
    values[8 + r] = vec<float>(_mm512_shuffle_f32x4(ab_high, cd_high, 0x88));
    values[12 + r] = vec<float>(_mm512_shuffle_f32x4(ab_high, cd_high, 0xdd));
  }
}
#elif defined(SIMDBEZIER_KERNELS_AVX2)
template <>
inline constexpr bool kHasSquares<vec<float>> = true;

SIMDBEZIER_INLINE void turn_square(vec<float> values[8]) {
  __m256 m[8];
  for (int p = 0; p < 8; ++p) {
    m[p] = values[p];
  }
  transpose_quads<float>(m);
  transpose_quads<float>(m + 4);
  for (int r = 0; r < 4; ++r) {
    values[r] = vec<float>(_mm256_permute2f128_ps(m[r], m[4 + r], 0x20));
    values[4 + r] = vec<float>(_mm256_permute2f128_ps(m[r], m[4 + r], 0x31));
  }
}
#elif defined(SIMDBEZIER_KERNELS_SSE2)
template <>
inline constexpr bool kHasSquares<vec<float>> = true;

SIMDBEZIER_INLINE void turn_square(vec<float> values[4]) {
  __m128 m[4] = {values[0], values[1], values[2], values[3]};
  transpose_quads<float>(m);
  for (int r = 0; r < 4; ++r) {
    values[r] = vec<float>(m[r]);
  }
}
#endif

/// A block has so many values, which are moved at once.
template <typename V>
inline constexpr std::size_t kBlock = sizeof(ScalarOf<V>) == sizeof(double) ? kTransposed
                                      : kHasSquares<V>                      ? kLanes<V>
                                                                            : 0;

/// Loads group[k][p] = from[p * stride + k] + 0 for a block of k and all lanes p.
template <typename V, typename S>
SIMDBEZIER_INLINE void load_block(const S* from, std::ptrdiff_t stride, ScalarOf<V>* group) {
  V values[kBlock<V>];
  if constexpr (sizeof(ScalarOf<V>) == sizeof(double)) {
    load_transposed(from, stride, values);
  } else {
    for (std::size_t p = 0; p < kLanes<V>; ++p) {
      values[p] = load_vector<V>(from + static_cast<std::ptrdiff_t>(p) * stride);
    }
    turn_square(values);
  }
  for (std::size_t k = 0; k < kBlock<V>; ++k) {
    store_vector<V>(group + k * kLanes<V>, values[k] + broadcast<V>(ScalarOf<V>(0)));
  }
}

/// Stores to[p * stride + k] = group[k][p] + 0, rounded to S.
template <typename V, typename S>
SIMDBEZIER_INLINE void store_block(const ScalarOf<V>* group, S* to, std::ptrdiff_t stride) {
  V values[kBlock<V>];
  for (std::size_t k = 0; k < kBlock<V>; ++k) {
    values[k] = load_vector<V>(group + k * kLanes<V>);
  }
  if constexpr (sizeof(ScalarOf<V>) == sizeof(double)) {
    store_transposed(values, to, stride);
  } else {
    turn_square(values);
    for (std::size_t p = 0; p < kLanes<V>; ++p) {
      store_vector<V>(to + static_cast<std::ptrdiff_t>(p) * stride,
                      values[p] + broadcast<V>(ScalarOf<V>(0)));
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
