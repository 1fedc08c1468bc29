// The rows of a grid in pieces that a tile sweeps in one go: from both ends towards the middle,
// where their parameters are mirror images, since rows Y and -Y share most of their arithmetic
// (poly/even_odd.hpp).
#pragma once

#include "kernels/poly/even_odd.hpp"
#include "kernels/poly/row_runs.hpp"
#include "kernels/simd/repeat.hpp"
#include "kernels/simd/row_groups.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A piece has at most so many rows that are on no edge.
constexpr std::size_t kMostMiddleRows = 128;

#if defined(SIMDBEZIER_KERNELS_SSE2) && !defined(SIMDBEZIER_KERNELS_SIMD128)
/// Parameters of rows and their squares in memory, in all lanes of a register each: SSE2 has no
/// instruction that brings a value to all lanes. What is their double is computed: memory that rows
/// do not need stays in the first-level cache instead.
template <typename T>
class RowPowers {
  using Register = vec<T>;

public:
  static constexpr std::size_t kStep = 2 * kLanes<Register>; ///< values from one row to the next

  /// y is readable as far as RowRun::y.
  SIMDBEZIER_PART const T* fill(const T* y, std::size_t rows) {
    // Registers of several rows read beyond the last one.
    for (std::size_t k = 0; k < rows + kLanes<Register>; ++k) {
      const auto at = broadcast<Register>(y[k]);
      store_vector(values_ + k * kStep, at);
      store_vector(values_ + k * kStep + kLanes<Register>, at * at);
    }
    return values_;
  }

  /// Returns the parameters of a register of kRows rows, the first of which has its own at y.
  template <std::size_t kRows, typename V>
  static SIMDBEZIER_PART V parameters(const T* y) {
    constexpr std::size_t kColumns = kLanes<V> / kRows;
    return from_lanes<V>([y](std::size_t i)
                             SIMDBEZIER_INLINE_LAMBDA { return y[i / kColumns * kStep]; });
  }
  /// Returns the points of such a register.
  template <std::size_t kRows, typename V>
  static SIMDBEZIER_PART RowPoint<V> point(const T* y) {
    if constexpr (kRows > 1) {
      return RowPoint<V>(parameters<kRows, V>(y));
    } else {
      const V of_row = in_all_lanes<V>(y);
      const V square = in_all_lanes<V>(y + kLanes<Register>);
      return {of_row, square, of_row + of_row, square + square};
    }
  }

private:
  template <typename V>
  static SIMDBEZIER_INLINE V in_all_lanes(const T* values) {
    // Only what is aligned may be an operand of an instruction.
    const void* const aligned = __builtin_assume_aligned(values, sizeof(Register));
    const auto all = load_vector<Register>(static_cast<const T*>(aligned));
    if constexpr (kLanes<V> == kLanes<Register>) {
      return all;
    } else {
      return {all, all};
    }
  }

  alignas(64) T values_[(kMostMiddleRows + detail::kMaxLanes) * kStep];
};
#else
/// Parameters of rows and what RowPoint takes besides, in memory: at constant distances, so that
/// one address serves all of them.
template <typename T>
class RowPowers {
public:
  static constexpr std::size_t kStep = 1; ///< values from one row to the next

  /// y is readable as far as RowRun::y.
  SIMDBEZIER_PART const T* fill(const T* y, std::size_t rows) {
    using V = vec<T>;
    for (std::size_t k = 0; k < rows; k += kLanes<V>) {
      const RowPoint<V> at(load_vector<V>(y + k));
      store_vector(values_ + k, at.y);
      store_vector(values_ + kPlane + k, at.square);
      store_vector(values_ + 2 * kPlane + k, at.twice);
      store_vector(values_ + 3 * kPlane + k, at.twice_square);
    }
    return values_;
  }

