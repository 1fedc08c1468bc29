// Control nets whose normals vanish somewhere, each a function of a random stream; see
// net_shapes.hpp for the rules on bits. What vanishes does so exactly, so that limits exist: points
// are copied, or they are small integers of which sums and products cancel without rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "tests/support/nets/power_nets.hpp"

namespace simdbezier::tests {

/// A net and a place (centred) where it is singular.
struct SingularNet {
  Net net;
  double x = -1;
  double y = -1;
};

[[nodiscard]] inline Vector3 integer_vector(Random& random, int most) {
  const double x = random.integer(-most, most);
  const double y = random.integer(-most, most);
  const double z = random.integer(-most, most);
  return {x, y, z};
}

/// A height field, anything, or small integers.
[[nodiscard]] inline Net any_net(Degrees degrees, Random& random) {
  switch (random.below(3)) {
  case 0:
    return shaped_wave_net(degrees, random);
  case 1:
    return shaped_random_net(degrees, random);
  default:
    return shaped_net(degrees, [&](int, int) { return integer_vector(random, 9); });
  }
}

/// 0, 1/4, …, 1
[[nodiscard]] inline double quarter(Random& random) { return random.integer(0, 4) / 4.0; }

/// The first powers in u and v as `slopes` makes them of two integer vectors; all others free, but
/// S = 0 at the point, so that weights may be chosen freely (see weighted_numerators).
template <typename Slopes>
[[nodiscard]] SingularNet singular_inside(Degrees degrees, Random& random, Slopes slopes) {
  const double u0 = quarter(random);
  const double v0 = quarter(random);
  Vector3 first = integer_vector(random, 3);
  Vector3 second = integer_vector(random, 3);
  slopes(first, second);
  return {net_of_powers(degrees, u0, v0,
                        [&](int a, int b) {
                          if (a + b == 1) {
                            return a == 1 ? first : second;
                          }
                          return a + b == 0 ? Vector3{} : integer_vector(random, 2);
                        }),
          2 * u0 - 1, 2 * v0 - 1};
}

// --- the kinds, at v = 0 or at the corner (0, 0) ------------------------------------------------

/// The first `rows` rows become one row, the first `columns` columns one column.
[[nodiscard]] inline SingularNet repeated(Net net, int rows, int columns) {
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= net.degree_u; ++i) {
      net.at(j, i) = net.at(j < rows ? 0 : j, i < columns ? 0 : i);
    }
  }
  return {std::move(net)};
}

/// The first `rows` rows become one point.
[[nodiscard]] inline SingularNet collapsed(Net net, int rows) {
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i <= net.degree_u; ++i) {
      net.at(j, i) = net.at(0, 0);
    }
  }
  return {std::move(net)};
}

[[nodiscard]] inline SingularNet both_edges_collapsed(Degrees d, Random& random) {
  SingularNet result = collapsed(any_net(d, random), 1);
  for (int i = 1; i <= d.u; ++i) {
    result.net.at(d.v, i) = result.net.at(d.v, 0);
  }
  return result;
}
[[nodiscard]] inline SingularNet neighbouring_edges_collapsed(Degrees d, Random& random) {
  SingularNet result = collapsed(any_net(d, random), 1);
  for (int j = 1; j <= d.v; ++j) {
    result.net.at(j, 0) = result.net.at(0, 0);
  }
  return result;
}
[[nodiscard]] inline SingularNet collapsed_corner(Degrees d, Random& random) {
  SingularNet result{any_net(d, random)};
  Net& net = result.net;
  net.at(0, 1) = net.at(0, 0);
  const auto more = random.below(3);
  net.at(1, 0) = more > 0 ? net.at(0, 0) : net.at(1, 0);
  net.at(1, 1) = more > 1 ? net.at(0, 0) : net.at(1, 1);
  return result;
}
/// du and dv parallel at the corner: in a plane, or with a twist that leaves it.
[[nodiscard]] inline SingularNet flat_corner(Degrees d, Random& random) {
  SingularNet result{shaped_net(d, [&](int, int) { return integer_vector(random, 9); })};
  Net& net = result.net;
  const Vector3 direction = integer_vector(random, 3);
  const double along_u = random.integer(-3, 3);
  const double along_v = random.integer(-3, 3);
  net.at(0, 1) = plus(net.at(0, 0), along_u, direction);
  net.at(1, 0) = plus(net.at(0, 0), along_v, direction);
  if (random.below(2) == 0) {
    for (Vector3& point : net.points) {
      point[2] = 0;
    }
  }
  return result;
}
/// Returns such a net whose products have twice the digits of a type: of float with 11 bits, of
/// double with 25.
[[nodiscard]] inline SingularNet long_cancellation(Degrees d, Random& random) {
  const int most = random.below(2) == 0 ? (1 << 11) - 1 : (1 << 25) - 1;
  SingularNet result{shaped_net(d, [&](int, int) { return integer_vector(random, most); })};
  const Vector3 direction = integer_vector(random, most);
  const double along_u = random.integer(-most, most);
  const double along_v = random.integer(-most, most);
  result.net.at(0, 0) = {};
  result.net.at(0, 1) = plus({}, along_u, direction);
  result.net.at(1, 0) = plus({}, along_v, direction);
  return result;
}
/// du and dv parallel along all of v = 0.
[[nodiscard]] inline SingularNet two_rows_on_a_line(Degrees d, Random& random) {
  SingularNet result{shaped_net(d, [&](int, int) { return integer_vector(random, 9); })};
  const Vector3 direction = integer_vector(random, 5);
  const Vector3 start = integer_vector(random, 5);
  for (int j = 0; j <= 1; ++j) {
    for (int i = 0; i <= d.u; ++i) {
      const double along = random.integer(-9, 9);
      result.net.at(j, i) = plus(start, along, direction);
    }
  }
  return result;
}
[[nodiscard]] inline SingularNet point_or_line(Degrees d, Random& random) {
  const Vector3 direction = random.below(4) == 0 ? Vector3{} : integer_vector(random, 5);
  const Vector3 start = integer_vector(random, 5);
  return {shaped_net(d, [&](int, int) {
    const double along = random.integer(-9, 9);
    return plus(start, along, direction);
  })};
}
/// A curve C(a u + b v), a parabola where the degrees allow: du x dv cancels everywhere.
[[nodiscard]] inline SingularNet sheet_that_is_a_curve(Degrees d, Random& random) {
  const double along_u = random.integer(-2, 2);
  const double along_v = random.integer(-2, 2);
  const Vector3 first = integer_vector(random, 4);
  const Vector3 second = d.u >= 2 && d.v >= 2 ? integer_vector(random, 4) : Vector3{};
  const auto value = [](int n, int a, int i) { // of u^a, times n (n - 1)
    return a == 0 ? n * (n - 1.0) : a == 1 ? (n - 1.0) * i : i * (i - 1.0);
  };
  return {shaped_net(d, [&](int j, int i) {
    // first (a u + b v) + second (a u + b v)^2, times m (m - 1) n (n - 1) (or 1 where that is 0)
    if (d.u < 2 || d.v < 2) {
      return plus({}, along_u * i * d.v + along_v * j * d.u, first);
    }
    const auto product = [&](int a, int b) { return value(d.u, a, i) * value(d.v, b, j); };
    const double line = along_u * product(1, 0) + along_v * product(0, 1);
    const double square = along_u * along_u * product(2, 0) +
                          2 * along_u * along_v * product(1, 1) + along_v * along_v * product(0, 2);
    return plus(plus({}, line, first), square, second);
  })};
}
/// A step in u whose features in y are much smaller than the patch.
[[nodiscard]] inline SingularNet small_features(Degrees d, Random& random) {
  const double size = 12 * std::sqrt(graded_weight(1e-10, random.integer(0, 16)) * 1e-5);
  return {shaped_net(d, [&](int j, int i) {
    const double f = 2 * i > d.u ? 1 : 0;
    return Vector3{f * (4.0 * j - 3.0 * d.v), size * f, 4.0 * j};
  })};
}

