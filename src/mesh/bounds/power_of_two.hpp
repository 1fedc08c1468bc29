// Factors that change no digit of a number.
#pragma once

#include <cmath>

namespace simdbezier::detail {

/// A power of two. Products are rounded only where they are below the smallest normal number, once.
class PowerOfTwo {
public:
  PowerOfTwo() = default;
  explicit PowerOfTwo(int exponent)
      : exponent_(exponent),
        factor_(exponent >= kLeast && exponent <= kMost ? std::scalbn(1.0, exponent) : 0) {}

  [[nodiscard]] PowerOfTwo inverse() const { return PowerOfTwo(-exponent_); }

  friend double operator*(double a, const PowerOfTwo& b) {
    return b.factor_ != 0 ? a * b.factor_ : std::scalbn(a, b.exponent_);
  }

private:
  static constexpr int kLeast = -1022; ///< of factors that are numbers of full precision
  static constexpr int kMost = 1023;

  int exponent_ = 0;
  double factor_ = 1; ///< 0 where it is none of those
};

/// The one at or below |x| > 0.
inline PowerOfTwo power_of_two_below(double x) { return PowerOfTwo(std::ilogb(x)); }

} // namespace simdbezier::detail
