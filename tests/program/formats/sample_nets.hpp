// Patches as text, for tests that need a file of their own.
#pragma once

#include <charconv>
#include <span>
#include <string>
#include <vector>

#include "tests/support/nets/net.hpp"

namespace simdbezier::tests {

/// The unit square in the plane z = 0: S(u,v) = (u, v, 0), normal +z.
[[nodiscard]] inline Net flat_net() {
  Net net;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      net.at(j, i) = {i / 3.0, j / 3.0, 0};
    }
  }
  return net;
}

/// S(u,v) = (u + u^2 v, v + u v^2, u^2 + 3 u v - v^2 / 2); as cubics, u has the control values i/3
/// and u^2 has 0, 0, 1/3, 1.
[[nodiscard]] inline Net quadratic_net() {
  constexpr double kSquare[] = {0, 0, 1 / 3.0, 1};
  Net net;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const double u = i / 3.0;
      const double v = j / 3.0;
      net.at(j, i) = {u + kSquare[i] * v, v + u * kSquare[j],
                      kSquare[i] + 3 * u * v - kSquare[j] / 2};
    }
  }
  return net;
}

/// Different control points for every number.
[[nodiscard]] inline Net distinct_net(int number) {
  Net net;
  for (int k = 0; k < 16; ++k) {
    const double value = number * 100 + k;
    net.points[static_cast<std::size_t>(k)] = {value, value / 7, -value};
  }
  return net;
}

[[nodiscard]] inline std::string number_text(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

/// Sixteen lines of x y z.
[[nodiscard]] inline std::string points_text(const Net& net) {
  std::string text;
  for (const Vector3& point : net.points) {
    text +=
        number_text(point[0]) + " " + number_text(point[1]) + " " + number_text(point[2]) + "\n";
  }
  return text;
}

[[nodiscard]] inline std::string bez_text(std::span<const Net> nets) {
  std::string text = std::to_string(nets.size()) + "\n";
  for (const Net& net : nets) {
    text += points_text(net);
  }
  return text;
}

} // namespace simdbezier::tests
