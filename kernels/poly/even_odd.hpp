// Polynomials of degree 3 to 5 as even and odd part, p(Y) = E(Y^2) + Y O(Y^2): for everything that
// is evaluated as a row, an edge or a curve, by the rule in src/storage/even_odd_rule.hpp. Rows Y
// and -Y of a uniform grid share both parts. Since an edge does not know what lies on its other
// side, a single row takes these formulas as well: p(-Y) is E - Y O bit for bit, as the squares are
// the same and rounding to nearest is odd.
//
// The bits of every result depend on the order of operations, which stands in docs/accuracy.md,
// "The scheme".
#pragma once

#include "kernels/simd/operands.hpp"
#include "src/storage/even_odd_rule.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether rows, edges and curves with so many coefficients take these formulas.
constexpr bool takes_even_odd(std::size_t order) {
  return detail::is_even_odd(static_cast<int>(order) - 1);
}

/// The two parts of a value that is their sum at Y and their difference at -Y. A slope's parts swap
/// roles, since the odd part has an even slope: `even` is the part that both rows have in common.
template <typename V>
struct Parts {
  V even;
  V odd;

  SIMDBEZIER_INLINE V sum() const { return even + odd; }
  SIMDBEZIER_INLINE V difference() const { return even - odd; }
};

/// A parameter, or a register of them, with what the formulas take besides.
template <typename V>
struct RowPoint {
  V y;
  V square;
  V twice;        ///< 2 y
  V twice_square; ///< 2 y^2

  explicit SIMDBEZIER_INLINE RowPoint(V parameter)
      : y(parameter), square(y * y), twice(y + y), twice_square(square + square) {}
  SIMDBEZIER_INLINE RowPoint(V the_y, V the_square, V the_twice, V the_twice_square)
      : y(the_y), square(the_square), twice(the_twice), twice_square(the_twice_square) {}
};

// These are the parts of cubics whose coefficients stand in an array; those of degrees 4 and 5 are
// in poly/series.hpp. They are functions, and there is no object that holds what they share: the
// compiler finds that by itself, and would keep objects in memory.

template <typename V>
SIMDBEZIER_INLINE Parts<V> value_parts(const V c[4], const RowPoint<V>& at) {
  return {madd(c[2], at.square, c[0]), at.y * madd(c[3], at.square, c[1])};
}
/// Returns the parts of the value, and finds those of the slope.
template <typename V>
SIMDBEZIER_INLINE Parts<V> value_parts(const V c[4], const RowPoint<V>& at, Parts<V>& slope) {
  const V odd = madd(c[3], at.square, c[1]);
  slope.even = madd(c[3], at.twice_square, odd);
  slope.odd = at.twice * c[2];
  return {madd(c[2], at.square, c[0]), at.y * odd};
}
template <typename V>
SIMDBEZIER_INLINE Parts<V> slope_parts(const V c[4], const RowPoint<V>& at) {
  return {madd(c[3], at.twice_square, madd(c[3], at.square, c[1])), at.twice * c[2]};
}
template <typename V>
SIMDBEZIER_INLINE Parts<V> half_second_parts(const V c[4], const RowPoint<V>& at) {
  return {c[2], (at.twice + at.y) * c[3]};
}

/// Returns the value of a cubic row, edge or curve at one parameter.
template <typename V>
SIMDBEZIER_INLINE V row_value(const V c[4], const RowPoint<V>& at) {
  return value_parts(c, at).sum();
}
/// Returns the same value, bit for bit, and finds its derivative.
template <typename V>
SIMDBEZIER_INLINE V row_value(const V c[4], const RowPoint<V>& at, V& slope) {
  Parts<V> of_slope;
  const Parts<V> value = value_parts(c, at, of_slope);
  slope = of_slope.sum();
  return value.sum();
}
template <typename V>
SIMDBEZIER_INLINE V row_slope(const V c[4], const RowPoint<V>& at) {
  return slope_parts(c, at).sum();
}
template <typename V>
SIMDBEZIER_INLINE V row_second(const V c[4], const RowPoint<V>& at) {
  const V half = half_second_parts(c, at).sum();
  return half + half;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
