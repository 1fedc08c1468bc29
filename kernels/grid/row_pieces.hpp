// The rows of a grid in pieces that a tile sweeps in one go.
#pragma once

#include "kernels/simd/row_groups.hpp"
#include "src/storage/patch_storage.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridTask;
using detail::RowKind;
using detail::RowRun;

SIMDBEZIER_INLINE bool is_edge(RowKind kind) {
  return kind == RowKind::edge_v0 || kind == RowKind::edge_v1;
}

SIMDBEZIER_INLINE std::size_t edge_of(RowKind kind) {
  return kind == RowKind::edge_v0 ? detail::kEdgeV0 : detail::kEdgeV1;
}

/// Rows that a tile sweeps in one go: one on an edge, some that are not, one on an edge. A usual
/// grid is one such piece.
template <typename T>
struct RowPiece {
  static constexpr bool kKnown = false; ///< how many rows

  std::size_t first = 0; ///< row
  bool lead = false;     ///< whether there is a first row on an edge, and which
  RowKind lead_kind = RowKind::edge_v0;
  RowRun<T> middle{nullptr, 0, RowKind::interior};
  bool trail = false;
  RowKind trail_kind = RowKind::edge_v1;

  [[nodiscard]] SIMDBEZIER_INLINE std::size_t rows() const {
    return std::size_t{middle.rows} + (lead ? 1 : 0) + (trail ? 1 : 0);
  }
  /// Of the grid, where its task says nu.
  static SIMDBEZIER_INLINE std::size_t columns(std::size_t nu) { return nu; }
};

/// A whole grid of kSide x kSide samples, whose first and last rows are edges. Its size known to
/// the compiler, sweeps are straight code, without counting, tests and addresses: 198 instead of
/// 389 instructions for the positions of an 8 x 8 grid, 660 instead of 1022 for 17 x 17 (AVX-512).
template <typename T, std::size_t kSide>
struct SquarePiece {
  static constexpr bool kKnown = true;
  static constexpr std::size_t first = 0;
  static constexpr bool lead = true;
  static constexpr bool trail = true;
  static constexpr std::size_t kMiddle = kSide - 2;

  struct Middle {
    T y[kMiddle + detail::kMaxLanes]; ///< a copy: no store of samples can change it
    static constexpr RowKind kind = RowKind::interior;
  } middle;

  /// middle_y: as RowRun::y.
  explicit SIMDBEZIER_INLINE SquarePiece(const T* middle_y) {
    __builtin_memcpy(middle.y, middle_y, sizeof(middle.y));
  }
  static constexpr std::size_t rows() { return kSide; }
  static constexpr std::size_t columns(std::size_t /*nu*/) { return kSide; }

  /// Whether `piece` is one.
  static SIMDBEZIER_INLINE bool is(const RowPiece<T>& piece, std::size_t nu) {
    return nu == kSide && piece.first == 0 && piece.middle.rows == kMiddle && piece.lead &&
           piece.trail && piece.lead_kind == RowKind::edge_v0 &&
           piece.trail_kind == RowKind::edge_v1 && piece.middle.kind == RowKind::interior;
  }
};

/// Cuts the rows of a task into pieces.
template <typename T>
class RowPieces {
public:
  /// most: rows of a piece.
  SIMDBEZIER_INLINE RowPieces(const GridTask<T>& task, std::size_t most)
      : run_(task.runs), last_(task.runs + task.run_count), left_(run_->rows), most_(most - 2),
        watertight_(task.watertight) {}

  [[nodiscard]] SIMDBEZIER_INLINE bool more() const { return run_ != last_; }

