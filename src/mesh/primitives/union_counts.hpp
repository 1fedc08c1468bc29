// How the points of two rates lie on an edge, kept for the pairs that occur often.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

namespace simdbezier::detail {

/// From each of a side's points to the next one: how many segments there are between them on an
/// edge that has another rate as well.
class UnionWalk {
public:
  UnionWalk() = default;
  UnionWalk(std::uint32_t rate, std::uint32_t other)
      : rate_(rate), whole_(other / rate), part_(other % rate) {}

  /// Segments end at the other side's points behind this point, up to the next one, and at the
  /// next one itself where it is none of those. `rest_` / rate: how far the next one then lies
  /// behind a point of the other side, in segments of that side.
  std::uint32_t next() {
    rest_ += part_;
    const std::uint32_t carry = rest_ >= rate_ ? 1 : 0;
    rest_ -= carry * rate_;
    return whole_ + carry + (rest_ != 0 ? 1 : 0);
  }

private:
  std::uint32_t rate_ = 1;
  std::uint32_t whole_ = 0;
  std::uint32_t part_ = 0;
  std::uint32_t rest_ = 0;
};

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
  static void fill(std::uint32_t rate, std::uint32_t other, std::uint8_t* counts) {
    UnionWalk walk(rate, other);
    for (std::uint32_t i = 0; i < rate; ++i) {
      counts[i] = static_cast<std::uint8_t>(walk.next());
    }
  }

  /// The counts with each other rate, one after the other, 0 where they are not yet known.
  std::array<std::unique_ptr<std::uint8_t[]>, kMost + 1> known_;
};

} // namespace simdbezier::detail
