// Groups of four lanes: the four values that lie side by side in memory for one power of X.
#pragma once

#include "kernels/simd/quads.hpp"
#include "kernels/simd/row_groups.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether a register of lanes is made of such groups.
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

/// Returns lane k of each group, in all lanes of the group. Floats stay within 128 bits, which
/// leaves the pipes of the multiply-adds alone.
template <std::size_t k, typename V>
SIMDBEZIER_INLINE V broadcast_in_four(V v) {
  if constexpr (kQuad<V> == 4) {
    return lane_broadcast<k>(v);
  } else {
#if defined(SIMDBEZIER_KERNELS_AVX512)
    return V(_mm512_maskz_permutex_pd(0xff, v, k * 0x55));
#elif defined(SIMDBEZIER_KERNELS_AVX2)
    return V(_mm256_permute4x64_pd(v, k * 0x55));
#else
    return broadcast_in_groups<4, k>(v);
#endif
  }
}

/// Takes groups of values that belong to powers 0 to 3 apart: there is a register for each power.
template <typename V>
SIMDBEZIER_INLINE void split_fours(V v, V power[4]) {
  power[0] = broadcast_in_four<0>(v);
  power[1] = broadcast_in_four<1>(v);
  power[2] = broadcast_in_four<2>(v);
  power[3] = broadcast_in_four<3>(v);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
