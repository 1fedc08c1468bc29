// One control net as tests hold it: doubles, whatever type is under test.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace simdbezier::tests {

using Vector3 = std::array<double, 3>;

/// Control points P[j][i] at points[j*(degree_u+1)+i]: i runs in u, j in v, u fastest.
struct Net {
  int degree_u = 3;
  int degree_v = 3;
  std::vector<Vector3> points = std::vector<Vector3>(16, Vector3{});
  std::vector<double> weights = {}; ///< one a point; empty: polynomial
  bool homogeneous = false;         ///< with weights: points hold w x, w y, w z

  [[nodiscard]] bool is_rational() const { return !weights.empty(); }
  [[nodiscard]] bool is_bicubic() const { return degree_u == 3 && degree_v == 3 && !is_rational(); }

  [[nodiscard]] const Vector3& at(int j, int i) const { return points[index(j, i)]; }
  [[nodiscard]] Vector3& at(int j, int i) { return points[index(j, i)]; }
  [[nodiscard]] double weight(int j, int i) const {
    return weights.empty() ? 1 : weights[index(j, i)];
  }
  [[nodiscard]] double& weight(int j, int i) { return weights[index(j, i)]; }

private:
  [[nodiscard]] std::size_t index(int j, int i) const {
    return static_cast<std::size_t>(j * (degree_u + 1) + i);
  }
};

/// A patch parameter as an evaluator gets it: u, v in T and the centred x, y they become. Where
/// a family measures at centred parameters, u and v are the nearest values of T.
template <typename T>
struct Parameters2 {
  T u = 0;
  T v = 0;
  T x = -1;
  T y = -1;
};

/// The documented conversion: fma(2, u, -1) in double, rounded once to T.
template <typename T>
[[nodiscard]] inline T centred_from_unit(T u) {
  return static_cast<T>(std::fma(2.0, static_cast<double>(u), -1.0));
}

template <typename T>
[[nodiscard]] inline Parameters2<T> at_unit(T u, T v) {
  return {u, v, centred_from_unit(u), centred_from_unit(v)};
}

template <typename T>
[[nodiscard]] inline Parameters2<T> at_centred(T x, T y) {
  return {static_cast<T>((1.0 + static_cast<double>(x)) / 2),
          static_cast<T>((1.0 + static_cast<double>(y)) / 2), x, y};
}

/// The unit roundoff: half the distance from 1 to the next number.
template <typename T>
inline constexpr double kUnitRoundoff = sizeof(T) == 4 ? 0x1p-24 : 0x1p-53;

/// The net's control points themselves, without weights: what errors of a rational patch are
/// measured against, and the net itself where it is polynomial. (Homogeneous points are divided in
/// double, which is exact enough for a scale.)
[[nodiscard]] inline Net control_polygon(Net net) {
  for (std::size_t k = 0; k < net.points.size() && net.homogeneous && net.is_rational(); ++k) {
    for (double& value : net.points[k]) {
      value /= net.weights[k];
    }
  }
  net.weights.clear();
  net.homogeneous = false;
  return net;
}

/// max |P| of one component over a polynomial net: what position bounds are relative to.
[[nodiscard]] inline double largest_coordinate(const Net& net, std::size_t component) {
  double largest = 0;
  for (const Vector3& point : net.points) {
    largest = std::max(largest, std::abs(point[component]));
  }
  return largest;
}

/// max |degree * (next - previous)| of one component in u: what bounds on dS/du are relative to.
[[nodiscard]] inline double largest_hodograph_u(const Net& net, std::size_t component) {
  double largest = 0;
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i < net.degree_u; ++i) {
      const double step = net.at(j, i + 1)[component] - net.at(j, i)[component];
      largest = std::max(largest, std::abs(net.degree_u * step));
    }
  }
  return largest;
}

/// max |degree * (next - previous)| of one component in v: what bounds on dS/dv are relative to.
[[nodiscard]] inline double largest_hodograph_v(const Net& net, std::size_t component) {
  double largest = 0;
  for (int j = 0; j < net.degree_v; ++j) {
    for (int i = 0; i <= net.degree_u; ++i) {
      const double step = net.at(j + 1, i)[component] - net.at(j, i)[component];
      largest = std::max(largest, std::abs(net.degree_v * step));
    }
  }
  return largest;
}

/// Rounds every coordinate to T, so that a net means the same to the evaluator and the oracle.
template <typename T>
[[nodiscard]] inline Net rounded_to(Net net) {
  for (Vector3& point : net.points) {
    for (double& value : point) {
      value = static_cast<double>(static_cast<T>(value));
    }
  }
  for (double& value : net.weights) {
    value = static_cast<double>(static_cast<T>(value));
  }
  return net;
}

/// The control points of many nets of one shape, packed: x y z, and w where they have weights.
template <typename T>
[[nodiscard]] inline std::vector<T> packed_points(std::span<const Net> nets) {
  std::vector<T> values;
  for (const Net& net : nets) {
    for (std::size_t k = 0; k < net.points.size(); ++k) {
      for (const double value : net.points[k]) {
        values.push_back(static_cast<T>(value));
      }
      if (net.is_rational()) {
        values.push_back(static_cast<T>(net.weights[k]));
      }
    }
  }
  return values;
}

} // namespace simdbezier::tests
