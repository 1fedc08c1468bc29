// Control nets of any degrees, with and without weights; see net_shapes.hpp for the rules on bits.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "tests/support/nets/net_shapes.hpp"

namespace simdbezier::tests {

struct Degrees {
  int u = 3;
  int v = 3;
  friend bool operator==(const Degrees&, const Degrees&) = default;
};

/// A net whose point (j, i) is make(j, i), rows first.
template <typename Make>
[[nodiscard]] Net shaped_net(Degrees degrees, Make make) {
  Net net{degrees.u, degrees.v, {}};
  for (int j = 0; j <= degrees.v; ++j) {
    for (int i = 0; i <= degrees.u; ++i) {
      net.points.push_back(make(j, i));
    }
  }
  return net;
}

/// A height field over [-1,1]^2 on slightly uneven lines.
[[nodiscard]] inline Net shaped_wave_net(Degrees degrees, Random& random) {
  const double step_u = 2.0 / degrees.u;
  const double step_v = 2.0 / degrees.v;
  return shaped_net(degrees, [&](int j, int i) {
    return Vector3{i * step_u - 1 + 0.3 * step_u * random.symmetric(),
                   j * step_v - 1 + 0.3 * step_v * random.symmetric(), 0.5 * random.symmetric()};
  });
}

[[nodiscard]] inline Net shaped_random_net(Degrees degrees, Random& random) {
  return shaped_net(degrees, [&](int, int) {
    return Vector3{random.symmetric(), random.symmetric(), random.symmetric()};
  });
}

[[nodiscard]] inline Net shaped_signs_net(Degrees degrees, Random& random) {
  return shaped_net(degrees, [&](int, int) {
    return Vector3{random.sign(), random.sign(), random.sign()};
  });
}

[[nodiscard]] inline Net shaped_offset_net(Degrees degrees, Random& random, double distance) {
  const Net net = shaped_wave_net(degrees, random);
  return translated(net,
                    {distance * random.sign(), distance * random.sign(), distance * random.sign()});
}

/// ratio^(k/16 - 1/2), by roots and products only.
[[nodiscard]] inline double graded_weight(double ratio, int k) {
  const double step = std::sqrt(std::sqrt(std::sqrt(std::sqrt(ratio))));
  double weight = 1 / std::sqrt(ratio);
  for (; k > 0; --k) {
    weight *= step;
  }
  return weight;
}

/// The same points with weights whose largest is `ratio` times the smallest (a ratio of 1 gives
/// weights that are all equal, and a polynomial surface by the rational way).
[[nodiscard]] inline Net weighted(Net net, double ratio, Random& random) {
  net.weights.clear();
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    net.weights.push_back(graded_weight(ratio, random.integer(0, 16)));
  }
  const std::size_t heavy = random.below(net.points.size());
  const std::size_t light = (heavy + 1 + random.below(net.points.size() - 1)) % net.points.size();
  net.weights[heavy] = graded_weight(ratio, 16);
  net.weights[light] = graded_weight(ratio, 0);
  return net;
}

/// Returns the surface in homogeneous coordinates, up to the rounding of the products.
[[nodiscard]] inline Net homogeneous(Net net) {
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    for (double& value : net.points[k]) {
      value *= net.weights[k];
    }
  }
  net.homogeneous = true;
  return net;
}

/// (i, j) -> (j, i): u and v change places.
[[nodiscard]] inline Net transposed(const Net& net) {
  Net result{net.degree_v, net.degree_u, {}, {}, net.homogeneous};
  for (int i = 0; i <= net.degree_u; ++i) {
    for (int j = 0; j <= net.degree_v; ++j) {
      result.points.push_back(net.at(j, i));
      if (net.is_rational()) {
        result.weights.push_back(net.weight(j, i));
      }
    }
  }
  return result;
}

/// u -> 1-u.
[[nodiscard]] inline Net reversed_u(Net net) {
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i < net.degree_u - i; ++i) {
      std::swap(net.at(j, i), net.at(j, net.degree_u - i));
      if (net.is_rational()) {
        std::swap(net.weight(j, i), net.weight(j, net.degree_u - i));
      }
    }
  }
  return net;
}

/// The surface itself, one degree higher in u: Q_i = (i P_{i-1} + (n+1-i) P_i) / (n+1). Exact where
/// the points (and weights) are multiples of n+1 with bits to spare. Weights: homogeneous only.
[[nodiscard]] inline Net elevated_u(const Net& net) {
  const int degree = net.degree_u + 1;
  const auto mix = [&](double before, double here, int i) {
    return (i * before + (degree - i) * here) / degree;
  };
  Net result{degree, net.degree_v, {}, {}, net.homogeneous};
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= degree; ++i) {
      const int before = std::max(i - 1, 0);
      const int here = std::min(i, net.degree_u);
      Vector3 point;
      for (std::size_t c = 0; c < 3; ++c) {
        point[c] = mix(net.at(j, before)[c], net.at(j, here)[c], i);
      }
      result.points.push_back(point);
      if (net.is_rational()) {
        result.weights.push_back(mix(net.weight(j, before), net.weight(j, here), i));
      }
    }
  }
  return result;
}

/// The octant of the unit sphere, biquadratic, all of its numbers small integers: the quarter
/// circle ((1-t^2), 2t) / (1+t^2) has the points (1,0), (1,1), (0,1) with weights 1, 1, 2. u runs
/// along the equator, v up to the pole, where the side v = 1 is one point; the normal points
/// outwards.
[[nodiscard]] inline Net sphere_octant() {
  constexpr double kAlong[3] = {1, 1, 0};
  constexpr double kUp[3] = {0, 1, 1};
  constexpr double kWeights[3] = {1, 1, 2};
  Net net{2, 2, {}};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      net.points.push_back({kAlong[j] * kAlong[i], kAlong[j] * kUp[i], kUp[j]});
      net.weights.push_back(kWeights[i] * kWeights[j]);
    }
  }
  return net;
}

} // namespace simdbezier::tests
