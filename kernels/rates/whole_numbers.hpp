// Whole numbers in registers of floating-point values.
#pragma once

#include <limits>

#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The largest whole number that is not above x, for 0 <= x below 2^22.
template <typename V>
SIMDBEZIER_INLINE V whole_part(V x) {
  using T = ScalarOf<V>;
  const V magic = broadcast<V>(static_cast<T>(T(1) / std::numeric_limits<T>::epsilon()));
  const V nearest = (x + magic) - magic;
  return select_where<V>(nearest > x, nearest - broadcast<V>(T(1)), nearest);
}
/// The smallest whole number that is not below x.
template <typename V>
SIMDBEZIER_INLINE V whole_above(V x) {
  const V below = whole_part<V>(x);
  return select_where<V>(below < x, below + broadcast<V>(ScalarOf<V>(1)), below);
}
/// For whole numbers.
template <typename V>
SIMDBEZIER_INLINE MaskOf<V> is_odd(V n) {
  const V half = broadcast<V>(ScalarOf<V>(0.5));
  return whole_part<V>(half * n) != half * n;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
