// Squares whose sides the compiler knows: which tiles take them.
#pragma once

#include <utility>

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/register_pair.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether two registers of columns are swept as one, which counts rows half as often and writes to
/// no cache line twice. Their polynomials take 8 of 16 or 32 registers, or 16 of 32.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kSweepsTwice = (kOutputs == detail::kPosition && sizeof(T) * kLanes<vec<T>> >= 32) ||
                              (kOutputs == detail::kPositionDerivatives && kLineWide<vec<T>>);

/// Sweeps all tiles of patches [patch, end) of a grid of kSide x kSide, choosing as sweep_tiles()
/// does.
template <detail::OutputSet kOutputs, std::size_t kSide, bool kAcross, typename T>
SIMDBEZIER_PART void sweep_square(const GridTask<T>& task,
                                  const SquarePiece<T, kSide, kAcross>& piece, std::size_t patch,
                                  std::size_t end) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  constexpr std::size_t kRest = kSide % kL;
  // Planes that go one by one have half the polynomials at a time, so that there is room for two of
  // AVX2's registers: squares of 17.
  constexpr bool kByPlanes =
      kOutputs == detail::kPositionDerivatives &&
      kGoesPlaneByPlane<SquarePiece<T, kSide, kAcross>, ColumnTile<1, true, true, RegisterPair<V>>>;
  if constexpr ((kSweepsTwice<kOutputs, T> || kByPlanes) && kSide >= 2 * kL &&
                kSide % (2 * kL) <= 1) {
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
                           (kSide >= kLanes<vec<T>> / 2) && (kSide <= 2 * kLanes<vec<T>> + 1);

/// Whether that pays in staging as well, which stays in the first-level cache: splitting stores
/// costs less there.
template <detail::OutputSet kOutputs, std::size_t kSide, typename T>
constexpr bool kIsStagedStream = (kSide <= kLanes<vec<T>> + 1) &&
                                 ((kSide * 2 == kLanes<vec<T>>) ||
                                  (kOutputs == detail::kPositionDerivatives));

/// Whether such squares are short, so that straight code pays on any machine: not where roots set
/// the pace.
template <detail::OutputSet kOutputs, std::size_t kSide>
constexpr bool kIsShort = kSide <= 17 && (kOutputs != detail::kPositionNormal || kSide != 16);

/// Whether longer ones have straight code as well, for machines with cheap stores across lines: on
/// others it takes up to 1.6 times as long as a loop. Rows have four registers at most, and a
/// column behind them in positions only. With derivatives, bands of AVX2's floats are faster.
template <detail::OutputSet kOutputs, std::size_t kSide, typename T>
constexpr bool kIsLong = (kSide > 17) && (kSide <= 4 * kLanes<vec<T>> + 1) &&
                         (kOutputs == detail::kPosition ||
                          (kOutputs == detail::kPositionDerivatives &&
                           (kSide % kLanes<vec<T>> == 0) &&
                           (kLanes<vec<T>> != 8 || kLineWide<vec<T>>)));

/// Whether rows of such squares have a column or a part of a register behind whole ones, which
/// straight code has for machines with cheap stores across lines. Normals are the same everywhere.
template <detail::OutputSet kOutputs, std::size_t kSide, typename T>
constexpr bool kSharesLines = (kOutputs != detail::kPositionNormal) &&
                              (kSide % kLanes<vec<T>> != 0) && (kLanes<vec<T>> != kSide * 2);

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

/// Sweeps the patches as streams of whole lines if their rows lie across lines, stores across lines
/// are slow, and one tile without a column behind it is as wide as the rows. Positions in a part of
/// a register gain nothing by this.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool sweep_across_lines(const GridTask<T>& task, const RowPiece<T>& piece,
                                        std::size_t patch, std::size_t end) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  constexpr bool kDerivatives = kOutputs == detail::kPositionDerivatives;
  const std::size_t nu = task.nu;
  if constexpr (kDerivatives || kOutputs == detail::kPosition) {
    if (!task.by_lines || task.drain != nullptr || (nu % kL == 0 && planes_begin_lines(task))) {
      return false;
    }
    const AcrossPiece<T> across(piece);
    if (nu == kL) {
      sweep_tile<kOutputs, Known::watertight, ColumnTile<1, true, false, V>>(task, across, 0, nu,
                                                                             patch, end);
      return true;
    }
    if (nu == 2 * kL) {
      sweep_tile<kOutputs, Known::watertight, ColumnTile<1, true, false, RegisterPair<V>>>(
          task, across, 0, nu, patch, end);
      return true;
    }
    if constexpr (kDerivatives) {
      if (nu > kL / 2 && nu < kL) {
        sweep_tile<kOutputs, Known::watertight, ColumnTile<1, false, false, V>>(task, across, 0, nu,
                                                                                patch, end);
        return true;
      }
    }
  }
  return false;
}

/// Sweeps the patches if `piece` is a square with one of these sides, and there is code for it.
template <detail::OutputSet kOutputs, std::size_t... kSides, typename T>
SIMDBEZIER_PART bool sweep_square_of(std::index_sequence<kSides...>, const GridTask<T>& task,
                                     const RowPiece<T>& piece, std::size_t patch, std::size_t end) {
  const auto sweep =
      [&]<std::size_t kSide>(std::integral_constant<std::size_t, kSide>) SIMDBEZIER_INLINE_LAMBDA {
        if (!SquarePiece<T, kSide, false>::is(piece, task.nu)) {
          return false;
        }
        const auto* const y = piece.middle.y;
        if constexpr (kIsStream<kOutputs, kSide, T>) {
          const bool pays = kIsStagedStream<kOutputs, kSide, T> || task.drain == nullptr;
          if (task.by_lines && pays && (kSide % kLanes<vec<T>> != 0 || !planes_begin_lines(task))) {
            sweep_square<kOutputs>(task, SquarePiece<T, kSide, true>(y), patch, end);
            return true;
          }
        }
        constexpr bool kForCheapSplits =
            (kIsLong<kOutputs, kSide, T>) || (kSharesLines<kOutputs, kSide, T>);
        constexpr bool kIsStraight = (kIsShort<kOutputs, kSide>) || (kIsLong<kOutputs, kSide, T>);
        if constexpr (kIsStraight) {
          if (kForCheapSplits && task.by_lines) {
            return false;
          }
          sweep_square<kOutputs>(task, SquarePiece<T, kSide, false>(y), patch, end);
        }
        return kIsStraight;
      };
  return (sweep(std::integral_constant<std::size_t, kSides>{}) || ...);
}

/// Squares that gain by code of their own: of sides 2^k and 2^k + 1.
using SquareSides = std::index_sequence<8, 9, 16, 17, 32, 33>;

/// Whether there is such code at all: for registers of 32 bytes and more, and edges as usual.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kKnowsSquares = kUsual<kOutputs> && (kLanes<vec<T>> * sizeof(T) >= 32);

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
