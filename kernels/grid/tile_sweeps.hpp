// Grids tile by tile, which any grid can be: which columns go to which tile (grid/column_tile.hpp).
// With L lanes a row of nu columns is nu / L whole registers and a rest, which takes
//   1 column           the buffered column (kExtra) of the last whole register
//   more               a whole register that begins within the last one (overlaps())
//   without whole registers, or where overlapping does not pay:
//   up to L/2          a tile of 2 rows a register
//   more               a masked register
// Registers of a line do not overlap; if the last whole one has no partner, more than L/4 columns
// behind it are the masked second half of a pair (positions and derivatives).
// Without normals one component is swept after the other (4 or 8 registers of polynomials, one to
// three store streams), two registers of columns as one if there is room
// (simd/register_pair.hpp); normals need all three components at once (24 registers, which AVX2
// keeps partly in L1).
#pragma once

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/register_pair.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether two registers of columns are swept as one, which counts rows half as often and writes to
/// no cache line twice. Their polynomials take 8 of 16 or 32 registers, or 16 of 32.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kSweepsTwice = (kOutputs == detail::kPosition &&
                               (kSse2 || sizeof(T) * kLanes<vec<T>> >= 32)) ||
                              (kOutputs == detail::kPositionDerivatives && kLineWide<vec<T>>);

/// Whether two registers of a line are streamed together. Memory takes each second line at half of
/// its rate.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kStreamsPairs = kLineWide<vec<T>>&& kSweepsTwice<kOutputs, T>;

/// Calls the function of a tile for patches [patch, end).
template <detail::OutputSet kOutputs, Known kKnown, typename T>
struct TileSweeper {
  const GridTask<T>& task;
  const RowPiece<T>& piece;
  std::size_t patch;
  std::size_t end;

  template <typename SomeTile>
  SIMDBEZIER_PART void sweep(std::size_t first, std::size_t columns) const {
    sweep_tile<kOutputs, kKnown, SomeTile>(task, piece, first, columns, patch, end);
  }
};

/// Whether a single last column goes along with the register before it. WebAssembly has it in a
/// register that overlaps, which is less to load, and as fast. SSE2 has it so for derivatives and
/// for doubles, of which a register has no more than two.
template <detail::OutputSet kOutputs, typename V>
constexpr bool kSingleColumns =
    kUsual<kOutputs> && !kSimd128 &&
    !(kSse2 && (kLanes<V> == 2 || kOutputs == detail::kPositionDerivatives));

/// Whether the last `rest` columns of `first` and more take a register of their own that begins
/// within the one before it. Some columns are computed twice, by idle lanes. That saves stores of
/// parts of registers, which AVX2 has no good instruction for, and makes pairs of rows of the tile.
/// Normals are so much arithmetic that two rows in one register are better where they fit.
template <detail::OutputSet kOutputs, typename V>
SIMDBEZIER_PART bool overlaps(std::size_t first, std::size_t rest) {
  constexpr std::size_t kShort = !kSingleColumns<kOutputs, V>          ? 0
                                 : kOutputs == detail::kPositionNormal ? kLanes<V> / 2
                                                                       : 1;
  return !kLineWide<V> && first > 0 && rest > kShort;
}

/// Sweeps the columns behind whole registers, `rest` of them from `first` on: fewer than a
/// register.
template <detail::OutputSet kOutputs, typename T, typename Sweeper>
SIMDBEZIER_INLINE void sweep_rest(const Sweeper& tiles, std::size_t first, std::size_t rest) {
  using V = vec<T>;
  constexpr std::size_t kHalf = kLanes<V> / 2;
  constexpr std::size_t kRows = kHalf > 1 ? 2 : 1; // of a tile of so many columns
  if (overlaps<kOutputs, V>(first, rest)) {
    return tiles.template sweep<ColumnTile<1, true, false, V>>(first + rest - kLanes<V>, kLanes<V>);
  }
  if (rest > kHalf) {
    return tiles.template sweep<ColumnTile<1, false, false, V>>(first, rest);
  }
  if constexpr (kLineWide<V>) { // short registers gain nothing by this
    if (tiles.task.nu == kHalf) {
      return tiles.template sweep<ColumnTile<kRows, true, false, V>>(0, kHalf);
    }
  }
  if (rest > 0) {
    tiles.template sweep<ColumnTile<kRows, false, false, V>>(first, rest);
  }
}

