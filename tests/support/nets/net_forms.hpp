// The same surfaces in other forms: with weights of several kinds, and placed elsewhere in space,
// so that what vanishes still does; see net_shapes.hpp for the rules on bits.
#pragma once

#include <cmath>
#include <utility>

#include "tests/support/nets/shaped_nets.hpp"

namespace simdbezier::tests {

/// Points keep their places, and weights where there are some; equal rows may have equal weights or
/// not.
[[nodiscard]] inline Net weighted_points(Net net, Random& random) {
  if (net.is_rational()) {
    return net;
  }
  const auto choice = random.below(4);
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    switch (choice) {
    case 0: // per row
      net.weights.push_back(k % static_cast<std::size_t>(net.degree_u + 1) == 0
                                ? graded_weight(4, random.integer(0, 16))
                                : net.weights.back());
      break;
    case 1: // small integers
      net.weights.push_back(random.integer(1, 5));
      break;
    case 2: // powers of two
      net.weights.push_back(std::ldexp(1, random.integer(-3, 3)));
      break;
    default:
      net.weights.push_back(graded_weight(1e4, random.integer(0, 16)));
    }
  }
  return net;
}

/// The points become numerators h, and are divided by powers of two: where h vanishes to some
/// order, so does h / w.
[[nodiscard]] inline Net weighted_numerators(Net net, Random& random) {
  if (net.is_rational()) {
    return net;
  }
  for (Vector3& point : net.points) {
    net.weights.push_back(std::ldexp(1, random.integer(-4, 4)));
    for (double& value : point) {
      value /= net.weights.back();
    }
  }
  return net;
}

/// Returns the surface in homogeneous coordinates, by weights that are powers of two where the
/// products would not be exact in T.
template <typename T>
[[nodiscard]] Net exactly_homogeneous(Net net) {
  net = rounded_to<T>(std::move(net));
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    for (const double value : net.points[k]) {
      const double product = value * net.weights[k];
      if (product != static_cast<double>(static_cast<T>(product)) ||
          std::fma(value, net.weights[k], -product) != 0) {
        net.weights[k] = std::ldexp(1, std::ilogb(net.weights[k]));
      }
    }
  }
  return homogeneous(std::move(net));
}

/// Scaled as a whole or in a component, moved, or turned in space: what vanished still does, except
/// where rounding moves points.
[[nodiscard]] inline Net placed(Net net, Random& random) {
  switch (random.below(6)) {
  case 0: {
    const double factor = std::ldexp(1, random.integer(-60, 60));
    return scaled_by(std::move(net), {factor, factor, factor});
  }
  case 1: {
    const double flat = std::ldexp(1, -random.integer(1, 20));
    const double narrow = std::ldexp(1, -random.integer(0, 12));
    return scaled_by(std::move(net), {1, flat, narrow});
  }
  case 2: {
    const double far = std::ldexp(1, random.integer(0, 12));
    return translated(std::move(net), {far, -far, 3 * far});
  }
  case 3:
    return rotated(std::move(net), random_rotation(random));
  default:
    return net;
  }
}

} // namespace simdbezier::tests
