// The bicubic patch as what its formula says: a sum of sixteen control points times the products of
// two Bernstein polynomials.
#pragma once

#include <array>
#include <cstddef>

#include "patch.hpp"

namespace seed {

/// B_0 … B_3 of degree 3 at t: they are positive and sum to 1, so that S is a mean of the P[j][i].
constexpr std::array<double, 4> cubic_bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

/// S(u,v) = sum_j sum_i P[j][i] B_i(u) B_j(v) of a bicubic net.
inline Point bernstein_sum(const Net& net, double u, double v) {
  const std::array<double, 4> in_u = cubic_bernstein(u);
  const std::array<double, 4> in_v = cubic_bernstein(v);
  Point sum;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      sum = sum + (in_u[i] * in_v[j]) * net.points[4 * j + i];
    }
  }
  return sum;
}

} // namespace seed
