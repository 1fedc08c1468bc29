// Grid kernels: small grids have registers of their own (grid/small_grids.hpp); of all others,
// which columns go to which tile (grid/column_tile.hpp). With L lanes a row of nu columns is nu / L
// whole registers and a rest, which takes
//   1 column           the buffered column (kExtra) of the last whole register
//   up to L/4, L/2     a tile of 4 or 2 rows a register
//   more               a masked register
// Without normals one component is swept after the other (4 or 8 registers of polynomials, one to
// three store streams), two registers of columns as one where there is room
// (simd/register_pair.hpp); normals need all three components at once (24 registers, which AVX2
// keeps partly in L1). Squares of usual sizes are known to the compiler: sweep_square() makes the
// choices of sweep_tiles() for them, so that it instantiates no tile that they do not have.
#pragma once

#include <type_traits>
#include <utility>

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/grid/record_rows.hpp"
#include "kernels/grid/small_grid_jets.hpp"
#include "kernels/simd/register_pair.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The columns of a grid, by the tiles that take them.
template <typename V>
struct ColumnSplit {
  std::size_t full; ///< whole registers
  std::size_t rest; ///< behind them
  bool column;      ///< and one more behind these

  SIMDBEZIER_INLINE ColumnSplit(std::size_t nu, bool single_columns)
      : full(nu / kLanes<V> * kLanes<V>), rest(nu - full), column(false) {
    constexpr std::size_t kL = kLanes<V>;
    if (single_columns && kL > 1 && rest == 1) {
      --rest;
      column = true;
    }
  }
};

/// Whether two registers of columns are swept as one: half of the rows' counting, and no line is
/// come to twice. There must be registers for their polynomials: 8 of 16 or 32, 16 of 32.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kSweepsTwice = (kOutputs == detail::kPosition && sizeof(T) * kLanes<vec<T>> >= 32) ||
                              (kOutputs == detail::kPositionDerivatives && kLineWide<vec<T>>);

/// Bytes of samples that stay in the first-level cache while one tile follows the other.
constexpr std::size_t kCachedBytes = 12288;

/// Planes that a kernel writes.
constexpr std::size_t written_planes(detail::OutputSet outputs) {
  return outputs == detail::kPosition         ? 3
         : outputs == detail::kPositionNormal ? 6
         : outputs == detail::kAnyOutputs     ? 12
                                              : 9;
}

/// All tiles of patches [patch, end).
template <detail::OutputSet kOutputs, Scheme kScheme, typename T>
SIMDBEZIER_INLINE void sweep_tiles(const GridTask<T>& task, const ColumnSplit<vec<T>>& split,
                                   const RowPiece<T>& piece, std::size_t patch, std::size_t end) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  constexpr std::size_t kHalf = kL >= 4 ? 2 : 1; // rows of a tile of lanes/2 columns
  constexpr std::size_t kQuarter = kL >= 8 ? 4 : kHalf;
  const auto sweep = [&]<typename SomeTile>(std::type_identity<SomeTile>, std::size_t first,
                                            std::size_t columns) SIMDBEZIER_INLINE_LAMBDA {
    sweep_tile<kOutputs, kScheme, SomeTile>(task, piece, first, columns, patch, end);
  };
  // A single column goes along with the last whole register.
  const std::size_t plain = split.column && split.full > 0 ? split.full - kL : split.full;
  if constexpr (kPutsRecords<V> && kUsual<kOutputs>) {
    if (task.record > 1) {
      sweep_record_tiles<kOutputs, kScheme>(task, piece, patch, end);
      return;
    }
  }
  if constexpr (kLineWide<V> && kUsual<kOutputs>) {
    if (task.streaming) [[unlikely]] { // whole registers only
      for (std::size_t first = 0; first < plain; first += kL) {
        sweep(std::type_identity<Tile<1, true, false, V, true>>{}, first, kL);
      }
      return;
    }
  }
  std::size_t first = 0;
  if constexpr (kSweepsTwice<kOutputs, T>) {
    using W = Twice<V>;
    for (; first + 2 * kL <= plain; first += 2 * kL) {
      sweep(std::type_identity<Tile<1, true, false, W>>{}, first, 2 * kL);
    }
    if (split.column && first + 2 * kL == split.full) {
      sweep(std::type_identity<Tile<1, true, true, W>>{}, first, 2 * kL);
      return;
    }
    if (split.rest > kL / 2 && first + kL == split.full) {
      sweep(std::type_identity<Tile<1, false, false, W>>{}, first, kL + split.rest);
      return;
    }
  }
  for (; first < plain; first += kL) {
    sweep(std::type_identity<Tile<1, true, false, V>>{}, first, kL);
  }
  if constexpr (kL > 1) {
    if constexpr (!kUsual<kOutputs>) {
      if (split.rest != 0) {
        sweep(std::type_identity<Tile<1, false, false, V>>{}, split.full, split.rest);
      }
    } else if (split.column) {
      if (split.full != 0) {
        sweep(std::type_identity<Tile<1, true, true, V>>{}, plain, kL);
      } else {
        sweep(std::type_identity<Tile<kL, false, false, V>>{}, 0, 1);
      }
    } else if (split.rest > kL / 2) {
      sweep(std::type_identity<Tile<1, false, false, V>>{}, split.full, split.rest);
    } else if (kLineWide<V> && task.nu == kL / 2) { // short registers gain nothing by this
      sweep(std::type_identity<Tile<kHalf, true, false, V>>{}, 0, kL / 2);
    } else if (kLineWide<V> && task.nu == kL / 4) {
      sweep(std::type_identity<Tile<kQuarter, true, false, V>>{}, 0, kL / 4);
    } else if (split.rest > kL / kQuarter) {
      sweep(std::type_identity<Tile<kHalf, false, false, V>>{}, split.full, split.rest);
    } else if (split.rest > 0) {
      sweep(std::type_identity<Tile<kQuarter, false, false, V>>{}, split.full, split.rest);
    }
  }
}

