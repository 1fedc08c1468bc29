// Surfaces of any degree and their normals by the second look alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "src/exact/normal_fallback.hpp"

namespace simdbezier::tests {

using Point = std::array<double, 3>;

/// Points [j][i], and weights where there are any.
struct Surface {
  detail::NetShape shape;
  std::vector<Point> points;
  std::vector<double> weights;

  Surface(int degree_u, int degree_v, bool rational)
      : shape{degree_u, degree_v, 3, rational}, points(shape.points()),
        weights(shape.points(), 1.0) {}
  [[nodiscard]] std::size_t index(int j, int i) const {
    return static_cast<std::size_t>(j * (shape.degree_u + 1) + i);
  }
  [[nodiscard]] Point& at(int j, int i) { return points[index(j, i)]; }
};

struct Answer {
  Point normal;
  SampleStatus status;
};

/// The control values in the order of PatchStorage.
template <typename T>
std::vector<T> control_values(const Surface& surface) {
  std::vector<T> values;
  for (std::size_t k = 0; k < surface.points.size(); ++k) {
    for (const double value : surface.points[k]) {
      values.push_back(static_cast<T>(value));
    }
    if (surface.shape.rational) {
      values.push_back(static_cast<T>(surface.weights[k]));
    }
  }
  return values;
}

template <typename T>
detail::GivenPoints given_points(const Surface& surface, const std::vector<T>& values) {
  return {values.data(), sizeof(T) == sizeof(double),
          surface.shape.rational ? Weights::cartesian : Weights::none};
}

template <typename T>
Answer resolve(const Surface& surface, double x, double y) {
  const std::vector<T> values = control_values<T>(surface);
  const detail::GivenPoints given = given_points(surface, values);
  const detail::NormalQuery<T> query{&surface.shape, given.net(0), static_cast<T>(x),
                                     static_cast<T>(y)};
  T normal[3];
  const SampleStatus status = detail::resolve_normal(query, normal);
  return {{static_cast<double>(normal[0]), static_cast<double>(normal[1]),
           static_cast<double>(normal[2])},
          status};
}

inline double degrees_between(const Point& a, const Point& b) {
  const Point d{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return 180 / 3.14159265358979 * std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/// The same surface with one degree more in u (exact up to rounding).
inline Surface raised_u(const Surface& from) {
  const int m = from.shape.degree_u + 1;
  Surface to(m, from.shape.degree_v, from.shape.rational);
  for (int j = 0; j <= from.shape.degree_v; ++j) {
    for (int i = 0; i <= m; ++i) {
      const double a = static_cast<double>(i) / m;
      const std::size_t before = from.index(j, std::max(i - 1, 0));
      const std::size_t here = from.index(j, std::min(i, m - 1));
      double& w = to.weights[to.index(j, i)];
      w = a * from.weights[before] + (1 - a) * from.weights[here];
      for (std::size_t c = 0; c < 3; ++c) {
        to.at(j, i)[c] = from.points[before][c] == from.points[here][c]
                             ? from.points[here][c]
                             : (a * from.weights[before] * from.points[before][c] +
                                (1 - a) * from.weights[here] * from.points[here][c]) /
                                   w;
      }
    }
  }
  return to;
}

inline Surface exchanged(const Surface& from) {
  Surface to(from.shape.degree_v, from.shape.degree_u, from.shape.rational);
  for (int j = 0; j <= from.shape.degree_v; ++j) {
    for (int i = 0; i <= from.shape.degree_u; ++i) {
      to.at(i, j) = from.points[from.index(j, i)];
      to.weights[to.index(i, j)] = from.weights[from.index(j, i)];
    }
  }
  return to;
}

} // namespace simdbezier::tests
