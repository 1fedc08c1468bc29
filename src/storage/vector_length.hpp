// Lengths of vectors of any number of components.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace simdbezier::detail {

/// Returns the length of a vector. It neither overflows nor vanishes where the length itself does
/// not, and has the same bits everywhere: those of std::hypot() depend on the standard library.
inline double vector_length(std::span<const double> values) noexcept {
  double square = 0;
  double largest = 0;
  for (const double value : values) {
    square += value * value;
    largest = std::max(largest, std::fabs(value));
  }
  if ((square > 0x1p-900 && square < 0x1p900) || largest == 0 || !std::isfinite(largest)) {
    return std::sqrt(square);
  }
  const int exponent = std::ilogb(largest);
  square = 0;
  for (const double value : values) {
    const double scaled = std::scalbn(value, -exponent);
    square += scaled * scaled;
  }
  return std::scalbn(std::sqrt(square), exponent);
}

} // namespace simdbezier::detail
