// Homogeneous nets with points that are one for the library, up to roundings, but not exactly: what
// exact oracles say of such nets is not what the library promises (src/storage/one_point.hpp).
// tests/normals/pole_normals_test.cpp judges them by an oracle of its own.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/support/nets/net.hpp"

namespace simdbezier::tests {

/// Whether a b and c d are the same number.
inline bool same_product(double a, double b, double c, double d) {
  const double left = a * b;
  const double right = c * d;
  return left == right && std::fma(a, b, -left) == std::fma(c, d, -right);
}

/// points_double: the type that the library gets the net in.
inline bool has_points_by_rounding(const Net& net, bool points_double) {
  const double most = 20 * (points_double ? 0x1p-53 : 0x1p-24);
  for (std::size_t k = 0; net.homogeneous && k < net.points.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) {
      const double v = net.weights[k];
      const double w = net.weights[l];
      bool near = true;
      bool same = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const double x = net.points[k][c] / v;
        const double y = net.points[l][c] / w;
        near = near && std::fabs(x - y) <= most * std::max(std::fabs(x), std::fabs(y));
        same = same && same_product(net.points[k][c], w, net.points[l][c], v);
      }
      if (near && !same) {
        return true;
      }
    }
  }
  return false;
}

} // namespace simdbezier::tests
