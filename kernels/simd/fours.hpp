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

/// Takes groups of values that belong to powers 0 to 3 apart: there is a register for each power.
template <typename V>
SIMDBEZIER_INLINE void split_fours(V v, V power[4]) {
  power[0] = broadcast_in_groups<4, 0>(v);
  power[1] = broadcast_in_groups<4, 1>(v);
  power[2] = broadcast_in_groups<4, 2>(v);
  power[3] = broadcast_in_groups<4, 3>(v);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
