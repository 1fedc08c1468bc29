// What bounds on triangles are formed of, and whole numbers in registers of floating-point values:
// lanes are patches.
#pragma once

#include <limits>

#include "kernels/simd/extrema.hpp"
#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The largest value of (l0 l1 a + l0 l2 b + l1 l2 c) / 2 over a triangle, a, b, c >= 0: an eighth
/// of the largest of them where that one is at least the sum of the others, else half of the square
/// of the circumradius of the triangle whose sides have the squares a, b and c.
template <typename V>
SIMDBEZIER_INLINE V triangle_bound(V a, V b, V c) {
  using T = ScalarOf<V>;
  const V low = smaller_of<V>(a, b);
  const V high = larger_of<V>(a, b);
  const V least = smaller_of<V>(low, c);
  const V middle = larger_of<V>(low, smaller_of<V>(high, c));
  const V largest = larger_of<V>(high, c);
  // Where one term is far smaller than the rest, differences of products would have few correct
  // digits; differences of neighbours keep theirs.
  const V excess = (largest - middle) - least;
  const V product = (least + least) * (middle + middle);
  const V divisor = product - excess * excess;
  const V smallest = broadcast<V>(std::numeric_limits<T>::denorm_min()); // no division by 0
  const MaskOf<V> obtuse = excess >= broadcast<V>(T(0));
  // Those divide by 1: denormal divisors take 150 cycles.
  const V inside =
      divide(least * middle * largest, select_where<V>(obtuse, broadcast<V>(T(1)),
                                                       larger_of<V>(divisor + divisor, smallest)));
  return select_where<V>(obtuse, largest * broadcast<V>(T(0.125)), inside);
}

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
