// A square sheet of bicubic patches that share their edges, bent up and down in turns.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace seed {

/// side x side patches over [0, side]^2: 16 control points each, u fastest.
inline std::vector<std::array<float, 3>> wavy_sheet(std::size_t side) {
  std::vector<std::array<float, 3>> points;
  for (std::size_t patch = 0; patch < side * side; ++patch) {
    for (std::size_t k = 0; k < 16; ++k) {
      const auto x = static_cast<float>(3 * (patch % side) + k % 4) / 3;
      const auto y = static_cast<float>(3 * (patch / side) + k / 4) / 3;
      points.push_back({x, y, std::sin(2 * x) * std::cos(y) / 2});
    }
  }
  return points;
}

} // namespace seed
