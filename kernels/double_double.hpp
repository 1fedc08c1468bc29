// Sums carried in two doubles, for packing double control points. Only what packing needs: every
// factor of the basis change is 3 or a power of two, so there is no general product.
// Source: T. J. Dekker, "A floating-point technique for extending the available precision",
// Numerische Mathematik 18 (1971); two_sum after D. E. Knuth, TAOCP vol. 2, 4.2.2.
#pragma once

namespace simdbezier::detail {

struct DoubleDouble {
  double high = 0;
  double low = 0;

  DoubleDouble() = default;
  DoubleDouble(double value) noexcept : high(value) {} // NOLINT(google-explicit-constructor)
  DoubleDouble(double h, double l) noexcept : high(h), low(l) {}

  explicit operator double() const noexcept { return high + low; }
  explicit operator float() const noexcept { return static_cast<float>(high + low); }

  friend DoubleDouble operator-(DoubleDouble a) noexcept { return {-a.high, -a.low}; }

  /// Commutative and odd, which edge coefficients rely on: both sides of a reversed edge must get
  /// the same bits.
  friend DoubleDouble operator+(DoubleDouble a, DoubleDouble b) noexcept {
    const double sum = a.high + b.high;
    const double part = sum - a.high;
    const double error = (a.high - (sum - part)) + (b.high - part);
    const double tail = error + (a.low + b.low);
    const double rounded = sum + tail;
    return {rounded, tail - (rounded - sum)};
  }
  friend DoubleDouble operator-(DoubleDouble a, DoubleDouble b) noexcept { return a + (-b); }

  /// Times a power of two.
  friend DoubleDouble scaled(DoubleDouble a, double power) noexcept {
    return {a.high * power, a.low * power};
  }
  friend DoubleDouble tripled(DoubleDouble a) noexcept { return scaled(a, 2) + a; }
};

inline double scaled(double a, double power) noexcept { return a * power; }
inline double tripled(double a) noexcept { return 3 * a; }

} // namespace simdbezier::detail
