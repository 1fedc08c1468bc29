// Points in space, and the one operation that everything else is made of: mixing two of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace seed {

struct Point {
  double x = 0;
  double y = 0;
  double z = 0;
};

constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Point operator*(double s, Point a) { return {s * a.x, s * a.y, s * a.z}; }

/// (1-t) a + t b.
constexpr Point mix(Point a, Point b, double t) { return (1 - t) * a + t * b; }

constexpr Point cross(Point a, Point b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(Point a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

/// The largest difference of a component.
inline double distance(Point a, Point b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

/// x y z, x y z, …: the form in which the library reads control points by default.
template <typename T>
std::vector<T> coordinates(const std::vector<Point>& points) {
  std::vector<T> values;
  for (const Point& p : points) {
    values.insert(values.end(), {static_cast<T>(p.x), static_cast<T>(p.y), static_cast<T>(p.z)});
  }
  return values;
}

/// The k-th of such triples.
template <typename T>
Point point_at(const std::vector<T>& values, std::size_t k) {
  return {static_cast<double>(values[3 * k]), static_cast<double>(values[3 * k + 1]),
          static_cast<double>(values[3 * k + 2])};
}

} // namespace seed
