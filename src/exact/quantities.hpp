// What an exact question about a patch or a curve is made of: doubles of four kinds, each with a
// power of two in common. Multiplying a kind by such a power changes no direction.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace simdbezier::detail {

enum Quantity : std::size_t { kPoint, kWeight, kParameterU, kParameterV, kQuantities };

/// A finite double other than zero as an odd integer times a power of two.
struct OddInteger {
  std::uint64_t magnitude;
  int exponent;
  bool negative;

  explicit OddInteger(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const int field = static_cast<int>(bits >> kFractionBits & 0x7ff);
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << kFractionBits) - 1);
    const bool subnormal = field == 0;
    const std::uint64_t digits =
        subnormal ? fraction : fraction | std::uint64_t{1} << kFractionBits;
    const int zeros = std::countr_zero(digits);
    magnitude = digits >> zeros;
    exponent = (subnormal ? 1 : field) - kBias - kFractionBits + zeros;
    negative = value < 0;
  }
  /// One above the exponent of its first digit.
  [[nodiscard]] int high() const { return exponent + static_cast<int>(std::bit_width(magnitude)); }

private:
  static constexpr int kFractionBits = 52;
  static constexpr int kBias = 1023;
};

/// The binary digits that the numbers of one kind occupy: multiples of 2^low, below 2^high in
/// magnitude. Empty (low > high) while all of them are zero.
struct DigitRange {
  int low = 4000;
  int high = -4000;

  void include(double value) {
    if (value != 0) {
      const OddInteger integer(value);
      low = std::min(low, integer.exponent);
      high = std::max(high, integer.high());
    }
  }
  /// Digits of the integers that 2^-low makes of them.
  [[nodiscard]] int digits() const { return std::max(high - low, 0); }
};

} // namespace simdbezier::detail
