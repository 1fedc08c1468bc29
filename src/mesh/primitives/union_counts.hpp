// How the points of two rates lie on an edge, kept for the pairs that occur often.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "src/mesh/layout/edge_union.hpp"

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
    std::uint8_t* const counts = pairs.get() + other * rate;
    walk_segments(rate, other, [&](std::uint32_t i, std::uint32_t n) {
      counts[i] = static_cast<std::uint8_t>(n);
    });
    return counts;
  }

  /// The counts with each other rate, one after the other, 0 where they are not yet known.
  std::array<std::unique_ptr<std::uint8_t[]>, kMost + 1> known_;
};

} // namespace simdbezier::detail
