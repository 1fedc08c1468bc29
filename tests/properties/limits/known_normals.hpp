// Normals that are known by hand, limits most of them.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/nets/shaped_nets.hpp"

namespace simdbezier::tests {

struct KnownNormal {
  const char* name;
  Net net;
  double x;
  double y;
  int order;
  Vector3 direction; ///< need not be of unit length
};

[[nodiscard]] inline Net net_of(int degree_u, int degree_v, std::vector<Vector3> points,
                                std::vector<double> weights = {}, bool homogeneous = false) {
  return {degree_u, degree_v, std::move(points), std::move(weights), homogeneous};
}

/// P[j][i] = (f_i (4j - 9), 12e-5 f_i, 4j), f = (0, 0, 1, 1).
[[nodiscard]] inline Net step_net() {
  return bicubic([](int j, int i) {
    const double f = i / 2;
    return Vector3{f * (4 * j - 9), 12e-5 * f, 4.0 * j};
  });
}

/// Surfaces that can be differentiated by hand.
[[nodiscard]] inline std::vector<KnownNormal> known_normals() {
  const Vector3 o{};
  return {
      // du = 0 along u = 0. With u = t/2 + …, f = 3 u^2 - 2 u^3 and S = (f (12 v - 9), 12e-5 f,
      // 12 v): du x dv = f' (12 v - 9, 12e-5, 0) x (12 f, 0, 12) = 12 f' (12e-5, 9 - 12 v, …); at
      // v = 3/4 + (1/2 - 3/4) t the first power of t has (12e-5, 0, 0).
      {"step of the issue", step_net(), -1, 0.5, 1, {1, 0, 0}},
      // S = (u, v, uv): nothing vanishes.
      {"saddle", net_of(1, 1, {o, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}), -1, -1, 0, {0, 0, 1}},
      // S = (u v, v, 0) has du x dv = (v, 0, 0) x (u, 1, 0) = (0, 0, v).
      {"pole of a triangle", net_of(1, 1, {o, o, {0, 1, 0}, {1, 1, 0}}), 0.5, -1, 1, {0, 0, 1}},
      // The same with weights: the limit stays, whatever they are.
      {"pole with weights",
       net_of(1, 1, {o, o, {0, 1, 0}, {1, 1, 0}}, {1, 1e-4, 1e-4, 1}),
       0.5,
       -1,
       1,
       {0, 0, 1}},
      // S = (u^2, v^2, 0) at the corner: 4 u v.
      {"squares",
       net_of(2, 2, {o, o, {1, 0, 0}, o, o, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 1, 0}}),
       -1,
       -1,
       2,
       {0, 0, 1}},
      // S = ((2u-1)^2, v, 0) in the middle, along (1, 1): du = 4 (2u - 1), from the right.
      {"fold in the middle",
       net_of(2, 1, {{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {1, 1, 0}}),
       0,
       0,
       1,
       {0, 0, 1}},
      // Seen from the left side of the middle it would be the other way round.
      {"fold left of the middle",
       net_of(2, 1, {{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {1, 1, 0}}),
       -0.5,
       0,
       0,
       {0, 0, -1}},
      {"line", net_of(1, 1, {o, {1, 2, 3}, {2, 4, 6}, {5, 10, 15}}), 0.25, -1, -1, o},
      // A sphere's octant: the pole looks up, the equator out.
      {"octant's pole", sphere_octant(), 0.25, 1, 1, {0, 0, 1}},
      {"octant's corner", sphere_octant(), -1, -1, 0, {1, 0, 0}},
      // Two rows and two columns are one point, a triangle's corner: S = (2 u^2, 2 v^2, 0) + …
      {"doubled rows and columns",
       net_of(2, 2, {o, o, {2, 0, 0}, o, o, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}}),
       -1,
       -1,
       2,
       {0, 0, 1}},
      // A pole at v = 0 of 2 x 2, with weights in a ratio of 1e4.
      {"pole of light points",
       net_of(2, 2, {o, o, o, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
              {1, 1, 1, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4}),
       -0.5,
       -1,
       1,
       {0, 0, -1}},
      // A homogeneous edge that is the point (1, 1, 1) with weights 1, 2.
      {"homogeneous edge",
       net_of(1, 1, {{1, 1, 1}, {2, 2, 2}, {0, 1, 1}, {1, 1, 0}}, {1, 2, 1, 1}, true),
       0.5,
       -1,
       1,
       {0, 1, 0}},
  };
}

[[nodiscard]] inline Vector3 unit(const Vector3& a) {
  const double length = std::hypot(a[0], a[1], a[2]);
  return length == 0 ? a : Vector3{a[0] / length, a[1] / length, a[2] / length};
}

} // namespace simdbezier::tests
