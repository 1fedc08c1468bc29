// The error bounds of patches of any degrees, in units of the unit roundoff u.
//
// K(m,n) = min(S J', J S') + min(R S', Q J') + T' + L + L', the plain ones in u, the primed ones in
// v, all maxima over control values in [-1,1]:
//   S  sum over the powers of the largest coefficient: each coefficient carries one rounding;
//   J  the largest sum of the coefficients, all powers at once;
//   R  the largest sum of the roundings of a column, which takes Horner's rule;
//   Q  sum over its steps of the largest rounding of each;
//   T  the largest sum of the roundings of a row: R, or of even and odd parts in degrees 3 to 5;
//   L  degree/2 where the direction is cut in two: its local parameter is rounded once, which moves
//      the sample by u/4 of the patch at the most, at the speed of the hodograph.
// docs/accuracy.md has the proof.
// Derivatives: the same of their steps, per unit of the hodograph's control values;
// second ones per unit of the second hodograph's. Bicubic patches have tighter bounds,
// maximised over all nets at once (bicubic_bounds.hpp). shape_bounds_test.cpp computes the table
// anew.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "tests/properties/accuracy/judge/bicubic_bounds.hpp"
#include "tests/support/even_odd_model.hpp"

namespace simdbezier::tests {

/// Directions from this degree on consist of two cells.
inline constexpr int kFirstCutDegree = 6;
[[nodiscard]] constexpr bool is_cut(int degree) { return degree >= kFirstCutDegree; }

struct DirectionError {
  double coefficients = 0;        ///< S
  double together = 0;            ///< J
  double fused = 0;               ///< R, one rounding a multiply-add
  double rounded_twice = 0;       ///< R, two of them
  double apart_fused = 0;         ///< Q, one rounding a multiply-add
  double apart_rounded_twice = 0; ///< Q, two of them
  [[nodiscard]] constexpr double steps(bool fma) const { return fma ? fused : rounded_twice; }
  [[nodiscard]] constexpr double steps_apart(bool fma) const {
    return fma ? apart_fused : apart_rounded_twice;
  }
};

/// [order of the derivative][degree - 1], rounded up.
inline constexpr DirectionError kDirectionErrors[3][15] = {{{2, 1, 1, 2, 1, 2},
                                                            {3, 2, 2.5, 4.5, 2.5, 5},
                                                            {5, 2.5, 4, 7, 4.25, 8.5},
                                                            {6.5, 4, 5.38, 10.2, 7, 14},
                                                            {10.8, 4.75, 6.75, 12.9, 9.57, 19.2},
                                                            {4.24, 2.29, 4.21, 7.42, 5.46, 9.94},
                                                            {4.92, 2.48, 4.82, 8.63, 6.53, 12.1},
                                                            {5.78, 2.97, 5.51, 10.1, 7.67, 14.4},
                                                            {6.75, 3.31, 6.24, 11.5, 8.93, 16.9},
                                                            {7.92, 3.86, 7.03, 13.1, 10.5, 20},
                                                            {9.33, 4.33, 7.71, 14.5, 12.2, 23.4},
                                                            {10.7, 5.24, 8.61, 16.3, 14.1, 27.2},
                                                            {12.2, 5.94, 9.74, 18.5, 16, 31},
                                                            {14.5, 6.65, 10.8, 20.6, 18.3, 35.5},
                                                            {16.7, 7.9, 11.7, 22.3, 21.1, 41.2}},
                                                           {{1, 1, 0, 0, 0, 0},
                                                            {2, 1, 2, 2.5, 2, 3},
                                                            {3, 2, 3.34, 5.34, 4.17, 6.67},
                                                            {5, 2.5, 5, 8, 6.57, 11},
                                                            {6.5, 4, 6.6, 11.4, 10.1, 17.3},
                                                            {3.63, 2.06, 4.64, 7.27, 6.6, 10.1},
                                                            {4.24, 2.29, 5.25, 8.46, 7.88, 12.4},
                                                            {4.92, 2.48, 5.86, 9.68, 9.11, 14.7},
                                                            {5.78, 2.97, 6.64, 11.2, 10.7, 17.5},
                                                            {6.75, 3.31, 7.37, 12.6, 12.6, 20.9},
                                                            {7.92, 3.86, 8.19, 14.3, 14.4, 24.3},
                                                            {9.33, 4.33, 9.05, 15.8, 16.4, 28},
                                                            {10.7, 5.24, 10.2, 17.9, 18.6, 32},
                                                            {12.2, 5.94, 11.3, 20.1, 21.1, 36.8},
                                                            {14.5, 6.65, 12.3, 22.2, 24.2, 42.6}},
                                                           {{0, 0, 0, 0, 0, 0},
                                                            {1, 1, 0, 0, 0, 0},
                                                            {2, 1, 3, 3, 3, 4},
                                                            {3, 2, 4.34, 6.34, 5.84, 8.34},
                                                            {5, 2.5, 6.5, 9.5, 8.95, 13.4},
                                                            {2.85, 1.74, 5.04, 7.08, 7.4, 10.1},
                                                            {3.63, 2.06, 5.81, 8.44, 8.77, 12.3},
                                                            {4.24, 2.29, 6.56, 9.75, 10.4, 14.9},
                                                            {4.92, 2.48, 7.33, 11.2, 12, 17.7},
                                                            {5.78, 2.97, 8.13, 12.7, 13.8, 20.7},
                                                            {6.75, 3.31, 8.95, 14.3, 16, 24.4},
                                                            {7.92, 3.86, 10.1, 16.2, 17.9, 27.9},
                                                            {9.33, 4.33, 11.1, 18.1, 20.3, 32.1},
                                                            {10.7, 5.24, 12.3, 20.3, 23.4, 37.4},
                                                            {12.2, 5.94, 13.6, 22.7, 26.6, 42.9}}};

[[nodiscard]] constexpr const DirectionError& direction_error(int degree, int order) {
  return kDirectionErrors[order][degree - 1];
}

/// T, by the class.
struct RowError {
  double fused = 0;
  double rounded_twice = 0;
};

/// The errors of even and odd parts: [order of the derivative][degree - 3], rounded up.
inline constexpr RowError kEvenOddErrors[3][3] = {{{4, 5}, {5.75, 7.75}, {7.25, 10.5}},
                                                  {{3.34, 4.34}, {5.38, 6.38}, {7.28, 9.36}},
                                                  {{3, 3}, {4.25, 4.75}, {7.75, 8.75}}};

[[nodiscard]] constexpr double row_error(int degree, int order, bool fma) {
  if (!by_even_and_odd_parts(static_cast<std::size_t>(degree))) {
    return direction_error(degree, order).steps(fma);
  }
  const RowError& error = kEvenOddErrors[order][degree - 3];
  return fma ? error.fused : error.rounded_twice;
}

/// L of what is left of a direction after `order` derivatives.
[[nodiscard]] constexpr double local_parameter_error(int degree, int order) {
  return is_cut(degree) ? (degree - order) / 2.0 : 0;
}

/// The bound on one derivative of a polynomial patch, per u max|control value of its hodograph|.
[[nodiscard]] constexpr double general_bound(int degree_u, int degree_v, int order_u, int order_v,
                                             bool fma) {
  if (order_u > degree_u || order_v > degree_v) {
    return 0; // the derivative is zero, and so is what is computed
  }
  const DirectionError& u = direction_error(degree_u, order_u);
  const DirectionError& v = direction_error(degree_v, order_v);
  const double coefficients = std::min(u.coefficients * v.together, u.together * v.coefficients);
  const double columns = std::min(u.steps(fma) * v.coefficients, u.steps_apart(fma) * v.together);
  return coefficients + columns + row_error(degree_v, order_v, fma) +
         local_parameter_error(degree_u, order_u) + local_parameter_error(degree_v, order_v);
}

/// What the library promises for polynomial patches of these degrees.
struct ShapeBounds {
  double position;
  double du;
  double dv;
  double duu;
  double duv;
  double dvv;
};

[[nodiscard]] constexpr ShapeBounds general_bounds(int degree_u, int degree_v, bool fma) {
  const auto of = [&](int order_u, int order_v) {
    return general_bound(degree_u, degree_v, order_u, order_v, fma);
  };
  return {of(0, 0), of(1, 0), of(0, 1), of(2, 0), of(1, 1), of(0, 2)};
}

/// Bicubic patches by their own bounds. The general ones hold for them, too: homogeneous
/// coordinates take these, since a weight is not bounded by the points.
[[nodiscard]] constexpr ShapeBounds shape_bounds(int degree_u, int degree_v, bool fma) {
  if (degree_u != 3 || degree_v != 3) {
    return general_bounds(degree_u, degree_v, fma);
  }
  const double first = derivative_bound(fma);
  const double second = second_derivative_bound(fma);
  return {position_bound(fma), first, first, second, second, second};
}

} // namespace simdbezier::tests
