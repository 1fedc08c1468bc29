// The 128-bit lanes of a register: loads that bring each of them from another place, and
// permutations that stay within them, which cost no multiply-add its turn (permutations across
// lanes do). A group of four lanes is the four values that lie side by side in memory for one power
// of X.
//
// A register has kQuads lanes of kQuad values: 4 floats or 2 doubles.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/simd/interleave.hpp"
#include "kernels/simd/lanes.hpp"
#include "kernels/simd/quad_transpose.hpp"
#include "kernels/simd/row_groups.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename V>
inline constexpr std::size_t kQuad = 16 / sizeof(ScalarOf<V>);
template <typename V>
inline constexpr std::size_t kQuads = kLanes<V> / kQuad<V>;

// 128-bit lanes from memory -----------------------------------------------------------------------

/// Loads lane q from the 128 bits at at(q).
template <typename V, typename At>
SIMDBEZIER_INLINE V quads_at(const At& at) {
#if defined(SIMDBEZIER_KERNELS_AVX512) || defined(SIMDBEZIER_KERNELS_AVX2)
  const auto two = [&](std::size_t q) SIMDBEZIER_INLINE_LAMBDA {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(load_any<__m128>(at(q))),
                                load_any<__m128>(at(q + 1)), 1);
  };
#endif
#if defined(SIMDBEZIER_KERNELS_AVX512)
  return __builtin_bit_cast(
      V, _mm512_maskz_insertf32x8(0xffff, _mm512_castps256_ps512(two(0)), two(2), 1));
#elif defined(SIMDBEZIER_KERNELS_AVX2)
  return __builtin_bit_cast(V, two(0));
#else
  static_assert(kQuads<V> == 1);
  return load_vector<V>(at(0));
#endif
}

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// Loads two adjacent lanes of two places.
template <typename T>
SIMDBEZIER_INLINE __m512d two_halves(const T* low, const T* high) {
  __m256d first;
  __builtin_memcpy(&first, low, sizeof(first));
  __m256d second;
  __builtin_memcpy(&second, high, sizeof(second));
  return _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(first), second, 1);
}

/// Loads three lanes of chunk[j], the q-th from the j-th 128 bits behind first + q * step. The last
/// lane repeats another one, so that arithmetic on it raises no exception of its own.
SIMDBEZIER_INLINE void load_three_quads(const float* first, std::size_t step, vec<float> chunk[4]) {
  const auto two = [&](std::size_t at) __attribute__((always_inline)) {
    return _mm512_castpd_ps(two_halves(first + at, first + step + at));
  };
  const __m512 third = _mm512_loadu_ps(first + 2 * step);
  chunk[0] = _mm512_maskz_shuffle_f32x4(0xffff, two(0), third, 0x08);
  chunk[1] = _mm512_maskz_shuffle_f32x4(0xffff, two(0), third, 0x1d);
  chunk[2] = _mm512_maskz_shuffle_f32x4(0xffff, two(8), third, 0x28);
  chunk[3] = _mm512_maskz_shuffle_f32x4(0xffff, two(8), third, 0x3d);
}
#endif

/// Loads lane q of chunk[j] from the j-th 128 bits of the 64 bytes at from[q]. It takes halves of
/// cache lines and one permutation a register: whole lines would need two.
template <typename V>
SIMDBEZIER_INLINE void load_quads(const ScalarOf<V>* const from[kQuads<V>], V chunk[4]) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  for (std::size_t j = 0; j < 4; j += 2) {
    const std::size_t at = j * kQuad<V>;
    const __m512d a = two_halves(from[0] + at, from[1] + at);
    const __m512d b = two_halves(from[2] + at, from[3] + at);
    chunk[j] = __builtin_bit_cast(V, _mm512_maskz_shuffle_f64x2(0xff, a, b, 0x88));
    chunk[j + 1] = __builtin_bit_cast(V, _mm512_maskz_shuffle_f64x2(0xff, a, b, 0xdd));
  }
#else
  for (std::size_t j = 0; j < 4; ++j) {
    chunk[j] =
        quads_at<V>([&](std::size_t q) SIMDBEZIER_INLINE_LAMBDA { return from[q] + j * kQuad<V>; });
  }
#endif
}

// Within 128-bit lanes ----------------------------------------------------------------------------