/// Sweeps all tiles of patches [patch, end), for tasks of which nothing is known and for rarer
/// outputs: whole registers and a masked one.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void sweep_registers(const GridTask<T>& task, const RowPiece<T>& piece,
                                     std::size_t patch, std::size_t end) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  const TileSweeper<kOutputs, Known::nothing, T> tiles{task, piece, patch, end};
  std::size_t first = 0;
  if constexpr (kStreamsPairs<kOutputs, T>) {
    for (; task.streaming && first + 2 * kL <= task.nu; first += 2 * kL) {
      tiles.template sweep<ColumnTile<1, true, false, RegisterPair<V>, true>>(first, 2 * kL);
    }
  }
  for (; first + kL <= task.nu; first += kL) {
    if constexpr (kLineWide<V> && kUsual<kOutputs>) {
      if (task.streaming) {
        tiles.template sweep<ColumnTile<1, true, false, V, true>>(first, kL);
        continue;
      }
    }
    tiles.template sweep<ColumnTile<1, true, false, V>>(first, kL);
  }
  if (!task.streaming && overlaps<kOutputs, V>(first, task.nu - first)) {
    tiles.template sweep<ColumnTile<1, true, false, V>>(task.nu - kL, kL);
  } else if (first < task.nu) {
    tiles.template sweep<ColumnTile<1, false, false, V>>(first, task.nu - first);
  }
}

/// Sweeps all tiles of patches [patch, end), of tasks without origins.
template <detail::OutputSet kOutputs, Known kKnown, typename T>
SIMDBEZIER_PART void sweep_tiles(const GridTask<T>& task, const RowPiece<T>& piece,
                                 std::size_t patch, std::size_t end) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  const TileSweeper<kOutputs, kKnown, T> tiles{task, piece, patch, end};
  const ColumnSplit<V> split(task.nu, kSingleColumns<kOutputs, V>);
  // A single column goes along with the last whole register.
  const std::size_t plain = split.single ? split.full - kL : split.full;
  std::size_t first = 0;
  if constexpr (kSweepsTwice<kOutputs, T>) {
    using W = RegisterPair<V>;
    for (; first + 2 * kL <= plain; first += 2 * kL) {
      tiles.template sweep<ColumnTile<1, true, false, W>>(first, 2 * kL);
    }
    if (split.single && first + 2 * kL == split.full) {
      return tiles.template sweep<ColumnTile<1, true, true, W>>(first, 2 * kL);
    }
    // The last registers of shorter ones overlap. In staging, derivatives are faster one by one.
    if constexpr (kLineWide<V>) {
      const bool pays = kOutputs == detail::kPosition || task.drain == nullptr;
      if (pays && split.rest > kL / 4 && first + kL == split.full) {
        return tiles.template sweep<ColumnTile<1, false, false, W>>(first, kL + split.rest);
      }
    }
  }
  for (; first < plain; first += kL) {
    tiles.template sweep<ColumnTile<1, true, false, V>>(first, kL);
  }
  if (split.single) {
    tiles.template sweep<ColumnTile<1, true, true, V>>(plain, kL);
  } else {
    sweep_rest<kOutputs, T>(tiles, split.full, split.rest);
  }
}

/// Calls sweep<kKnown>() for a task without origins. Registers of 64 bytes have tiles for either
/// kind of edges; shorter ones ask at run time, since twice the code would be too much for what it
/// gains.
template <typename T, typename Sweep>
SIMDBEZIER_INLINE void with_known_edges(const GridTask<T>& task, const Sweep& sweep) {
  if constexpr (!kLineWide<vec<T>>) {
    sweep.template operator()<Known::no_origins>();
  } else if (task.watertight) {
    sweep.template operator()<Known::watertight>();
  } else {
    sweep.template operator()<Known::open>();
  }
}

/// Whether all planes begin where lines do.
template <typename T>
SIMDBEZIER_PART bool planes_begin_lines(const GridTask<T>& task) {
  std::uintptr_t bits = 0;
  for (const auto& planes : task.out) {
    for (const T* const plane : planes.component) {
      bits |= reinterpret_cast<std::uintptr_t>(plane);
    }
  }
  return bits % 64 == 0;
}

/// Calls visit.operator()<SomeTile>() if rows lie across lines, stores across lines are slow, and
/// SomeTile without a column behind it is as wide as the rows; returns whether that is so.
/// Positions in a part of a register gain nothing by being put together to whole lines.
template <detail::OutputSet kOutputs, typename T, typename Visit>
SIMDBEZIER_INLINE bool with_tile_across_lines(const GridTask<T>& task, const Visit& visit) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  const std::size_t nu = task.nu;
  if (!task.watertight || !task.by_lines || task.drain != nullptr ||
      (nu % kL == 0 && planes_begin_lines(task))) {
    return false;
  }
  if (nu == kL) {
    visit.template operator()<ColumnTile<1, true, false, V>>();
    return true;
  }
  if (nu == 2 * kL) {
    visit.template operator()<ColumnTile<1, true, false, RegisterPair<V>>>();
    return true;
  }
  if constexpr (kOutputs == detail::kPositionDerivatives) {
    if (nu > kL / 2 && nu < kL) {
      visit.template operator()<ColumnTile<1, false, false, V>>();
      return true;
    }
  }
  return false;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
