// How the points of two rates lie on an edge, kept for the pairs that occur often.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace simdbezier::detail {

/// One thread's tables for small rates.
class UnionCounts {
public:
  static constexpr std::uint32_t kMost = 63;

  /// For i = 0 .. rate - 1: the segments from i / rate to (i + 1) / rate on an edge of both rates,
  /// which are from 1 to kMost.
  __attribute__((always_inline)) const std::uint8_t* of(std::uint32_t rate, std::uint32_t other) {
    const std::uint8_t* const pairs = known_[rate].get();
    return pairs != nullptr && pairs[other * rate] != 0 ? pairs + other * rate : add(rate, other);
  }

private:
  __attribute__((noinline)) const std::uint8_t* add(std::uint32_t rate, std::uint32_t other) {
    std::unique_ptr<std::uint8_t[]>& pairs = known_[rate];
    if (pairs == nullptr) {
      pairs = std::make_unique<std::uint8_t[]>((kMost + 1) * rate);
    }
    fill(rate, other, pairs.get() + other * rate);
    return pairs.get() + other * rate;
  }
  /// A segment ends at each of the other side's points after point i, up to point i + 1, and one
  /// at point i + 1 unless it is such a point: `rest` / rate is how far it lies behind one, in
  /// segments of the other side.
  static void fill(std::uint32_t rate, std::uint32_t other, std::uint8_t* counts) {
    const std::uint32_t whole = other / rate;
    const std::uint32_t part = other % rate;
    std::uint32_t rest = 0;
    for (std::uint32_t i = 0; i < rate; ++i) {
      rest += part;
      const std::uint32_t carry = rest >= rate ? 1 : 0;
      rest -= carry * rate;
      counts[i] = static_cast<std::uint8_t>(whole + carry + (rest != 0 ? 1 : 0));
    }
  }

  /// The counts with each other rate, one after the other, 0 where they are not yet known.
  std::array<std::unique_ptr<std::uint8_t[]>, kMost + 1> known_;
};

} // namespace simdbezier::detail
