// Rational nets with a side that is one point up to roundings, and what is known of them without
// the library.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/random.hpp"

namespace simdbezier::tests {

/// Sides: v = 0, v = 1, u = 0, u = 1.
struct PoleShape {
  int degree_u;
  int degree_v;
  int side;
  Weights form;

  [[nodiscard]] bool along_u() const { return side < 2; }
  [[nodiscard]] bool at_end() const { return side % 2 != 0; }
  /// The degree along the side, and across it.
  [[nodiscard]] int along() const { return along_u() ? degree_u : degree_v; }
  [[nodiscard]] int across() const { return along_u() ? degree_v : degree_u; }
  /// Where point k along the side stands in the line number `line` from it.
  [[nodiscard]] std::size_t at(int line, int k) const {
    const int l = at_end() ? across() - line : line;
    return static_cast<std::size_t>(along_u() ? l * (degree_u + 1) + k : k * (degree_u + 1) + l);
  }
};

using Point3L = std::array<long double, 3>;

inline Point3L cross(const Point3L& a, const Point3L& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline long double distance(const Point3L& a, const Point3L& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
inline Point3L unit(Point3L a) {
  const long double size = distance(a, {0, 0, 0});
  for (long double& x : a) {
    x /= size;
  }
  return a;
}

/// Numbers as they stand in files: their products and quotients are rounded.
inline double decimal(Random& random, int low, int high) {
  return random.integer(low, high) / 10.0;
}

/// One net, x y z w.
template <typename T>
struct PoleNet {
  PoleShape shape;
  std::vector<T> values;

  [[nodiscard]] ControlNets<T> nets() const {
    return ControlNets<T>::packed(values.data(), 1, shape.degree_u, shape.degree_v, 3, shape.form);
  }
  [[nodiscard]] long double weight(std::size_t point) const { return values[4 * point + 3]; }
  [[nodiscard]] Point3L point(std::size_t at) const {
    Point3L p;
    for (std::size_t c = 0; c < 3; ++c) {
      p[c] = values[4 * at + c];
      p[c] /= shape.form == Weights::homogeneous ? weight(at) : 1;
    }
    return p;
  }

  /// The normal at parameter t of the side: with h = w (P - O) around the point O, the first line
  /// that is not O has the curve A(t) = sum h_k B_k(t), du x dv has the direction of A' x A at
  /// v = 0, and others by symmetry.
  [[nodiscard]] Point3L normal(long double t, int line = 1) const {
    const int n = shape.along();
    const Point3L pole = point(shape.at(0, 0));
    Point3L a{};
    Point3L slope{};
    for (int k = 0; k <= n; ++k) {
      const auto bernstein = [&](int degree, int i) {
        return i < 0 || i > degree ? 0.0L
                                   : std::exp(std::lgamma(degree + 1.0L) - std::lgamma(i + 1.0L) -
                                              std::lgamma(degree - i + 1.0L)) *
                                         std::pow(t, static_cast<long double>(i)) *
                                         std::pow(1 - t, static_cast<long double>(degree - i));
      };
      const std::size_t at = shape.at(line, k);
      const Point3L p = point(at);
      for (std::size_t c = 0; c < 3; ++c) {
        const long double h = weight(at) * (p[c] - pole[c]);
        a[c] += h * bernstein(n, k);
        slope[c] += h * (bernstein(n - 1, k - 1) - bernstein(n - 1, k));
      }
    }
    return unit(shape.along_u() != shape.at_end() ? cross(slope, a) : cross(a, slope));
  }
};

/// A dish around a pole, as large as `radius`, whose values are rounded as a program would that
/// multiplies points by weights, or reads them from a file. scale: of all weights.
template <typename T>
PoleNet<T> pole_net(const PoleShape& shape, double radius, double scale, Random& random) {
  PoleNet<T> net{shape, std::vector<T>(static_cast<std::size_t>(4 * (shape.degree_u + 1) *
                                                                (shape.degree_v + 1)))};
  const double pole[3] = {radius * decimal(random, -30, 30), radius * decimal(random, -30, 30),
                          radius * decimal(random, 1, 100)};
  const int axis = random.integer(0, 2);
  for (int line = 0; line <= shape.across(); ++line) {
    for (int k = 0; k <= shape.along(); ++k) {
      const double angle = 1.5 * k / shape.along() + 0.1 * random.unit();
      const double reach = radius * line;
      const double way[3] = {reach * std::cos(angle), reach * std::sin(angle),
                             reach * (-0.4 - 0.2 * line)};
      const auto weight = static_cast<T>(scale * decimal(random, 1, 30));
      T* const to = net.values.data() + 4 * shape.at(line, k);
      for (int c = 0; c < 3; ++c) {
        const double x = pole[c] + way[(c + axis) % 3];
        to[c] = static_cast<T>(shape.form == Weights::homogeneous ? x * static_cast<double>(weight)
                                                                  : x);
      }
      to[3] = weight;
    }
  }
  return net;
}

} // namespace simdbezier::tests
