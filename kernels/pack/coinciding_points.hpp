// Whether all control points are one point, decided exactly from the values that were given.
#pragma once

#include <cmath>
#include <cstddef>

#include <simdbezier/control_nets.hpp>

#include "kernels/simd/vector.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A product of two finite doubles: value + rest, times a power of two, without error.
struct ExactProduct {
  double value;
  double rest;
  int exponent;

  /// Dekker's product (pack/double_double.hpp) of mantissas, which are far from the ends of the
  /// range.
  ExactProduct(double a, double b) {
    int of_a = 0;
    int of_b = 0;
    const double x = __builtin_frexp(a, &of_a);
    const double y = __builtin_frexp(b, &of_b);
    const double x0 = leading(x);
    const double y0 = leading(y);
    const double x1 = x - x0;
    const double y1 = y - y0;
    const double product = x * y;
    const double error = ((x0 * y0 - product) + x0 * y1 + x1 * y0) + x1 * y1;
    int shift = 0;
    value = __builtin_frexp(product, &shift);
    rest = __builtin_ldexp(error, -shift);
    exponent = value == 0 ? 0 : of_a + of_b + shift;
  }
  friend bool operator==(const ExactProduct&, const ExactProduct&) = default;

private:
  /// Returns x rounded to 26 bits.
  static double leading(double x) {
    const double far = x * 0x8000001p0;
    return far - (far - x);
  }
};

/// Whether a b = c d.
template <typename S>
bool products_are_equal(S a, S b, S c, S d) {
  const double ab = static_cast<double>(a) * static_cast<double>(b);
  const double cd = static_cast<double>(c) * static_cast<double>(d);
  if (ab != cd || sizeof(S) == sizeof(float)) {
    return ab == cd; // rounded alike, and products of floats not at all
  }
  return ExactProduct(a, b) == ExactProduct(c, d);
}

/// Whether `count` rational points, `step` values apart, are one point: the weight is the last of
/// each one's `channels` values. Homogeneous ones are compared without a division, whose rounding
/// would make different points one.
template <typename S>
bool is_one_point(const S* points, std::size_t step, std::size_t count, std::size_t channels,
                  Weights weights) {
  const S weight = points[channels - 1];
  for (std::size_t k = 1; k < count; ++k) {
    const S* const point = points + k * step;
    for (std::size_t c = 0; c + 1 < channels; ++c) {
      const bool same = weights == Weights::homogeneous
                            ? products_are_equal(point[c], weight, points[c], point[channels - 1])
                            : point[c] == points[c];
      if (!same) {
        return false;
      }
    }
  }
  return true;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