  SIMDBEZIER_INLINE RowPiece<T> next() {
    RowPiece<T> piece;
    piece.first = row_;
    piece.lead = take_edge(piece.lead_kind);
    if (more() && !at_edge()) {
      piece.middle = {run_->y + (run_->rows - left_), 0, run_->kind};
      const bool outside = run_->kind == RowKind::outside;
      while (more() && !at_edge() && (run_->kind == RowKind::outside) == outside &&
             piece.middle.rows < most_) {
        const std::size_t room = most_ - piece.middle.rows;
        piece.middle.rows += static_cast<std::uint32_t>(take(left_ < room ? left_ : room));
      }
    }
    piece.trail = take_edge(piece.trail_kind);
    row_ += piece.rows();
    return piece;
  }

private:
  /// Where edges are not special, they are as good as any row.
  [[nodiscard]] SIMDBEZIER_INLINE bool at_edge() const {
    return watertight_ && is_edge(run_->kind);
  }
  SIMDBEZIER_INLINE bool take_edge(RowKind& kind) {
    if (!more() || !at_edge()) {
      return false;
    }
    kind = run_->kind;
    take(1);
    return true;
  }
  SIMDBEZIER_INLINE std::size_t take(std::size_t rows) {
    left_ -= rows;
    if (left_ == 0 && ++run_ != last_) {
      left_ = run_->rows;
    }
    return rows;
  }

  const RowRun<T>* run_;
  const RowRun<T>* last_;
  std::size_t left_; ///< rows of *run_
  std::size_t most_; ///< in the middle of a piece
  bool watertight_;
  std::size_t row_ = 0;
};

/// All rows of a piece, from sample `at` of the planes on: edge(kind, at, row) for edges,
/// interior(y, at, row, rows) for as many rows as a register holds, kTogether times one behind the
/// other where there are enough of them.
template <std::size_t kRows, std::size_t kTogether = 1, typename T, typename Edge,
          typename Interior>
SIMDBEZIER_INLINE void for_rows(const RowPiece<T>& piece, std::size_t at, std::size_t nu, Edge edge,
                                Interior interior) {
  std::size_t row = 0;
  if (piece.lead) {
    edge(piece.lead_kind, at, row++);
    at += nu;
  }
  const T* y = piece.middle.y;
  std::size_t left = piece.middle.rows;
  if constexpr (kTogether > 1) {
    for (; left >= kTogether * kRows; left -= kTogether * kRows) {
#pragma GCC unroll 8
      for (std::size_t k = 0; k < kTogether; ++k) {
        interior(y + k * kRows, at + k * kRows * nu, row + k * kRows, kRows);
      }
      at += kTogether * kRows * nu;
      y += kTogether * kRows;
      row += kTogether * kRows;
    }
  }
  for (; left >= kRows; left -= kRows) {
    interior(y, at, row, kRows);
    at += kRows * nu;
    y += kRows;
    row += kRows;
  }
  if (kRows > 1 && left > 0) {
    interior(y, at, row, left);
    at += left * nu;
    row += left;
  }
  if (piece.trail) {
    edge(piece.trail_kind, at, row);
  }
}

/// The same, one row behind the other throughout; kTogether = 1 keeps a loop.
template <std::size_t kRows, std::size_t kTogether = 1, typename T, std::size_t kSide,
          typename Edge, typename Interior>
SIMDBEZIER_INLINE void for_rows(const SquarePiece<T, kSide>& piece, std::size_t at, std::size_t nu,
                                Edge edge, Interior interior) {
  constexpr std::size_t kMiddle = SquarePiece<T, kSide>::kMiddle;
  constexpr std::size_t kFull = kMiddle / kRows * kRows;
  edge(RowKind::edge_v0, at, 0);
  if constexpr (kTogether > 1) {
#pragma GCC unroll 32
    for (std::size_t k = 0; k < kFull; k += kRows) {
      interior(piece.middle.y + k, at + (1 + k) * nu, 1 + k, kRows);
    }
  } else {
    std::size_t to = at + nu;
    for (std::size_t k = 0; k < kFull; k += kRows, to += kRows * nu) {
      interior(piece.middle.y + k, to, 1 + k, kRows);
    }
  }
  if constexpr (kFull < kMiddle) {
    interior(piece.middle.y + kFull, at + (1 + kFull) * nu, 1 + kFull, kMiddle - kFull);
  }
  edge(RowKind::edge_v1, at + (kSide - 1) * nu, kSide - 1);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