  /// Returns the parameters of a register of kRows rows, the first of which has its own at y.
  template <std::size_t kRows, typename V>
  static SIMDBEZIER_PART V parameters(const T* y) {
    return RowGroups<kRows, V>::spread(y);
  }
  /// Returns the points of such a register. With several rows, powers are computed anew, since
  /// stored ones would have to be spread over the lanes.
  template <std::size_t kRows, typename V>
  static SIMDBEZIER_PART RowPoint<V> point(const T* y) {
    if constexpr (kRows > 1) {
      return RowPoint<V>(parameters<kRows, V>(y));
    } else {
      return {broadcast<V>(y[0]), broadcast<V>(y[kPlane]), broadcast<V>(y[2 * kPlane]),
              broadcast<V>(y[3 * kPlane])};
    }
  }

private:
  static constexpr std::size_t kPlane = kMostMiddleRows + detail::kMaxLanes;
  alignas(64) T values_[4 * kPlane];
};
#endif

/// Rows that a tile sweeps in one go: one on an edge, some that are not, one on an edge. A usual
/// grid is one such piece.
template <typename T>
struct RowPiece {
  static constexpr bool kKnown = false;  ///< how many rows
  static constexpr bool kAcross = false; ///< lie across lines, which are put together

  std::size_t first = 0; ///< row
  bool lead = false;     ///< whether there is a first row on an edge, and which
  RowKind lead_kind = RowKind::edge_v0;
  RowRun<T> middle{nullptr, 0, RowKind::interior}; ///< y: of RowPowers
  bool mirrored = false;                           ///< the middle is pairs of rows
  bool by_lines = false;                           ///< as GridTask has it
  bool trail = false;
  RowKind trail_kind = RowKind::edge_v1;

  [[nodiscard]] SIMDBEZIER_PART std::size_t rows() const {
    return std::size_t{middle.rows} + (lead ? 1 : 0) + (trail ? 1 : 0);
  }
  /// Whether rows are those of a whole uniform grid, from edge to edge.
  [[nodiscard]] SIMDBEZIER_PART bool is_closed() const {
    return lead && lead_kind == RowKind::edge_v0 && mirrored && trail &&
           trail_kind == RowKind::edge_v1;
  }
  /// Returns the parameters of a register of kRows rows, the first of which has its own at y.
  template <std::size_t kRows, typename V>
  static SIMDBEZIER_INLINE RowPoint<V> point(const T* y) {
    return RowPowers<T>::template point<kRows, V>(y);
  }
  /// Returns the columns of a grid whose task says nu. SquarePiece knows them.
  static SIMDBEZIER_PART std::size_t columns(std::size_t nu) { return nu; }
};

/// A piece whose rows lie across lines and are as wide as their tile, which writes them as a stream
/// of whole lines.
template <typename T>
struct AcrossPiece : RowPiece<T> {
  static constexpr bool kAcross = true;
  explicit SIMDBEZIER_PART AcrossPiece(const RowPiece<T>& piece) : RowPiece<T>(piece) {}
};

/// Cuts the rows of a task into pieces.
template <typename T>
class RowPieces {
public:
  explicit SIMDBEZIER_PART RowPieces(const GridTask<T>& task)
      : run_(task.runs), last_(task.runs + task.run_count), left_(run_->rows),
        watertight_(task.watertight), by_lines_(task.by_lines) {}

  [[nodiscard]] SIMDBEZIER_PART bool more() const { return run_ != last_; }

  /// powers has to live as long as the piece is used.
  SIMDBEZIER_PART RowPiece<T> next(RowPowers<T>& powers) {
    RowPiece<T> piece;
    piece.first = row_;
    piece.by_lines = by_lines_;
    piece.lead = take_edge(piece.lead_kind);
    if (more() && !at_edge()) {
      piece.middle = {run_->y + (run_->rows - left_), 0, run_->kind};
      const bool outside = run_->kind == RowKind::outside;
      while (more() && !at_edge() && (run_->kind == RowKind::outside) == outside &&
             piece.middle.rows < kMostMiddleRows) {
        const std::size_t room = kMostMiddleRows - piece.middle.rows;
        piece.middle.rows += static_cast<std::uint32_t>(take(left_ < room ? left_ : room));
      }
      piece.mirrored = are_mirrored(piece.middle.y, piece.middle.rows);
      piece.middle.y = powers.fill(piece.middle.y, piece.middle.rows);
    }
    piece.trail = take_edge(piece.trail_kind);
    row_ += piece.rows();
    return piece;
  }

private:
  /// Whether the next row is on an edge. Where edges are not special, they are as good as any row.
  [[nodiscard]] SIMDBEZIER_PART bool at_edge() const { return watertight_ && is_edge(run_->kind); }
  SIMDBEZIER_PART bool take_edge(RowKind& kind) {
    if (!more() || !at_edge()) {
      return false;
    }
    kind = run_->kind;
    take(1);
    return true;
  }
  SIMDBEZIER_PART std::size_t take(std::size_t rows) {
    left_ -= rows;
    if (left_ == 0 && ++run_ != last_) {
      left_ = run_->rows;
    }
    return rows;
  }

