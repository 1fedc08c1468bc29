// Numbers carried in two doubles, for the factors of splines. Relative errors are below 2^-98 of
// sums of numbers of one sign, of products and quotients. Nothing is fused, so that the bits are
// the same everywhere. Sums are commutative, and differences odd, which mirrored splines rely on.
// Source: T. J. Dekker, "A floating-point technique for extending the available precision",
// Numerische Mathematik 18 (1971); the sum without error after D. E. Knuth, TAOCP vol. 2, 4.2.2.
#pragma once

#include <cmath>

namespace simdbezier::detail {

struct TwoDoubles {
  double high; ///< the number, rounded
  double low;

  friend bool operator==(const TwoDoubles&, const TwoDoubles&) = default;
};

/// a + b without error.
inline TwoDoubles exact_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// a * b without error, where neither product nor halves leave the range of doubles.
inline TwoDoubles exact_product(double a, double b) noexcept {
  constexpr double kSplit = 0x1p27 + 1;
  const auto half = [](double x) {
    const double scaled = kSplit * x;
    return scaled - (scaled - x);
  };
  const double a1 = half(a);
  const double b1 = half(b);
  const double a2 = a - a1;
  const double b2 = b - b1;
  const double product = a * b;
  return {product, ((a1 * b1 - product) + (a1 * b2 + a2 * b1)) + a2 * b2};
}

inline TwoDoubles normal(double high, double low) noexcept {
  const double sum = high + low;
  return {sum, low - (sum - high)};
}

inline TwoDoubles operator+(const TwoDoubles& a, const TwoDoubles& b) noexcept {
  const TwoDoubles sum = exact_sum(a.high, b.high);
  const TwoDoubles low = exact_sum(a.low, b.low);
  const TwoDoubles whole = normal(sum.high, sum.low + low.high);
  return normal(whole.high, whole.low + low.low);
}

inline TwoDoubles operator-(const TwoDoubles& a, const TwoDoubles& b) noexcept {
  return a + TwoDoubles{-b.high, -b.low};
}

inline TwoDoubles operator*(const TwoDoubles& a, const TwoDoubles& b) noexcept {
  const TwoDoubles product = exact_product(a.high, b.high);
  return normal(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/// a / b for 0 <= a <= b, b > 0, whatever their size. 1 exactly where they are equal.
inline TwoDoubles quotient(TwoDoubles a, TwoDoubles b) noexcept {
  if (b.high < 0x1p-400 || b.high > 0x1p400) {
    const int exponent = -std::ilogb(b.high);
    a = {std::scalbn(a.high, exponent), std::scalbn(a.low, exponent)};
    b = {std::scalbn(b.high, exponent), std::scalbn(b.low, exponent)};
  }
  const double first = a.high / b.high;
  const TwoDoubles rest = a - TwoDoubles{first, 0} * b;
  return normal(first, rest.high / b.high);
}

} // namespace simdbezier::detail
