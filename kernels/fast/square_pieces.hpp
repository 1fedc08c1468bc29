// Grids whose size the compiler knows, as pieces: straight code, and rows in whole lines.
#pragma once

#include <type_traits>
#include <utility>

#include "kernels/grid/row_pieces.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Parameters of rows of which two share a register, spread over its lanes once for all patches.
template <typename T, std::size_t kSide, bool kAcross>
struct SharedRows {
  using V = vec<T>;
  static constexpr std::size_t kRegisters = kSide / 2 - 1;

  /// These are the rows of the middle in their order. Across lines, the first register has those
  /// beside edges.
  RowPoint<V> rows[kRegisters];

  explicit SIMDBEZIER_PART SharedRows(const T* y)
      : SharedRows(y, std::make_index_sequence<kRegisters>()) {}

  /// Returns the parameters of the rows from number `row` of the middle on.
  SIMDBEZIER_PART const RowPoint<V>& from(std::size_t row) const {
    return rows[(row + (kAcross ? 1 : 0)) / 2];
  }

private:
  template <std::size_t... kNumbers>
  SIMDBEZIER_PART SharedRows(const T* y, std::index_sequence<kNumbers...>)
      : rows{RowPoint<V>(spread<kNumbers>(y))...} {}

  template <std::size_t kNumber>
  static SIMDBEZIER_PART V spread(const T* y) {
    if constexpr (kAcross && kNumber == 0) {
      const T ends[2] = {y[0], y[kSide - 3]};
      return RowGroups<2, V>::spread(ends);
    } else {
      return RowGroups<2, V>::spread(y + 2 * kNumber - (kAcross ? 1 : 0));
    }
  }
};

/// A whole grid of kSide x kSide samples, whose first and last rows are edges and whose others are
/// pairs. The compiler knows its size, so that sweeps are straight code, without counting, tests
/// and addresses: 198 instead of 389 instructions for the positions of an 8 x 8 grid, 660 instead
/// of 1022 for 17 x 17 (AVX-512). kLiesAcross: rows begin anywhere in cache lines, which are put
/// together; otherwise rows that share lines are for machines where stores across lines are cheap.
template <typename T, std::size_t kSide, bool kLiesAcross>
struct SquarePiece {
  static constexpr bool kKnown = true;
  static constexpr bool kAcross = kLiesAcross;
  static constexpr std::size_t first = 0;
  static constexpr bool lead = true;
  static constexpr bool trail = true;
  static constexpr std::size_t kMiddle = kSide - 2;

  struct Middle {
    const T* y; ///< of RowPowers
    static constexpr RowKind kind = RowKind::interior;
  } middle;

  static constexpr bool kTwoRows = kSide * 2 == kLanes<vec<T>>; ///< a register
  std::conditional_t<kTwoRows, SharedRows<T, kSide, kLiesAcross>, Nothing> shared;

  explicit SIMDBEZIER_PART SquarePiece(const T* middle_y) : middle{middle_y}, shared(middle_y) {}

  /// Returns what RowPiece::point() does.
  template <std::size_t kRows, typename V>
  SIMDBEZIER_INLINE RowPoint<V> point(const T* y) const {
    if constexpr (kTwoRows && kRows == 2) {
      return shared.from(static_cast<std::size_t>(y - middle.y));
    } else {
      return RowPowers<T>::template point<kRows, V>(y);
    }
  }
  static constexpr std::size_t rows() { return kSide; }
  static constexpr std::size_t columns(std::size_t /*nu*/) { return kSide; }

  /// Whether `piece` is one.
  static SIMDBEZIER_PART bool is(const RowPiece<T>& piece, std::size_t nu) {
    return nu == kSide && piece.first == 0 && piece.middle.rows == kMiddle && piece.lead &&
           piece.trail && piece.lead_kind == RowKind::edge_v0 &&
           piece.trail_kind == RowKind::edge_v1 && piece.middle.kind == RowKind::interior &&
           piece.mirrored;
  }
};

/// This is for_rows() of other pieces, but one register stands behind the other throughout.
/// RowOrder::together = 1 keeps a loop.
template <RowOrder kRowOrder, typename T, std::size_t kSide, bool kAcross, typename Edge,
          typename Pair, typename Interior>
SIMDBEZIER_INLINE void for_rows(const SquarePiece<T, kSide, kAcross>& piece, std::size_t at,
                                std::size_t nu, const Edge& edge, const Pair& pair,
                                const Interior& interior) {
  constexpr std::size_t kRows = kRowOrder.rows;
  constexpr std::size_t kMiddle = kSide - 2;
  constexpr bool kInPairs = kRowOrder.pairs != RowPairs::never;
  constexpr std::size_t kPairs = kInPairs ? kMiddle / (2 * kRows) : 0; // registers
  constexpr std::size_t kSingle = kMiddle - 2 * kPairs * kRows;        // rows
  constexpr std::size_t kFull = kSingle / kRows;
  const T* const y = piece.middle.y;
  const RowPlace first{at + nu, 1};
  const RowPlace last{at + kMiddle * nu, kMiddle};
  const auto pair_at = [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    const std::size_t row = k * kRows;
    pair(y + row, first.behind(row, nu), RowPlace{last.at - row * nu, last.row - row});
  };
  const auto single_at = [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    const std::size_t row = (kPairs + k) * kRows;
    interior(y + row, first.behind(row, nu), kRows);
  };
  edge(RowKind::edge_v0, RowPlace{at, 0});
  if constexpr (kRowOrder.together > 1) {
    repeat<kPairs>(pair_at);
    repeat<kFull>(single_at);
  } else {
    for (std::size_t k = 0; k < kPairs; ++k) {
      pair_at(k);
    }
    for (std::size_t k = 0; k < kFull; ++k) {
      single_at(k);
    }
  }
  if constexpr (kFull * kRows < kSingle) {
    const std::size_t row = (kPairs + kFull) * kRows;
    interior(y + row, first.behind(row, nu), kSingle - kFull * kRows);
  }
  edge(RowKind::edge_v1, last.behind(1, nu));
}

/// Calls rows(y, place) for the rows between those beside the edges, two a register.
template <typename T, std::size_t kSide, bool kAcross, typename Rows>
SIMDBEZIER_INLINE void for_inner_rows(const SquarePiece<T, kSide, kAcross>& piece, std::size_t nu,
                                      const Rows& rows) {
  repeat<kSide / 2 - 2>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    const std::size_t row = 2 + 2 * k;
    rows(piece.middle.y + row - 1, RowPlace{row * nu, row});
  });
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
