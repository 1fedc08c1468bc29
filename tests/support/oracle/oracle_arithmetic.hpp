// Double-double arithmetic: an unevaluated sum hi + lo with |lo| <= ulp(hi)/2, about 106 bits.
//
// The oracle's number type. Error-free transformations after Dekker (1971) and Knuth (TAOCP 4.2.2),
// accurate sum and product after Joldes, Muller, Popescu, "Tight and rigorous error bounds for
// basic building blocks of double-word arithmetic", ACM TOMS 44(2), 2017: relative errors at most
// 3 * 2^-106 (sum), 5 * 2^-106 (product), 15 * 2^-106 (quotient).
// Needs round-to-nearest and no contraction (the build sets -ffp-contract=off).
#pragma once

#include <cmath>

namespace simdbezier::tests {

struct DoubleDouble {
  double hi = 0;
  double lo = 0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : hi(value) {} // exact, so implicit
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}
  [[nodiscard]] constexpr double to_double() const { return hi + lo; }
};

/// a + b exactly, for |a| >= |b| or a == 0.
[[nodiscard]] constexpr DoubleDouble quick_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b exactly.
[[nodiscard]] constexpr DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a * b exactly, barring underflow of the low part. std::fma is correctly rounded in software
/// too, so the oracle has the same bits on machines without the instruction.
[[nodiscard]] inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

[[nodiscard]] constexpr DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }

[[nodiscard]] constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble high = two_sum(a.hi, b.hi);
  const DoubleDouble low = two_sum(a.lo, b.lo);
  const DoubleDouble middle = quick_two_sum(high.hi, high.lo + low.hi);
  return quick_two_sum(middle.hi, low.lo + middle.lo);
}

[[nodiscard]] constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + (-b); }

[[nodiscard]] inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble product = two_product(a.hi, b.hi);
  const double cross = std::fma(a.lo, b.hi, std::fma(a.hi, b.lo, a.lo * b.lo));
  return quick_two_sum(product.hi, product.lo + cross);
}

[[nodiscard]] inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a - b * first;
  const double second = rest.hi / b.hi;
  const DoubleDouble last = rest - b * second;
  return quick_two_sum(first, second) + DoubleDouble(last.hi / b.hi);
}

/// One Newton step from the double square root; 0 for 0.
[[nodiscard]] inline DoubleDouble sqrt(DoubleDouble a) {
  if (a.hi <= 0) {
    return 0.0;
  }
  const double root = std::sqrt(a.hi);
  const DoubleDouble rest = a - two_product(root, root);
  return two_sum(root, rest.hi / (2 * root));
}

/// Multiplication by a power of two, exact barring underflow.
[[nodiscard]] inline DoubleDouble scale_by_power_of_two(DoubleDouble a, int exponent) {
  return {std::ldexp(a.hi, exponent), std::ldexp(a.lo, exponent)};
}

[[nodiscard]] constexpr DoubleDouble abs(DoubleDouble a) {
  return a.hi < 0 || (a.hi == 0 && a.lo < 0) ? -a : a;
}

} // namespace simdbezier::tests
