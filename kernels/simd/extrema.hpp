// Smaller and larger of two values, for callers to whom two things do not matter that depend on the
// machine: which of two zeros comes back, and what comes back where one value is nan (b where a is
// nan, except on NEON, where nan stays).
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
