// Smaller and larger of two values. Which zero of two comes back depends on the machine, and what
// comes back where one is nan: b where a is, except on NEON, where nan stays. For callers to whom
// neither matters.
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
