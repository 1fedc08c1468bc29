// Doubles that know how wrong they may be: the quick way to certify that something is not zero.
//
// Source: J. H. Wilkinson, Rounding Errors in Algebraic Processes, 1963 (running error analysis).
#pragma once

#include <cmath>

#include "src/exact/quantities.hpp"

namespace simdbezier::detail {

/// The true number lies within `error` of `value`. Left uninitialised, because tables have many.
struct Bounded {
  double value;
  double error;
};

/// The arithmetic of such numbers. A number whose error is zero is exact; an exact zero thus comes
/// from zero factors and equal terms only, and certifies that the true number is zero.
///
/// Every rounding counts as twice as large as it can be, which covers the roundings of the bounds
/// themselves. Where something overflows, values or bounds are infinite or nan, which certifies
/// nothing.
class BoundedField {
public:
  using Value = Bounded;

  /// The largest point and weight: both kinds are brought to a size of about 1, so that products of
  /// a few of them stay in range.
  BoundedField(double largest_point, double largest_weight)
      : scale_{inverse_power(largest_point), inverse_power(largest_weight), 1, 1} {}

  [[nodiscard]] Value number(Quantity kind, double value) const {
    const double scaled = value * scale_[kind];
    return {scaled, std::fabs(scaled) < kSmallest && value != 0 ? kSmallest : 0};
  }
  /// Numbers of a kind have been multiplied by two to this power.
  [[nodiscard]] int scale_exponent(Quantity kind) const { return std::ilogb(scale_[kind]); }

  [[nodiscard]] static Value zero() { return {0, 0}; }
  [[nodiscard]] static Value one() { return {1, 0}; }
  [[nodiscard]] static Value integer(std::uint32_t value) {
    return {static_cast<double>(value), 0};
  }
  [[nodiscard]] static bool vanishes(const Value& a) { return a.value == 0 && a.error == 0; }

  [[nodiscard]] static Value add(const Value& a, const Value& b) {
    return rounded_sum(a.value + b.value, a, b);
  }
  [[nodiscard]] static Value subtract(const Value& a, const Value& b) {
    return rounded_sum(a.value - b.value, a, b);
  }
  [[nodiscard]] static Value multiply(const Value& a, const Value& b) {
    if (vanishes(a) || vanishes(b)) {
      return zero();
    }
    const double product = a.value * b.value;
    double error = std::fabs(a.value) * b.error + a.error * (std::fabs(b.value) + b.error) +
                   kUnit * std::fabs(product);
    if (!(std::fabs(product) >= kSmallest)) {
      error += kSmallest;
    }
    return {product, error};
  }
  /// a b + c
  [[nodiscard]] static Value multiply_add(const Value& a, const Value& b, const Value& c) {
    return vanishes(a) || vanishes(b) ? c : add(multiply(a, b), c);
  }
  /// c - a b
  [[nodiscard]] static Value subtract_product(const Value& a, const Value& b, const Value& c) {
    return vanishes(a) || vanishes(b) ? c : subtract(c, multiply(a, b));
  }
  /// a b - c d of exact numbers, which is zero exactly where the products are equal: homogeneous
  /// points that are one point are told apart from all others.
  [[nodiscard]] static Value determinant(const Value& a, const Value& b, const Value& c,
                                         const Value& d) {
    const double left = a.value * b.value;
    const double right = c.value * d.value;
    const double high = left - right;
    const double low = std::fma(a.value, b.value, -left) - std::fma(c.value, d.value, -right);
    const double sum = high + low;
    double error = kUnit * (std::fabs(high) + 2 * std::fabs(low));
    if (std::fabs(left) < kSmallest || std::fabs(right) < kSmallest) {
      const bool zeros = (a.value == 0 || b.value == 0) && (c.value == 0 || d.value == 0);
      error += zeros ? 0 : kSmallest;
    }
    return {sum, error + a.error + b.error + c.error + d.error};
  }

private:
  static constexpr double kUnit = 0x1p-52;
  /// Smaller products may have lost digits; bounds of larger ones have none to lose.
  static constexpr double kSmallest = 0x1p-900;

  [[nodiscard]] static double inverse_power(double size) {
    return size == 0 ? 1 : std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000));
  }
  [[nodiscard]] static Value rounded_sum(double sum, const Value& a, const Value& b) {
    return {sum, a.error + b.error + kUnit * std::fabs(sum)};
  }

  double scale_[kQuantities];
};

} // namespace simdbezier::detail
