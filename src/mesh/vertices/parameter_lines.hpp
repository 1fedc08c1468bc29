// Uniform parameters between two ends, and those of edges with two rates, kept for the rates that
// occur often.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/calls/grid_plan.hpp"
#include "src/mesh/layout/edge_union.hpp"

namespace simdbezier::detail {

/// The points between the ends of an edge.
template <typename T>
struct ParameterLine {
  const T* along; ///< half-centred parameters, then kMaxLanes more readable values
  /// The same points as shares of the edge, from 0 to 1. Their mirror images are among them, so
  /// that backwards they are those of a side in the other direction.
  const T* shares;
};

/// A line in the making.
template <typename T>
struct LineMemory {
  T* along;
  T* shares;

  [[nodiscard]] static std::size_t values(std::size_t most_segments) noexcept {
    return 2 * (most_segments + kMaxLanes);
  }
  LineMemory(T* memory, std::size_t most_segments) noexcept
      : along(memory), shares(memory + most_segments + kMaxLanes) {}

  /// The points of all of these rates. next: memory for as many values.
  ParameterLine<T> fill(std::span<const std::uint32_t> rates, std::uint32_t* next) const noexcept {
    std::size_t points = 0;
    walk_union(rates, next, [&](std::uint32_t, const std::uint32_t* at, std::size_t lowest) {
      const std::uint32_t numerator = at[lowest];
      const std::uint32_t denominator = rates[lowest];
      if (numerator > 0 && numerator < denominator) {
        along[points] = uniform_parameter<T>(numerator, denominator);
        shares[points++] = static_cast<T>(numerator) / static_cast<T>(denominator);
      }
    });
    std::fill_n(along + points, kMaxLanes, points > 0 ? along[points - 1] : T(0));
    return {along, shares};
  }
};

/// One thread's lines.
template <typename T>
class ParameterLines {
public:
  /// Larger rates have no line that is kept.
  static constexpr std::uint32_t kMost = 63;

  /// Values of scratch, for up to `most` segments of a single rate.
  [[nodiscard]] static std::size_t memory_values(std::size_t most) noexcept {
    return kSlots * kSlotValues + 2 * LineMemory<T>::values(most);
  }
  ParameterLines(T* memory, std::size_t most) noexcept
      : memory_(memory), large_{{memory + kSlots * kSlotValues, most},
                                {large_[0].along + LineMemory<T>::values(most), most}} {}

  /// Whether a line is there already, so that line() leaves all others as they are.
  [[nodiscard]] bool holds(std::uint32_t a, std::uint32_t b) const noexcept {
    const Rates& rates = rates_[slot_of(a, b)];
    return rates.a == a && rates.b == b;
  }
  /// The points of an edge with rates a <= b <= kMost, which may be equal. Valid until one is asked
  /// for that is not there.
  ParameterLine<T> line(std::uint32_t a, std::uint32_t b) noexcept {
    const std::size_t slot = slot_of(a, b);
    const LineMemory<T> to(memory_ + slot * kSlotValues, 2 * kMost);
    if (!holds(a, b)) {
      rates_[slot] = {a, b};
      fill(rates_[slot], to);
    }
    return {to.along, to.shares};
  }
  /// Those of a single rate above kMost. Valid until two others are asked for.
  ParameterLine<T> large_line(std::uint32_t rate) noexcept {
    turn_ = large_rate_[turn_] == rate ? turn_ : 1 - turn_;
    const LineMemory<T>& to = large_[turn_];
    if (large_rate_[turn_] != rate) {
      large_rate_[turn_] = rate;
      fill({rate, rate}, to);
    }
    return {to.along, to.shares};
  }

private:
  struct Rates {
    std::uint32_t a;
    std::uint32_t b;
  };
  static constexpr std::size_t kSlots = 256;
  static constexpr std::size_t kSlotValues = 2 * (2 * kMost + kMaxLanes);

  /// Pairs of equal rates have slots of their own.
  static std::size_t slot_of(std::uint32_t a, std::uint32_t b) noexcept {
    return (37 * a + b) % kSlots;
  }
  static void fill(const Rates& rates, const LineMemory<T>& to) noexcept {
    const std::uint32_t both[2] = {rates.a, rates.b};
    std::uint32_t next[2];
    to.fill(both, next);
  }

  T* memory_;
  LineMemory<T> large_[2];
  std::uint32_t large_rate_[2] = {0, 0};
  std::size_t turn_ = 0;
  Rates rates_[kSlots] = {};
};

} // namespace simdbezier::detail
