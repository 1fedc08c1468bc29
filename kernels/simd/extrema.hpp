// Smaller and larger of two values. Which one comes back where one is nan, and which zero of two,
// depends on the machine: for callers to whom neither matters.
#pragma once

#include "kernels/simd/vector.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename V>
SIMDBEZIER_INLINE V smaller_of(V a, V b) {
  if constexpr (kIsScalar<V>) {
    return a < b ? a : b;
  } else {
    return min(a, b);
  }
}
template <typename V>
SIMDBEZIER_INLINE V larger_of(V a, V b) {
  if constexpr (kIsScalar<V>) {
    return a > b ? a : b;
  } else {
    return max(a, b);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
