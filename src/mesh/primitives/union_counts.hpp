// How the points of two rates lie on an edge, kept for the pairs that occur often.
#pragma once

#include <array>
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
  /// Segments end at the other side's points behind one of this side, up to the next one, and at
  /// the next one itself where it is none of those. `rest` / rate: how far the next one then lies
  /// behind a point of the other side, in segments of that side.
  static void fill(std::uint32_t rate, std::uint32_t other, std::uint8_t* counts) {
    std::uint32_t rest = 0;
    for (std::uint32_t i = 0; i < rate; ++i) {
      const std::uint32_t all = rest + other;
      rest = all % rate;
      counts[i] = static_cast<std::uint8_t>(all / rate + (rest != 0 ? 1 : 0));
    }
  }

  /// The counts with each other rate, one after the other, 0 where they are not yet known.
  std::array<std::unique_ptr<std::uint8_t[]>, kMost + 1> known_;
};

} // namespace simdbezier::detail
