// What bounds on triangles are formed of: lanes are patches.
#pragma once

#include <limits>

#include "kernels/simd/extrema.hpp"
#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Three edge terms of a triangle in order, and how far the largest one is above the sum of the
/// others. Where one of them is far smaller than the rest, differences of their products would have
/// few correct digits; differences of neighbours keep theirs.
template <typename V>
struct SortedTerms {
  V least;
  V middle;
  V largest;
  V excess;

  SIMDBEZIER_INLINE SortedTerms(V a, V c, V d) {
    const V low = smaller_of<V>(a, c);
    const V high = larger_of<V>(a, c);
    least = smaller_of<V>(low, d);
    middle = larger_of<V>(low, smaller_of<V>(high, d));
    largest = larger_of<V>(high, d);
    excess = (largest - middle) - least;
  }
  [[nodiscard]] SIMDBEZIER_INLINE MaskOf<V> obtuse() const {
    return excess >= broadcast<V>(ScalarOf<V>(0));
  }
  /// Returns twice the products of two terms, less the squares.
  [[nodiscard]] SIMDBEZIER_INLINE V divisor() const {
    const V product = (least + least) * (middle + middle);
    return product - excess * excess;
  }
};

/// The largest value of (l0 l1 a + l0 l2 b + l1 l2 c) / 2 over a triangle, a, b, c >= 0: an eighth
/// of the largest of them where that one is at least the sum of the others, else half of the square
/// of the circumradius of the triangle whose sides have the squares a, b and c.
template <typename V>
SIMDBEZIER_INLINE V triangle_bound(V a, V b, V c) {
  using T = ScalarOf<V>;
  const SortedTerms<V> terms(a, b, c);
  const V divisor = terms.divisor();
  const V smallest = broadcast<V>(std::numeric_limits<T>::denorm_min()); // no division by 0
  const MaskOf<V> obtuse = terms.obtuse(); // divides by 1: denormal divisors take 150 cycles
  const V inside = divide(
      terms.least * terms.middle * terms.largest,
      select_where<V>(obtuse, broadcast<V>(T(1)), larger_of<V>(divisor + divisor, smallest)));
  return select_where<V>(obtuse, terms.largest * broadcast<V>(T(0.125)), inside);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
