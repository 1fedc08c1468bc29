// Moves blocks of values between nets that lie one after the other and groups of [value][lane].
#pragma once

#include "kernels/simd/transpose.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A block has so many values, which are moved at once; 0: values are moved one by one.
template <typename V>
inline constexpr std::size_t kBlock = sizeof(ScalarOf<V>) == sizeof(double) ? kTransposed
                                      : kIsScalar<V>                        ? 0
                                      : kTurnsLines<V>                      ? kLanes<V>
                                                                            : kQuad<V>;

/// Loads group[k][p] = from[p * stride + k] + 0 for a block of k and all lanes p.
template <typename V, typename S>
SIMDBEZIER_INLINE void load_block(const S* from, std::ptrdiff_t stride, ScalarOf<V>* group) {
  V values[kBlock<V>];
  if constexpr (sizeof(ScalarOf<V>) == sizeof(double)) {
    load_transposed(from, stride, values);
  } else {
    load_values_across<kBlock<V>>(from, stride, values);
  }
  for (std::size_t k = 0; k < kBlock<V>; ++k) {
    store_vector<V>(group + k * kLanes<V>, values[k] + broadcast<V>(ScalarOf<V>(0)));
  }
}

/// Stores to[p * stride + k] = group[k][p] + 0, rounded to S.
template <typename V, typename S>
SIMDBEZIER_INLINE void store_block(const ScalarOf<V>* group, S* to, std::ptrdiff_t stride) {
  constexpr bool kWide = sizeof(ScalarOf<V>) == sizeof(double); // store_transposed() adds 0
  V values[kBlock<V>];
  for (std::size_t k = 0; k < kBlock<V>; ++k) {
    values[k] = load_vector<V>(group + k * kLanes<V>);
    values[k] = kWide ? values[k] : values[k] + broadcast<V>(ScalarOf<V>(0));
  }
  if constexpr (kWide) {
    store_transposed(values, to, stride);
  } else {
    store_values_across<kBlock<V>>(values, to, stride);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
