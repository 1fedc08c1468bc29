// Curves whose tangents vanish somewhere, as nets of degree_v 0; see degenerate_nets.hpp.
#pragma once

#include "tests/support/nets/degenerate_nets.hpp"

namespace simdbezier::tests {

/// The first row of any net.
[[nodiscard]] inline Net any_curve(int degree, Random& random) {
  Net net = any_net({degree, 1}, random);
  net.degree_v = 0;
  net.points.resize(static_cast<std::size_t>(degree) + 1);
  return net;
}

[[nodiscard]] inline SingularNet repeated_points(Net curve, int points) {
  for (int i = 1; i < points; ++i) {
    curve.at(0, i) = curve.at(0, 0);
  }
  return {std::move(curve), -1, 0};
}

[[nodiscard]] inline SingularNet cusp_of_curve(int degree, Random& random) {
  const double t0 = quarter(random);
  const int order = random.integer(1, 2);
  return {
      net_of_powers({degree, 0}, t0, 0,
                    [&](int a, int) { return a <= order ? Vector3{} : integer_vector(random, 3); }),
      2 * t0 - 1, 0};
}

[[nodiscard]] inline SingularNet straight_curve(int degree, Random& random) {
  const Vector3 direction = integer_vector(random, 5);
  return {shaped_net({degree, 0},
                     [&](int, int) {
                       const double along = random.integer(-3, 3);
                       return plus({}, along, direction);
                     }),
          0, 0};
}

/// Three quarters of all points fall together, and the last ones weigh next to nothing.
[[nodiscard]] inline SingularNet light_end(int degree, Random& random) {
  SingularNet result = repeated_points(any_curve(degree, random), 3 * degree / 4 + 1);
  for (int i = 0; i <= degree; ++i) {
    result.net.weights.push_back(4 * i > 3 * degree ? graded_weight(1e-10, 16) : 1);
  }
  return result;
}

struct SingularCurveRow {
  const char* name;
  SingularNet (*make)(int degree, Random&);
};

inline constexpr SingularCurveRow kSingularCurveRows[] = {
    {"two_points_equal", [](int n, Random& r) { return repeated_points(any_curve(n, r), 2); }},
    {"points_equal",
     [](int n, Random& r) {
       const int points = r.integer(2, n + 1);
       return repeated_points(any_curve(n, r), points);
     }},
    {"cusp", cusp_of_curve},
    {"straight", straight_curve},
    {"light_end", light_end},
    {"regular",
     [](int n, Random& r) {
       return SingularNet{any_curve(n, r), 0, 0};
     }},
};

} // namespace simdbezier::tests