  const RowRun<T>* run_;
  const RowRun<T>* last_;
  std::size_t left_; ///< rows of *run_
  bool watertight_;
  bool by_lines_;
  std::size_t row_ = 0;
};

/// A row in the planes and in its piece.
struct RowPlace {
  std::size_t at; ///< its first sample
  std::size_t row;

  SIMDBEZIER_PART RowPlace behind(std::size_t rows, std::size_t nu) const {
    return {at + rows * nu, row + rows};
  }
};

/// Whether rows and their mirror images are computed together.
enum class RowPairs {
  never,
  where_splits_are_cheap, ///< rows share cache lines: not where stores across lines are slow
  always
};

/// How a tile sweeps its rows.
struct RowOrder {
  std::size_t rows; ///< of a register
  RowPairs pairs;
  std::size_t together; ///< registers that are computed one behind the other, without a loop
};

/// Sweeps all rows of a piece, from sample `at` of the planes on. It calls edge(kind, place) for
/// edges; pair(y, place, mirrored) for a register of rows from `place` on and their mirror images
/// from `mirrored` back; interior(y, place, rows) for other rows, at most a register of them.
template <RowOrder kRowOrder, typename T, typename Edge, typename Pair, typename Interior>
SIMDBEZIER_INLINE void for_rows(const RowPiece<T>& piece, std::size_t at, std::size_t nu,
                                const Edge& edge, const Pair& pair, const Interior& interior) {
  constexpr std::size_t kRows = kRowOrder.rows;
  const RowPlace lead{at, 0};
  RowPlace place = piece.lead ? lead.behind(1, nu) : lead;
  if (!kSimd128 && piece.lead) {
    edge(piece.lead_kind, lead);
  }
  const T* y = piece.middle.y;
  std::size_t left = piece.middle.rows;
  const RowPlace trail = place.behind(left, nu);
  const auto step = [&](std::size_t rows) SIMDBEZIER_INLINE_LAMBDA {
    place = place.behind(rows, nu);
    y += rows * RowPowers<T>::kStep;
  };
  if constexpr (kRowOrder.pairs != RowPairs::never) {
    if (piece.mirrored && (kRowOrder.pairs == RowPairs::always || !piece.by_lines)) {
      RowPlace mirrored{trail.at - nu, trail.row - 1};
      for (; left >= 2 * kRows; left -= 2 * kRows) {
        pair(y, place, mirrored);
        step(kRows);
        mirrored.at -= kRows * nu;
        mirrored.row -= kRows;
      }
    }
  }
  constexpr std::size_t kTogether = kRowOrder.together;
  if constexpr (kTogether > 1) {
    for (; left >= kTogether * kRows; left -= kTogether * kRows) {
      repeat<kTogether>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
        interior(y + k * kRows * RowPowers<T>::kStep, place.behind(k * kRows, nu), kRows);
      });
      step(kTogether * kRows);
    }
  }
  for (; left >= kRows; left -= kRows) {
    interior(y, place, kRows);
    step(kRows);
  }
  if (kRows > 1 && left > 0) {
    interior(y, place, left);
  }
  if (kSimd128 && piece.lead) { // V8 would put off what other rows alone take, and keep more for it
    edge(piece.lead_kind, lead);
  }
  if (piece.trail) {
    edge(piece.trail_kind, trail);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
