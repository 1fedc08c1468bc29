// The error bounds of patches of any degrees, in units of the unit roundoff u.
//
// K(m,n) = S S' + R S' + R' + L + L', the first of each pair in u, the primed one in v:
//   S  sum over the powers of the largest coefficient that control values in [-1,1] can give: each
//      coefficient carries one rounding;
//   R  the largest sum of the roundings of Horner's rule: rows in u, whose own control values are
//      coefficients in v (hence R S'), then the column in v;
//   L  degree/2 where the direction is cut in two: its local parameter is rounded once, which moves
//      the sample by u/4 of the patch at the most, at the speed of the hodograph.
// Derivatives: the same with S and R of synthetic division, per unit of the hodograph's control
// values; second ones per unit of the second hodograph's. Bicubic patches have tighter bounds,
// maximised over all nets at once (bounds.hpp). shape_bounds_test.cpp computes the table anew.
#pragma once

#include <array>
#include <cstddef>

#include "tests/properties/accuracy/judge/bicubic_bounds.hpp"

namespace simdbezier::tests {

/// Directions from this degree on consist of two cells.
inline constexpr int kFirstCutDegree = 6;
[[nodiscard]] constexpr bool is_cut(int degree) { return degree >= kFirstCutDegree; }

struct DirectionError {
  double coefficients = 0;  ///< S
  double fused = 0;         ///< R, one rounding a multiply-add
  double rounded_twice = 0; ///< R, two of them
  [[nodiscard]] constexpr double steps(bool fma) const { return fma ? fused : rounded_twice; }
};

/// [order of the derivative][degree - 1], rounded up.
inline constexpr DirectionError kDirectionErrors[3][15] = {{{2, 1, 2},
                                                            {3, 2.5, 4.5},
                                                            {5, 4, 7},
                                                            {6.5, 5.38, 10.2},
                                                            {10.8, 6.75, 12.9},
                                                            {4.24, 4.21, 7.42},
                                                            {4.92, 4.82, 8.63},
                                                            {5.78, 5.51, 10.1},
                                                            {6.75, 6.24, 11.5},
                                                            {7.92, 7.03, 13.1},
                                                            {9.33, 7.71, 14.5},
                                                            {10.7, 8.61, 16.3},
                                                            {12.2, 9.74, 18.5},
                                                            {14.5, 10.8, 20.6},
                                                            {16.7, 11.7, 22.3}},
                                                           {{1, 0, 0},
                                                            {2, 2, 2.5},
                                                            {3, 3.34, 5.34},
                                                            {5, 5, 8},
                                                            {6.5, 6.6, 11.4},
                                                            {3.63, 4.64, 7.27},
                                                            {4.24, 5.25, 8.46},
                                                            {4.92, 5.86, 9.68},
                                                            {5.78, 6.64, 11.2},
                                                            {6.75, 7.37, 12.6},
                                                            {7.92, 8.19, 14.3},
                                                            {9.33, 9.05, 15.8},
                                                            {10.7, 10.2, 17.9},
                                                            {12.2, 11.3, 20.1},
                                                            {14.5, 12.3, 22.2}},
                                                           {{0, 0, 0},
                                                            {1, 0, 0},
                                                            {2, 3, 3},
                                                            {3, 4.34, 6.34},
                                                            {5, 6.5, 9.5},
                                                            {2.85, 5.04, 7.08},
                                                            {3.63, 5.81, 8.44},
                                                            {4.24, 6.56, 9.75},
                                                            {4.92, 7.33, 11.2},
                                                            {5.78, 8.13, 12.7},
                                                            {6.75, 8.95, 14.3},
                                                            {7.92, 10.1, 16.2},
                                                            {9.33, 11.1, 18.1},
                                                            {10.7, 12.3, 20.3},
                                                            {12.2, 13.6, 22.7}}};

[[nodiscard]] constexpr const DirectionError& direction_error(int degree, int order) {
  return kDirectionErrors[order][degree - 1];
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
  return (u.coefficients + u.steps(fma)) * v.coefficients + v.steps(fma) +
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
