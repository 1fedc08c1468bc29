// Grid kernels: small grids have registers of their own (grid/small_grids.hpp); of all others,
// which columns go to which tile (grid/column_tile.hpp). With L lanes a row of nu columns is nu / L
// whole registers and a rest, which takes
//   1 column           the buffered column (kExtra) of the last whole register
//   more               a whole register that begins within the last one (overlaps())
//   without whole registers, or where overlapping does not pay:
//   up to L/2          a tile of 2 rows a register
//   more               a masked register
// Registers of a line do not overlap; if the last whole one has no partner, more than L/4 columns
// behind it are the masked second half of a pair (positions and derivatives).
// Without normals one component is swept after the other (4 or 8 registers of polynomials, one to
// three store streams), two registers of columns as one where there is room
// (simd/register_pair.hpp); normals need all three components at once (24 registers, which AVX2
// keeps partly in L1). In cache, most rows of two registers and more are swept with their registers
// side by side (grid/row_bands.hpp), float derivatives plane by plane where rows are no whole
// registers; of rows that are not, derivatives of large patches take all tiles of a component
// before the next one (grid/component_sweeps.hpp). Squares of usual sizes are known to the
// compiler: sweep_square() chooses as sweep_tiles() does. Rows of one tile that lie across lines
// are put together to whole lines. Streamed rows that are no whole registers, or lie across lines,
// or are a multiple of 4 or 8 lines, go in order: of one tile by grid/streamed_lines.hpp, others by
// grid/streamed_planes.hpp, with normals by grid/streamed_normals.hpp. Others go by
// grid/streamed_rows.hpp on AVX2, and tile by tile on AVX-512.
#pragma once

#include "kernels/grid/component_sweeps.hpp"
#include "kernels/grid/normal_bands.hpp"
#include "kernels/grid/record_rows.hpp"
#include "kernels/grid/row_bands.hpp"
#include "kernels/grid/small_grid_jets.hpp"
#include "kernels/grid/small_jets_across.hpp"
#include "kernels/grid/square_sweeps.hpp"
#include "kernels/grid/squares_of_four.hpp"
#include "kernels/grid/streamed_lines.hpp"
#include "kernels/grid/streamed_normals.hpp"
#include "kernels/grid/streamed_planes.hpp"
#include "kernels/grid/streamed_rows.hpp"
#include "kernels/simd/register_pair.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether two registers of a line are streamed together. Memory takes each second line at half of
/// its rate.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kStreamsPairs = kLineWide<vec<T>>&& kSweepsTwice<kOutputs, T>;

/// So many bytes of rarer outputs stay in the first-level cache while one tile follows the other;
/// for others, GridTask has the number.
constexpr std::size_t kCachedBytes = 12288;

/// Returns the number of planes that a kernel writes.
constexpr std::size_t written_planes(detail::OutputSet outputs) {
  return outputs == detail::kPosition         ? 3
         : outputs == detail::kPositionNormal ? 6
         : outputs == detail::kAnyOutputs     ? 12
                                              : 9;
}

/// Returns what a kernel writes of one patch.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART std::size_t bytes_of(const GridTask<T>& task, const RowPiece<T>& piece) {
  return piece.rows() * task.nu * written_planes(kOutputs) * sizeof(T);
}

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

/// Whether the last `rest` columns of `first` and more take a register of their own that begins
/// within the one before it. Some columns are computed twice, by idle lanes. That saves stores of
/// parts of registers, which AVX2 has no good instruction for, and makes pairs of rows of the tile.
/// Normals are so much arithmetic that two rows in one register are better where they fit.
template <detail::OutputSet kOutputs, typename V>
SIMDBEZIER_PART bool overlaps(std::size_t first, std::size_t rest) {
  constexpr std::size_t kShort = kOutputs == detail::kPositionNormal ? kLanes<V> / 2
                                 : kUsual<kOutputs>                  ? 1
                                                                     : 0;
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
SIMDBEZIER_PART void sweep_tiles(const GridTask<T>& task, const ColumnSplit<vec<T>>& split,
                                 const RowPiece<T>& piece, std::size_t patch, std::size_t end) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  const TileSweeper<kOutputs, kKnown, T> tiles{task, piece, patch, end};
  if constexpr (kStreamsLines && (kKnown == Known::watertight)) {
    if (sweep_across_lines<kOutputs>(task, piece, patch, end)) {
      return;
    }
  }
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

/// Sweeps patches [patch, end) by components, if that pays, and returns whether it did. It does not
/// by plain stores to memory, where lines of all planes at once get there faster.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool sweep_large_patches(const GridTask<T>& task, const RowPiece<T>& piece,
                                         std::size_t patch, std::size_t end) {
  if constexpr (kSweepsByComponents<kOutputs, vec<T>>) {
    if (!task.plain_to_memory && task.nu >= 2 * kLanes<vec<T>> &&
        bytes_of<kOutputs>(task, piece) > kCachedBytes) {
      sweep_by_components<kOutputs>(task, piece, patch, end);
      return true;
    }
  }
  return false;
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

/// Sweeps patches [patch, end) in bands, and the columns behind these, if that pays, and returns
/// whether it did.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool sweep_in_bands(const GridTask<T>& task, const RowPiece<T>& piece,
                                    std::size_t patch, std::size_t end) {
  if constexpr (kSweepsBands<kOutputs, T>) {
    const std::size_t swept = sweep_bands<kOutputs>(task, piece, patch, end);
    if (swept > 0 && swept < task.nu) {
      with_known_edges(task, [&]<Known kKnown>() SIMDBEZIER_INLINE_LAMBDA {
        const TileSweeper<kOutputs, kKnown, T> tiles{task, piece, patch, end};
        sweep_rest<kOutputs, T>(tiles, swept, task.nu - swept);
      });
    }
    return swept > 0;
  } else if constexpr (kSweepsNormalBands<kOutputs, T>) {
    if (pays_in_normal_bands(task, piece)) {
      sweep_normal_bands(task, piece, patch, end);
      return true;
    }
  }
  return false;
}