/// The same for a grid of kSide x kSide.
template <detail::OutputSet kOutputs, Scheme kScheme, std::size_t kSide, typename T>
SIMDBEZIER_INLINE void sweep_square(const GridTask<T>& task, const SquarePiece<T, kSide>& piece,
                                    std::size_t patch, std::size_t end) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  constexpr std::size_t kRest = kSide % kL;
  if constexpr (kSweepsTwice<kOutputs, T> && kSide >= 2 * kL && kSide % (2 * kL) <= 1) {
    using W = Twice<V>;
    constexpr std::size_t kLast = kSide - kRest - 2 * kL;
    for (std::size_t first = 0; first < kLast; first += 2 * kL) {
      sweep_tile<kOutputs, kScheme, Tile<1, true, false, W>>(task, piece, first, 2 * kL, patch,
                                                             end);
    }
    sweep_tile<kOutputs, kScheme, Tile<1, true, kRest == 1, W>>(task, piece, kLast, 2 * kL, patch,
                                                                end);
    return;
  }
  constexpr std::size_t kPlain = kSide - kRest - (kRest == 1 ? kL : 0);
  for (std::size_t first = 0; first < kPlain; first += kL) {
    sweep_tile<kOutputs, kScheme, Tile<1, true, false, V>>(task, piece, first, kL, patch, end);
  }
  if constexpr (kRest == 1) {
    sweep_tile<kOutputs, kScheme, Tile<1, true, true, V>>(task, piece, kPlain, kL, patch, end);
  } else if constexpr (kSide * 2 == kL) {
    sweep_tile<kOutputs, kScheme, Tile<2, true, false, V>>(task, piece, 0, kSide, patch, end);
  } else if constexpr (kRest != 0) {
    sweep_tile<kOutputs, kScheme, Tile<1, false, false, V>>(task, piece, kPlain, kRest, patch, end);
  }
}

/// Sweeps the patches if `piece` is a square with one of these sides.
template <detail::OutputSet kOutputs, Scheme kScheme, std::size_t... kSides, typename T>
SIMDBEZIER_INLINE bool sweep_square_of(std::index_sequence<kSides...>, const GridTask<T>& task,
                                       const RowPiece<T>& piece, std::size_t patch,
                                       std::size_t end) {
  const auto sweep =
      [&]<std::size_t kSide>(std::integral_constant<std::size_t, kSide>) SIMDBEZIER_INLINE_LAMBDA {
        const bool square = SquarePiece<T, kSide>::is(piece, task.nu);
        if (square) {
          sweep_square<kOutputs, kScheme>(task, SquarePiece<T, kSide>(piece.middle.y), patch, end);
        }
        return square;
      };
  return (sweep(std::integral_constant<std::size_t, kSides>{}) || ...);
}

/// The squares that gain by code of their own, 5 to 60 %: 2^k and 2^k + 1, as far as neither stores
/// (derivatives of 32) nor roots (normals of 16 and more) set the pace.
template <detail::OutputSet kOutputs>
SIMDBEZIER_INLINE constexpr auto known_sides() {
  if constexpr (kOutputs == detail::kPosition) {
    return std::index_sequence<8, 9, 16, 17, 32, 33>{};
  } else if constexpr (kOutputs == detail::kPositionDerivatives) {
    return std::index_sequence<8, 9, 16, 17, 33>{};
  } else {
    return std::index_sequence<8, 9, 17>{};
  }
}

/// Whether there is such code at all: for registers of 32 bytes and more, and edges as usual.
template <detail::OutputSet kOutputs, Scheme kScheme, typename T>
constexpr bool kKnowsSquares = kUsual<kOutputs> && (kScheme == detail::kWatertight) &&
                               (kLanes<vec<T>> * sizeof(T) >= 32);

template <typename T, detail::OutputSet kOutputs, Scheme kScheme>
void grid_kernel(GridTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  if (sweep_small_grid<kOutputs, kScheme>(task)) {
    return;
  }
  const ColumnSplit<vec<T>> split(task.nu, kUsual<kOutputs>);
  const std::size_t most = split.column ? kBufferRows : std::size_t{1} << 30;
  for (RowPieces<kScheme, T> pieces(task, most); pieces.more();) {
    const RowPiece<T> piece = pieces.next();
    const std::size_t bytes = piece.rows() * task.nu * written_planes(kOutputs) * sizeof(T);
    const std::size_t together = kCachedBytes / bytes + 1;
    for (std::size_t patch = 0; patch < task.patch_count; patch += together) {
      const std::size_t left = task.patch_count - patch;
      const std::size_t end = patch + (left < together ? left : together);
      if constexpr (kKnowsSquares<kOutputs, kScheme, T>) {
        if (task.record <= 1 && !task.streaming &&
            sweep_square_of<kOutputs, kScheme>(known_sides<kOutputs>(), task, piece, patch, end)) {
          continue;
        }
      }
      sweep_tiles<kOutputs, kScheme>(task, split, piece, patch, end);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
