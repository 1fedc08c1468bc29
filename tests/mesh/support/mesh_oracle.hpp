// Bicubic patches and triangles by formulas of the tests' own, in double.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "tests/mesh/support/mesh_models.hpp"

namespace simdbezier::tests {

using Point = std::array<double, 3>;

inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }

/// Bernstein polynomials of degree 3, or their derivatives.
inline std::array<double, 4> bernstein3(double t, bool derivative) {
  const double s = 1 - t;
  if (derivative) {
    return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
  }
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

/// The surface, or its first derivatives.
inline Point surface(const PatchPoints& patch, double u, double v, bool du = false,
                     bool dv = false) {
  const auto bu = bernstein3(u, du);
  const auto bv = bernstein3(v, dv);
  Point sum{};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      sum = sum + bu[i] * bv[j] * patch[j][i];
    }
  }
  return sum;
}

/// dS/du x dS/dv, not of unit length.
inline Point surface_normal(const PatchPoints& patch, double u, double v) {
  return cross(surface(patch, u, v, true, false), surface(patch, u, v, false, true));
}

/// Squared distance of a point from a triangle: to the plane where the foot lies inside, else to
/// the nearest side.
double squared_distance(const Point& point, const std::array<Point, 3>& triangle);

} // namespace simdbezier::tests
