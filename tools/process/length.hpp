// The length of a vector, with the same bits on every machine.
#pragma once

#include <array>
#include <cmath>

namespace simdbezier::tools {

/// Returns the length of a vector. It neither overflows nor underflows where the length itself does
/// not. Files state what depends on it, and std::hypot() of three numbers has other bits in another
/// standard library.
[[nodiscard]] inline double length_of(const std::array<double, 3>& v) {
  const double largest = std::fmax(std::fmax(std::abs(v[0]), std::abs(v[1])), std::abs(v[2]));
  if (std::isinf(largest)) {
    return largest;
  }
  int exponent = 0;
  static_cast<void>(std::frexp(largest, &exponent)); // 0 for 0
  const double x = std::ldexp(v[0], -exponent);
  const double y = std::ldexp(v[1], -exponent);
  const double z = std::ldexp(v[2], -exponent);
  return std::ldexp(std::sqrt(x * x + y * y + z * z), exponent);
}

} // namespace simdbezier::tools