/// Sweeps patches [patch, end) on the rows of a piece.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void sweep_patches(const GridTask<T>& task, const ColumnSplit<vec<T>>& split,
                                   const RowPiece<T>& piece, std::size_t patch, std::size_t end) {
  if constexpr (!kUsual<kOutputs>) {
    if (!sweep_large_patches<kOutputs>(task, piece, patch, end)) {
      sweep_registers<kOutputs>(task, piece, patch, end);
    }
  } else {
    if constexpr (kPutsRecords<vec<T>>) {
      if (task.record > 1) {
        return sweep_record_tiles<kOutputs>(task, piece, patch, end);
      }
    }
    if constexpr (kStreamsRows<kOutputs, T>) {
      if (task.streaming) {
        return stream_rows<kOutputs>(task, piece, patch, end);
      }
    }
    if (task.origins != nullptr || task.streaming) {
      return sweep_registers<kOutputs>(task, piece, patch, end);
    }
    if constexpr (kKnowsSquares<kOutputs, T>) {
      if (task.watertight && sweep_square_of<kOutputs>(SquareSides(), task, piece, patch, end)) {
        return;
      }
    }
    if (sweep_in_bands<kOutputs>(task, piece, patch, end) ||
        sweep_large_patches<kOutputs>(task, piece, patch, end)) {
      return;
    }
    with_known_edges(task, [&]<Known kKnown>() SIMDBEZIER_INLINE_LAMBDA {
      sweep_tiles<kOutputs, kKnown>(task, split, piece, patch, end);
    });
  }
}

/// Sweeps a task that is a small grid, if it is one and the instruction set has kernels for it, and
/// returns whether it did: positions, and with them normals or derivatives.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool sweep_small_grid(const GridTask<T>& task) {
#if defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_AVX512)
  if constexpr (kUsual<kOutputs>) {
    if (!is_small_grid(task)) {
      return false;
    }
    if (pays_across<kOutputs>(task)) {
      sweep_small_grid_across<kOutputs>(task);
      return true;
    }
#if defined(SIMDBEZIER_KERNELS_AVX512)
    if constexpr (kFourGroups<vec<T>>) {
      if (is_square_of_four(task)) {
        sweep_squares_of_four<kOutputs>(task);
      } else if constexpr (kOutputs == detail::kPosition) {
        small_grid_positions(task);
      } else {
        sweep_small_jets<kOutputs == detail::kPositionNormal>(task);
      }
      return true;
    }
#endif
  }
#endif
  static_cast<void>(task);
  return false;
}

/// Whether streamed rows go in order, each plane as one stream: where they are no whole registers,
/// or lie across lines; or where the lines of a tile are a fourth of a row or less, and rows a
/// multiple of four times as long, since memory takes every fourth line at 0.6 and every eighth at
/// 0.3 of its rate. Origins come with whole lines only.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool streams_in_order(const GridTask<T>& task) {
  using V = vec<T>;
  constexpr std::size_t kTileLines = kLineWide<V> && !kStreamsPairs<kOutputs, T> ? 1 : 2;
  if (task.record > 1) {
    return false;
  }
  if (task.nu % kLanes<V> != 0 || !planes_begin_lines(task)) {
    return true;
  }
  return task.origins == nullptr && task.nu <= detail::kMostStreamedRegisters * kLanes<V> &&
         task.nu * sizeof(T) % (4 * kTileLines * 64) == 0;
}

/// Sweeps a piece of a streamed task, if its rows are streamed in order, and returns whether they
/// are.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool stream_in_order(const GridTask<T>& task, const RowPiece<T>& piece) {
#if defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_AVX512)
  if (task.streaming && streams_in_order<kOutputs>(task)) {
    if constexpr (kOutputs == detail::kPosition || kOutputs == detail::kPositionDerivatives) {
      if (task.nu % kLanes<vec<T>> != 0 && stream_tiles<kOutputs>(task, piece)) {
        return true;
      }
      stream_planes<kOutputs>(task, piece);
      return true;
    } else if constexpr (kStreamsNormals<kOutputs, T>) {
      stream_normals(task, piece);
      return true;
    }
  }
#endif
  static_cast<void>(task);
  static_cast<void>(piece);
  return false;
}

template <typename T, detail::OutputSet kOutputs>
SIMDBEZIER_KERNEL void grid_kernel(GridTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  if (sweep_small_grid<kOutputs>(task)) {
    return;
  }
  const ColumnSplit<vec<T>> split(task.nu, kUsual<kOutputs>);
  RowPowers<T> powers;
  for (RowPieces<T> pieces(task); pieces.more();) {
    const RowPiece<T> piece = pieces.next(powers);
    if (stream_in_order<kOutputs>(task, piece)) {
      continue;
    }
    const std::size_t cached = kUsual<kOutputs> ? task.cached_bytes : kCachedBytes;
    const std::size_t together = cached / bytes_of<kOutputs>(task, piece) + 1;
    PagesAhead<T> pages(task, piece);
    for (std::size_t patch = 0; patch < task.patch_count; patch += together) {
      const std::size_t left = task.patch_count - patch;
      const std::size_t end = patch + (left < together ? left : together);
      pages.come_to(end - 1);
      sweep_patches<kOutputs>(task, split, piece, patch, end);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