/// Returns value k of each group of kGroup lanes, in all lanes of the group.
template <std::size_t kGroup, std::size_t k, typename V>
SIMDBEZIER_INLINE V broadcast_in_groups(V v) {
  const auto bits = __builtin_bit_cast(Bits<V>, v);
  return [&]<std::size_t... lane>(std::index_sequence<lane...>) SIMDBEZIER_INLINE_LAMBDA {
    constexpr auto from = [](std::size_t to) { return static_cast<int>(to / kGroup * kGroup + k); };
    return __builtin_bit_cast(V, __builtin_shufflevector(bits, bits, from(lane)...));
  }
  (std::make_index_sequence<kLanes<V>>());
}

/// Returns value k of each group of kGroup lanes, in all lanes of the group, in each[k].
template <std::size_t kGroup, typename V>
SIMDBEZIER_INLINE void split_groups(V v, V each[kGroup]) {
  [&]<std::size_t... k>(std::index_sequence<k...>) SIMDBEZIER_INLINE_LAMBDA {
    ((each[k] = broadcast_in_groups<kGroup, k>(v)), ...);
  }
  (std::make_index_sequence<kGroup>());
}

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// Returns value k of each lane of `low` in the first half of that lane, and of `high` in the
/// other.
template <std::size_t k>
SIMDBEZIER_INLINE vec<float> broadcast_halves(vec<float> low, vec<float> high) {
  return vec<float>(_mm512_maskz_shuffle_ps(0xffff, low, high, k * 0x55));
}
/// Returns the first halves of the lanes of two registers, their values in turn.
SIMDBEZIER_INLINE vec<float> zip_low_halves(vec<float> even, vec<float> odd) {
  return vec<float>(_mm512_maskz_unpacklo_ps(0xffff, even, odd));
}
/// Likewise their second halves.
SIMDBEZIER_INLINE vec<float> zip_high_halves(vec<float> even, vec<float> odd) {
  return vec<float>(_mm512_maskz_unpackhi_ps(0xffff, even, odd));
}
#endif

/// Transposes the kQuad x kQuad values that kQuad registers hold in each lane.
template <typename V>
SIMDBEZIER_INLINE void lane_transpose(V r[kQuad<V>]) {
  Bits<V> m[kQuad<V>];
  for (std::size_t k = 0; k < kQuad<V>; ++k) {
    m[k] = __builtin_bit_cast(Bits<V>, r[k]);
  }
  transpose_quads<ScalarOf<V>>(m);
  for (std::size_t k = 0; k < kQuad<V>; ++k) {
    r[k] = __builtin_bit_cast(V, m[k]);
  }
}

// Indices -----------------------------------------------------------------------------------------

/// Loads from[step * index[i]] to lane i.
template <typename V>
SIMDBEZIER_INLINE V gather_lanes(const ScalarOf<V>* from, const std::uint32_t* index,
                                 std::size_t step) {
  return from_lanes<V>([&](std::size_t i)
                           SIMDBEZIER_INLINE_LAMBDA { return from[step * index[i]]; });
}

/// Whether kCount indices, a power of two, are all equal to `same`.
template <std::size_t kCount>
SIMDBEZIER_INLINE bool all_equal(const std::uint32_t* index, std::uint32_t same) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  if constexpr (kCount == 16) {
    return _mm512_cmpneq_epi32_mask(_mm512_loadu_si512(index),
                                    _mm512_set1_epi32(static_cast<int>(same))) == 0;
  }
#endif
#if defined(SIMDBEZIER_KERNELS_AVX512) || defined(SIMDBEZIER_KERNELS_AVX2)
  if constexpr (kCount == 8) {
    const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
    const __m256i equal = _mm256_cmpeq_epi32(eight, _mm256_set1_epi32(static_cast<int>(same)));
    return _mm256_movemask_epi8(equal) == -1;
  }
#endif
  std::uint32_t different = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    different |= index[i] ^ same;
  }
  return different == 0;
}

/// Whether a register of lanes is made of groups of four.
template <typename V>
constexpr bool kHasFours = kLanes<V> >= 4;

/// Returns values[i] in lane i of every group.
template <typename V>
SIMDBEZIER_INLINE V repeat_four(const ScalarOf<V>* values) {
  return RowGroups<kLanes<V> / 4, V>::repeat(values);
}

/// Loads four groups of four values that follow each other in memory.
template <typename V>
SIMDBEZIER_INLINE void load_fours(const ScalarOf<V>* values, V four[4]) {
  for (std::size_t i = 0; i < 4; ++i) {
    four[i] = repeat_four<V>(values + 4 * i);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
