// Squares whose sides the compiler knows: which tiles take them.
#pragma once

#include <utility>

#include "kernels/grid/tile_sweeps.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether tiles of such squares are two registers. Planes of derivatives that go one by one have
/// half the polynomials at a time, so that there is room for two of AVX2's registers: squares
/// of 17.
template <detail::OutputSet kOutputs, std::size_t kSide, typename T>
constexpr bool
    kSquaresInPairs = kSweepsTwice<kOutputs, T> ||
                      (kOutputs == detail::kPositionDerivatives &&
                       kGoesPlaneByPlane<SquarePiece<T, kSide, false>,
                                         ColumnTile<1, true, true, RegisterPair<vec<T>>>>);

/// Sweeps all tiles of patches [patch, end) of a grid of kSide x kSide, choosing as sweep_tiles()
/// does.
template <detail::OutputSet kOutputs, std::size_t kSide, bool kAcross, typename T>
SIMDBEZIER_PART void sweep_square(const GridTask<T>& task,
                                  const SquarePiece<T, kSide, kAcross>& piece, std::size_t patch,
                                  std::size_t end) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  constexpr std::size_t kRest = kSide % kL;
  if constexpr (kSquaresInPairs<kOutputs, kSide, T> && kSide >= 2 * kL && kSide % (2 * kL) <= 1) {
    using W = RegisterPair<V>;
    constexpr std::size_t kLast = kSide - kRest - 2 * kL;
    for (std::size_t first = 0; first < kLast; first += 2 * kL) {
      sweep_tile<kOutputs, Known::watertight, ColumnTile<1, true, false, W>>(task, piece, first,
                                                                             2 * kL, patch, end);
    }
    sweep_tile<kOutputs, Known::watertight, ColumnTile<1, true, kRest == 1, W>>(task, piece, kLast,
                                                                                2 * kL, patch, end);
    return;
  }
  constexpr std::size_t kKnown = kSide - kRest - (kRest == 1 ? kL : 0);
  for (std::size_t first = 0; first < kKnown; first += kL) {
    sweep_tile<kOutputs, Known::watertight, ColumnTile<1, true, false, V>>(task, piece, first, kL,
                                                                           patch, end);
  }
  if constexpr (kRest == 1) {
    sweep_tile<kOutputs, Known::watertight, ColumnTile<1, true, true, V>>(task, piece, kKnown, kL,
                                                                          patch, end);
  } else if constexpr (kSide * 2 == kL) {
    sweep_tile<kOutputs, Known::watertight, ColumnTile<2, true, false, V>>(task, piece, 0, kSide,
                                                                           patch, end);
  } else if constexpr (kRest != 0) {
    sweep_tile<kOutputs, Known::watertight, ColumnTile<1, false, false, V>>(task, piece, kKnown,
                                                                            kRest, patch, end);
  }
}

/// Whether such squares are put together to whole lines where their rows share lines and stores
/// across lines are slow: a tile has whole rows. Normals, of three components at once, have no
/// registers left for that.
template <detail::OutputSet kOutputs, std::size_t kSide, typename T>
constexpr bool kIsStream = kStreamsLines && (kOutputs != detail::kPositionNormal) &&
                           (kSide >= kLanes<vec<T>> / 2) && (kSide <= 2 * kLanes<vec<T>> + 1) &&
                           (kSide < 32);

/// Whether that pays in staging as well, which stays in the first-level cache: splitting stores
/// costs less there.
template <detail::OutputSet kOutputs, std::size_t kSide, typename T>
constexpr bool kIsStagedStream = (kSide <= kLanes<vec<T>> + 1) &&
                                 ((kSide * 2 == kLanes<vec<T>>) ||
                                  (kOutputs == detail::kPositionDerivatives));

/// Whether straight code pays for them on some machine: not where roots set the pace, nor for
/// derivatives of many registers a row, which are faster side by side, in bands. Of two registers
/// of a line and a column, they are as fast.
template <detail::OutputSet kOutputs, std::size_t kSide, typename T>
constexpr bool kIsStraight = kOutputs == detail::kPositionNormal ? kSide % 16 != 0
                             : kOutputs == detail::kPositionDerivatives
                                 ? kSide <= (kLineWide<vec<T>> ? 1 : 2) * kLanes<vec<T>> + 1 ||
                                       (kLineWide<vec<T>> && kSide % 16 == 0)
                                 : true;

/// Whether straight code pays only if stores across lines are cheap: if rows have a column or a
/// part of a register behind whole ones, for squares of 32, and for derivatives of more than one
/// tile, which are faster in bands elsewhere. Normals are the same everywhere.
template <detail::OutputSet kOutputs, std::size_t kSide, typename T>
constexpr bool kNeedsCheapSplits =
    kOutputs != detail::kPositionNormal &&
    ((kSide % kLanes<vec<T>> != 0 && kLanes<vec<T>> != kSide * 2) || kSide == 32 ||
     (kOutputs == detail::kPositionDerivatives &&
      kSide > (kSquaresInPairs<kOutputs, kSide, T> ? 2 : 1) * kLanes<vec<T>> + 1));

/// Calls visit.operator()<Square>() if the piece is a square with one of these sides and there is
/// code for it, and returns whether it is.
template <detail::OutputSet kOutputs, std::size_t... kSides, typename T, typename Visit>
SIMDBEZIER_INLINE bool with_square_of(std::index_sequence<kSides...> /*sides*/,
                                      const GridTask<T>& task, const RowPiece<T>& piece,
                                      const Visit& visit) {
  const auto try_side =
      [&]<std::size_t kSide>(std::integral_constant<std::size_t, kSide>) SIMDBEZIER_INLINE_LAMBDA {
        if (!SquarePiece<T, kSide, false>::is(piece, task.nu)) {
          return false;
        }
        if constexpr (kIsStream<kOutputs, kSide, T>) {
          const bool pays = kIsStagedStream<kOutputs, kSide, T> || task.drain == nullptr;
          if (task.by_lines && pays && (kSide % kLanes<vec<T>> != 0 || !planes_begin_lines(task))) {
            visit.template operator()<SquarePiece<T, kSide, true>>();
            return true;
          }
        }
        if constexpr (kIsStraight<kOutputs, kSide, T>) {
          if (!kNeedsCheapSplits<kOutputs, kSide, T> || !task.by_lines) {
            visit.template operator()<SquarePiece<T, kSide, false>>();
            return true;
          }
        }
        return false;
      };
  return (try_side(std::integral_constant<std::size_t, kSides>{}) || ...);
}

/// Squares that gain by code of their own.
using SquareSides = std::index_sequence<8, 9, 16, 17, 32>;

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
