// Polynomials of degree 3 to 5 as even and odd part, p(Y) = E(Y^2) + Y O(Y^2): for everything that
// is evaluated as a row, an edge or a curve.
//
// Rows of a uniform grid come in pairs Y and -Y, which share both parts: a pair costs three
// products and two sums a sample and component instead of six multiply-adds. Since an edge does not
// know what lies on its other side, everything of these degrees takes these formulas, a single row
// as well: p(-Y) is E - Y O bit for bit, as the squares are the same and rounding to nearest is
// odd.
//
// The rule stands in takes_even_odd(), by the degree of the one-dimensional polynomial alone.
// Columns (a patch's first direction) keep Horner's rule: nothing there is shared. Degrees 1 and 2
// would gain nothing, and from degree 6 on rows Y and -Y lie in different cells (net_shape.hpp).
//
// Order of operations, on which the bits of every result hang, with Z = Y * Y rounded:
//   value   E + Y * O, both parts by Horner's rule in Z; the product is rounded before the sum
//   slope   (O + 2 Z O') + 2 Y * E', where ' is by Z
//   half of the second derivative   (E' + 4 Z E''/2) + 3 Y * O' (+ 4 Z Y O''/2, degree 5)
// with E', O' and their halved derivatives by synthetic division.
#pragma once

#include "kernels/simd/operands.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether rows, edges and curves with so many coefficients take these formulas.
constexpr bool takes_even_odd(std::size_t order) { return order >= 4 && order <= 6; }

/// What is at Y the sum of two parts, and at -Y their difference. Slopes are even in their odd
/// part: `even` is what both have in common.
template <typename V>
struct Parts {
  V even;
  V odd;

  SIMDBEZIER_INLINE V sum() const { return even + odd; }
  SIMDBEZIER_INLINE V difference() const { return even - odd; }
};

/// A parameter, or a register of them, with its square.
template <typename V>
struct RowPoint {
  V y;
  V square;

  explicit SIMDBEZIER_INLINE RowPoint(V parameter) : y(parameter), square(parameter * parameter) {}
  SIMDBEZIER_INLINE V times(V a) const { return y * a; }
  SIMDBEZIER_INLINE V times_twice(V a) const { return (y + y) * a; }
  SIMDBEZIER_INLINE V times_thrice(V a) const { return ((y + y) + y) * a; }
  /// a * Y^2 + c
  SIMDBEZIER_INLINE V add_square(V a, V c) const { return madd(a, square, c); }
  SIMDBEZIER_INLINE V add_twice_square(V a, V c) const { return madd(a, square + square, c); }
  SIMDBEZIER_INLINE V add_four_squares(V a, V c) const {
    const V twice = square + square;
    return madd(a, twice + twice, c);
  }
  /// a * 4 Y^3 + c
  SIMDBEZIER_INLINE V add_four_cubes(V a, V c) const {
    const V twice = square + square;
    return madd(a, (twice + twice) * y, c);
  }
};

/// Both parts of a polynomial with kCoefficients coefficients, and their derivatives by the square.
/// What is not asked for costs nothing: the compiler drops it.
template <std::size_t kCoefficients, typename V>
struct EvenOdd {
  static_assert(takes_even_odd(kCoefficients));
  V even;
  V even_first;
  V even_second; ///< half of it; of degrees 4 and 5
  V odd;
  V odd_first;
  V odd_second; ///< half of it; of degree 5

  /// c(k): coefficient k. Point: RowPoint or another with its operations.
  template <typename Point, typename Coefficient>
  SIMDBEZIER_INLINE EvenOdd(const Point& at, const Coefficient& c) {
    if constexpr (kCoefficients == 4) {
      even_first = even_second = c(2);
      even = at.add_square(even_first, c(0));
    } else {
      const V b = at.add_square(c(4), c(2));
      even = at.add_square(b, c(0));
      even_first = at.add_square(c(4), b);
      even_second = c(4);
    }
    if constexpr (kCoefficients < 6) {
      odd_first = odd_second = c(3);
      odd = at.add_square(odd_first, c(1));
    } else {
      const V b = at.add_square(c(5), c(3));
      odd = at.add_square(b, c(1));
      odd_first = at.add_square(c(5), b);
      odd_second = c(5);
    }
  }

  template <typename Point>
  SIMDBEZIER_INLINE Parts<V> value(const Point& at) const {
    return {even, at.times(odd)};
  }
  template <typename Point>
  SIMDBEZIER_INLINE Parts<V> slope(const Point& at) const {
    return {at.add_twice_square(odd_first, odd), at.times_twice(even_first)};
  }
  /// Of the second derivative.
  template <typename Point>
  SIMDBEZIER_INLINE Parts<V> half_second(const Point& at) const {
    Parts<V> parts{even_first, at.times_thrice(odd_first)};
    if constexpr (kCoefficients > 4) {
      parts.even = at.add_four_squares(even_second, even_first);
    }
    if constexpr (kCoefficients == 6) {
      parts.odd = at.add_four_cubes(odd_second, parts.odd);
    }
    return parts;
  }
};

/// The parts of a cubic whose coefficients stand in an array.
template <typename V, typename Point>
SIMDBEZIER_INLINE EvenOdd<4, V> cubic_parts(const V c[4], const Point& at) {
  return EvenOdd<4, V>(at, [c](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return c[k]; });
}

/// A cubic row, edge or curve at one parameter.
template <typename V, typename Point>
SIMDBEZIER_INLINE V row_value(const V c[4], const Point& at) {
  return cubic_parts(c, at).value(at).sum();
}
/// The same value, bit for bit, and its derivative.
template <typename V, typename Point>
SIMDBEZIER_INLINE V row_value(const V c[4], const Point& at, V& slope) {
  const EvenOdd<4, V> parts = cubic_parts(c, at);
  slope = parts.slope(at).sum();
  return parts.value(at).sum();
}
template <typename V, typename Point>
SIMDBEZIER_INLINE V row_slope(const V c[4], const Point& at) {
  return cubic_parts(c, at).slope(at).sum();
}
template <typename V, typename Point>
SIMDBEZIER_INLINE V row_second(const V c[4], const Point& at) {
  const V half = cubic_parts(c, at).half_second(at).sum();
  return half + half;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