using MakeSingular = SingularNet (*)(Degrees, Random&);

struct SingularRow {
  const char* name;
  MakeSingular make;
};

inline constexpr SingularRow kSingularRows[] = {
    {"collapsed_edge", [](Degrees d, Random& r) { return collapsed(any_net(d, r), 1); }},
    {"collapsed_edge_integers",
     [](Degrees d, Random& r) {
       return collapsed(shaped_net(d, [&](int, int) { return integer_vector(r, 3); }), 1);
     }},
    {"both_edges_collapsed", both_edges_collapsed},
    {"neighbouring_edges_collapsed", neighbouring_edges_collapsed},
    {"two_rows_collapsed", [](Degrees d, Random& r) { return collapsed(any_net(d, r), 2); }},
    {"doubled_row", [](Degrees d, Random& r) { return repeated(any_net(d, r), 2, 1); }},
    {"repeated_rows",
     [](Degrees d, Random& r) { return repeated(any_net(d, r), r.integer(2, d.v + 1), 1); }},
    {"repeated_rows_and_columns",
     [](Degrees d, Random& r) {
       const int rows = r.integer(2, std::min(d.v + 1, 4));
       return repeated(any_net(d, r), rows, r.integer(2, std::min(d.u + 1, 4)));
     }},
    {"collapsed_corner", collapsed_corner},
    {"flat_corner", flat_corner},
    {"long_cancellation", long_cancellation},
    {"two_rows_on_a_line", two_rows_on_a_line},
    {"point_or_line", point_or_line},
    {"sheet_that_is_a_curve", sheet_that_is_a_curve},
    {"small_features", small_features},
    {"cusp_inside",
     [](Degrees d, Random& r) {
       return singular_inside(d, r, [](Vector3& a, Vector3& b) { a = b = {}; });
     }},
    {"half_cusp_inside",
     [](Degrees d, Random& r) {
       return singular_inside(d, r, [](Vector3& a, Vector3&) { a = {}; });
     }},
    {"parallel_inside",
     [](Degrees d, Random& r) {
       const double factor = r.integer(-2, 2);
       return singular_inside(d, r, [&](Vector3& a, Vector3& b) { b = plus({}, factor, a); });
     }},
    {"regular",
     [](Degrees d, Random& r) {
       return SingularNet{any_net(d, r), 0, 0};
     }},
};

// --- sides --------------------------------------------------------------------------------------

[[nodiscard]] inline SingularNet transposed(const SingularNet& from) {
  return {transposed(from.net), from.y, from.x};
}
[[nodiscard]] inline SingularNet reversed_u(SingularNet from) {
  return {reversed_u(std::move(from.net)), -from.x, from.y};
}

/// One of the eight ways to lay u and v.
[[nodiscard]] inline SingularNet turned(SingularNet from, unsigned way) {
  from = (way & 1) != 0 ? reversed_u(std::move(from)) : from;
  from = (way & 2) != 0 ? transposed(reversed_u(transposed(from))) : from;
  return (way & 4) != 0 ? transposed(from) : from;
}

} // namespace simdbezier::tests
