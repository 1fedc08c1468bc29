// Control values of every kind from a few bytes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "tests/reliability/fuzz/inputs/fuzz_bytes.hpp"

namespace simdbezier::fuzz {

enum class ValueStyle : std::uint8_t {
  bytes,      ///< small integers, one byte each
  uniform,    ///< [-1, 1), from a seed like all that follow
  few,        ///< -2 … 2: repeated points, collapsed edges, vanishing normals
  magnitudes, ///< signs and fractions times powers of two within a range
  extremes,   ///< zeros, the ends of the number range, neighbours of 1
  bits,       ///< any finite bit pattern
  raw         ///< eight bytes each, nan and infinity included
};
inline constexpr std::size_t kValueStyles = 7;

/// A sequence of values. Styles up to `magnitudes` stay within 2^32 times the scale.
template <typename S>
class ValueSource {
public:
  explicit ValueSource(ByteSource& bytes)
      : bytes_(bytes), style_(static_cast<ValueStyle>(bytes.below(kValueStyles))),
        random_(bytes.raw<std::uint16_t>()), range_(bytes.between(1, 32)) {
    scale_exponent_ = bytes.rarely(64) ? bytes.between(-60, 60) : 0;
    scale_ = std::ldexp(S(1), scale_exponent_);
    offset_ = bytes.rarely(64) ? static_cast<S>(bytes.raw<std::int16_t>()) : S(0);
  }

  /// Values that no sum of a patch can overflow.
  [[nodiscard]] bool moderate() const {
    return style_ <= ValueStyle::magnitudes && scale_exponent_ >= -20 && scale_exponent_ <= 20;
  }

  [[nodiscard]] S next() {
    switch (style_) {
    case ValueStyle::bytes:
      return placed(static_cast<std::int8_t>(bytes_.byte()));
    case ValueStyle::uniform:
      return placed(random_.symmetric());
    case ValueStyle::few:
      return placed(static_cast<double>(random_.below(5)) - 2);
    case ValueStyle::magnitudes:
      return placed(std::ldexp(random_.symmetric(), exponent()));
    case ValueStyle::extremes:
      return extreme();
    case ValueStyle::bits:
      return finite_bits();
    case ValueStyle::raw:
      break;
    }
    return bytes_.raw<S>();
  }

private:
  [[nodiscard]] S placed(double value) const { return static_cast<S>(value) * scale_ + offset_; }
  [[nodiscard]] int exponent() {
    return static_cast<int>(random_.below(static_cast<std::size_t>(2 * range_) + 1)) - range_;
  }
  [[nodiscard]] S extreme() {
    using Limits = std::numeric_limits<S>;
    const S all[] = {S(0),
                     -S(0),
                     Limits::denorm_min(),
                     Limits::min(),
                     Limits::min() * S(0.75),
                     Limits::max(),
                     Limits::max() / 4,
                     S(1),
                     1 + Limits::epsilon(),
                     1 - Limits::epsilon() / 2};
    const S value = all[random_.below(std::size(all))];
    return random_.below(2) == 0 ? value : -value;
  }
  [[nodiscard]] S finite_bits() {
    using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;
    for (;;) {
      const auto bits = static_cast<Bits>(random_.next());
      S value;
      std::memcpy(&value, &bits, sizeof value);
      if (std::isfinite(value)) {
        return value;
      }
    }
  }

  ByteSource& bytes_;
  ValueStyle style_;
  SplitMix random_;
  int range_;
  int scale_exponent_ = 0;
  S scale_;
  S offset_;
};

/// Weights: ones, powers of two within a range, anything positive, or whatever bytes say.
template <typename S>
class WeightSource {
public:
  explicit WeightSource(ByteSource& bytes)
      : bytes_(bytes), style_(bytes.below(4)), random_(bytes.raw<std::uint16_t>()),
        range_(bytes.between(0, 40)) {}

  [[nodiscard]] bool moderate() const { return style_ != 3; }

  [[nodiscard]] S next() {
    const auto exponent =
        static_cast<int>(random_.below(static_cast<std::size_t>(2 * range_) + 1)) - range_;
    switch (style_) {
    case 0:
      return S(1);
    case 1:
      return std::ldexp(S(1), exponent);
    case 2:
      return static_cast<S>(std::ldexp(1.25 + random_.symmetric() / 4, exponent));
    default:
      return bytes_.raw<S>();
    }
  }

private:
  ByteSource& bytes_;
  std::size_t style_;
  SplitMix random_;
  int range_;
};

} // namespace simdbezier::fuzz
