// Uniform parameters between two ends, kept for the numbers of segments that occur often.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "src/calls/grid_plan.hpp"
#include "src/mesh/layout/edge_union.hpp"

namespace simdbezier::detail {

/// One thread's lines of half-centred parameters of the inner points i/n, 0 < i < n.
template <typename T>
class ParameterLines {
public:
  /// Values of scratch, for up to `most` segments.
  [[nodiscard]] static std::size_t memory_values(std::size_t most) noexcept {
    return kSmallValues + 2 * (most + kMaxLanes);
  }
  explicit ParameterLines(T* memory, std::size_t most) noexcept
      : memory_(memory), large_{memory + kSmallValues, memory + kSmallValues + most + kMaxLanes} {}

  /// Whether the line of n segments stays valid.
  [[nodiscard]] static bool is_kept(std::size_t n) noexcept { return n <= kSmall; }
  /// n - 1 values, then kMaxLanes more readable ones. Valid until the second call after it.
  const T* line(std::size_t n) noexcept {
    if (!is_kept(n)) {
      turn_ = large_n_[turn_] == n ? turn_ : 1 - turn_;
      if (large_n_[turn_] != n) {
        large_n_[turn_] = n;
        fill(n, large_[turn_]);
      }
      return large_[turn_];
    }
    T* const small = memory_ + place(n);
    if ((known_ >> n & 1U) == 0) {
      known_ |= std::uint64_t{1} << n;
      fill(n, small);
    }
    return small;
  }

private:
  static constexpr std::size_t kSmall = 63;
  /// Values of the lines before that of n segments.
  static constexpr std::size_t place(std::size_t n) noexcept {
    return n * (n - 1) / 2 + n * kMaxLanes;
  }
  static constexpr std::size_t kSmallValues = place(kSmall + 1);

  static void fill(std::size_t n, T* to) noexcept {
    for (std::size_t i = 1; i < n; ++i) {
      to[i - 1] = uniform_parameter<T>(i, n);
    }
    std::fill_n(to + n - 1, kMaxLanes, n > 1 ? to[n - 2] : T(0));
  }

  T* memory_;
  T* large_[2];
  std::size_t large_n_[2] = {0, 0};
  std::size_t turn_ = 0;
  std::uint64_t known_ = 0; ///< a bit for each n
};

/// One thread's lines of the parameters of edges that have two rates, which may be equal, for pairs
/// of small rates.
template <typename T>
class UnionLines {
public:
  static constexpr std::uint32_t kMost = 47;

  [[nodiscard]] static std::size_t memory_values() noexcept { return kSlots * kSlotValues; }
  explicit UnionLines(T* memory) noexcept : memory_(memory) {}

  /// Whether a line is there already, so that line() leaves all others as they are.
  [[nodiscard]] bool holds(std::uint32_t a, std::uint32_t b) const noexcept {
    const std::size_t slot = slot_of(a, b);
    return rates_[slot][0] == a && rates_[slot][1] == b;
  }
  /// Half-centred parameters of the points between the ends of an edge with rates a <= b <= kMost,
  /// then kMaxLanes more readable values. Valid until one is asked for that is not there.
  const T* line(std::uint32_t a, std::uint32_t b) noexcept {
    const std::size_t slot = slot_of(a, b);
    T* const values = memory_ + slot * kSlotValues;
    if (!holds(a, b)) {
      rates_[slot][0] = a;
      rates_[slot][1] = b;
      fill(values, rates_[slot]);
    }
    return values;
  }
  /// The same points as shares of the edge, from 0 to 1, of a line that is there. Their mirror
  /// images are among them, so that backwards they are those of a side in the other direction.
  [[nodiscard]] const T* shares(std::uint32_t a, std::uint32_t b) const noexcept {
    return memory_ + slot_of(a, b) * kSlotValues + kSharesAt;
  }

private:
  static constexpr std::size_t kSide = 16;
  static constexpr std::size_t kSlots = kSide * kSide;
  static constexpr std::size_t kSharesAt = 2 * kMost + kMaxLanes;
  static constexpr std::size_t kSlotValues = kSharesAt + 2 * kMost;

  static std::size_t slot_of(std::uint32_t a, std::uint32_t b) noexcept {
    return (b - a) % kSide * kSide + a % kSide;
  }
  static void fill(T* to, const std::uint32_t (&rates)[2]) noexcept {
    std::uint32_t next[2];
    std::size_t points = 0;
    walk_union(rates, next, [&](std::uint32_t, const std::uint32_t* at, std::size_t lowest) {
      if (at[lowest] > 0 && at[lowest] < rates[lowest]) {
        to[kSharesAt + points] = static_cast<T>(at[lowest]) / static_cast<T>(rates[lowest]);
        to[points++] = uniform_parameter<T>(at[lowest], rates[lowest]);
      }
    });
    std::fill_n(to + points, kMaxLanes, to[points - 1]);
  }

  T* memory_;
  std::uint32_t rates_[kSlots][2] = {};
};

} // namespace simdbezier::detail
