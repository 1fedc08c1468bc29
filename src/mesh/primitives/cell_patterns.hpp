// The vertex numbers of cells side by side, some cells at a time. Each place holds a vertex of the
// row below or above, some steps away from the first one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "src/mesh/layout/cells.hpp"

namespace simdbezier::detail {

/// The corners at (0,0), (1,0), (0,1), (1,1) whose vertices are the six numbers of a cell, in the
/// order of put_halves().
struct CellOrder {
  std::uint8_t corner[6];

  constexpr CellOrder(bool falling, bool turned) : corner{} {
    constexpr std::uint8_t kCorners[2][6] = {{1, 3, 0, 2, 0, 3}, {0, 1, 2, 3, 2, 1}};
    for (std::size_t k = 0; k < 6; ++k) {
      const std::size_t in_triangle = k % 3;
      const std::size_t from = turned && in_triangle > 0 ? k + 3 - 2 * in_triangle : k;
      corner[k] = kCorners[falling ? 1 : 0][from];
    }
  }
};

/// Sets the numbers of a cell that are vertices of some of its corners: bit k of kWhich is corner
/// k.
template <unsigned kWhich, bool kFalling, bool kTurned, typename Index>
void put_corners(Index* cell, const std::uint32_t (&vertices)[4]) {
  constexpr CellOrder kCell(kFalling, kTurned);
  for (std::size_t k = 0; k < 6; ++k) {
    if ((kWhich >> kCell.corner[k] & 1) != 0) {
      cell[k] = static_cast<Index>(vertices[kCell.corner[k]]);
    }
  }
}
template <unsigned kWhich, bool kTurned, typename Index>
void put_corners(Index* cell, const std::uint32_t (&vertices)[4], bool falling) {
  falling ? put_corners<kWhich, true, kTurned>(cell, vertices)
          : put_corners<kWhich, false, kTurned>(cell, vertices);
}

template <typename Index>
class CellRun {
public:
  /// Cells whose numbers fill three registers.
  static constexpr std::uint32_t kTogether = 8 / sizeof(Index);

  /// The cell's first vertices below and above, and steps of 1 or -1 to the next ones.
  CellRun(std::uint32_t below, std::uint32_t above, const VertexSteps& steps, bool falling,
          bool turned) {
    const Pattern& pattern = kPatterns[falling ? 1 : 0][turned ? 1 : 0];
    const auto low = spread(below);
    const auto rise = spread(above - below);
    const auto back_below = spread(steps.below == 1 ? 0 : ~0U);
    const auto back_above = spread(steps.above == 1 ? 0 : ~0U);
    for (std::size_t k = 0; k < 3; ++k) {
      const Register mask = load(pattern.above, k);
      const Register from_below = (load(pattern.below_steps, k) ^ back_below) - back_below;
      const Register from_above = (load(pattern.above_steps, k) ^ back_above) - back_above;
      first_[k] = low + (mask & rise) + from_below + from_above;
      step_[k] =
          (mask & spread(kTogether * steps.above)) | (~mask & spread(kTogether * steps.below));
    }
  }

  /// Six numbers a cell, all of them larger by `base`; returns where they end. What stands behind
  /// them, less than kNumbers, is overwritten.
  Index* write(std::uint32_t base, std::uint32_t cells, Index* to) const {
    // One by one: g++ keeps what is copied as an array in memory.
    Register a = first_[0] + spread(base);
    Register b = first_[1] + spread(base);
    Register c = first_[2] + spread(base);
    const Register step_a = step_[0];
    const Register step_b = step_[1];
    const Register step_c = step_[2];
    Index* const end = to + std::size_t{6} * cells;
    for (; to < end; to += kNumbers, a += step_a, b += step_b, c += step_c) {
      store(to, a);
      store(to + kLanes, b);
      store(to + 2 * kLanes, c);
    }
    return end;
  }

  /// Writes numbers larger by `base` than those at `from`, in registers that begin where 16 bytes
  /// do, except for the first one; returns where they end. Up to kNumbers behind them are read and
  /// overwritten.
  static Index* shift(const Index* from, std::uint32_t base, std::size_t count, Index* to) {
    const Register more = spread(base);
    Index* const end = to + count;
    store(to, load(from, 0) + more);
    const std::size_t misplaced = reinterpret_cast<std::uintptr_t>(to) % 16 / sizeof(Index);
    to += kLanes - misplaced;
    from += kLanes - misplaced;
    for (; to < end; to += 2 * kLanes, from += 2 * kLanes) {
      store(to, load(from, 0) + more);
      store(to + kLanes, load(from, 1) + more);
    }
    return end;
  }

  static constexpr std::size_t kNumbers = 48 / sizeof(Index);

private:
  typedef Index Register __attribute__((vector_size(16)));
  static constexpr std::size_t kLanes = 16 / sizeof(Index);

  struct Pattern {
    alignas(16) Index above[kNumbers];
    alignas(16) Index below_steps[kNumbers];
    alignas(16) Index above_steps[kNumbers];

    constexpr Pattern(bool falling, bool turned) : above{}, below_steps{}, above_steps{} {
      const CellOrder order(falling, turned);
      for (std::size_t k = 0; k < kNumbers; ++k) {
        const std::uint32_t corner = order.corner[k % 6];
        const auto steps = static_cast<Index>(k / 6 + corner % 2);
        above[k] = corner >= 2 ? static_cast<Index>(-1) : Index{0};
        below_steps[k] = corner >= 2 ? Index{0} : steps;
        above_steps[k] = corner >= 2 ? steps : Index{0};
      }
    }
  };
  static constexpr Pattern kPatterns[2][2] = {{Pattern(false, false), Pattern(false, true)},
                                              {Pattern(true, false), Pattern(true, true)}};

  static Register spread(std::uint32_t value) { return Register{} + static_cast<Index>(value); }
  static void store(Index* to, Register value) { std::memcpy(to, &value, sizeof value); }
  static Register load(const Index* from, std::size_t k) {
    Register value;
    std::memcpy(&value, from + k * kLanes, sizeof value);
    return value;
  }

  Register first_[3];
  Register step_[3];
};

} // namespace simdbezier::detail
