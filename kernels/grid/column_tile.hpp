// Which samples of a grid stand in the lanes of a register.
//
// A tile is one register of columns (or two: simd/register_pair.hpp), swept along v: kRows rows of
// lanes/kRows columns at a time.
//   kRows = 1      the bulk of a row; `kWhole` false: its masked end
//   kRows = 2      the last lanes/2 columns or fewer, which would leave most lanes empty; `kWhole`:
//                  exactly as many, and the only ones, so that rows follow each other
//   kRows = lanes  a single column, into consecutive values: whole registers, also past its end
//                  (values that masked stores wrote cannot be read back at once)
// A single column behind whole registers is computed by a tile of its own into a buffer (`kExtra`),
// from where it is moved to the rows' ends as they are stored: stores to one place after the other.
// With several rows in a register, both edges v = const share one: v = 0 in its first half, v = 1
// in its second.
#pragma once

#include "kernels/grid/row_pieces.hpp"
#include "kernels/poly/bicubic.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The columns of a grid, by the tiles that take them.
template <typename V>
struct ColumnSplit {
  std::size_t full; ///< in whole registers
  std::size_t rest; ///< behind them
  bool single;      ///< and one more behind these

  explicit SIMDBEZIER_PART ColumnSplit(std::size_t nu, bool single_columns = true)
      : full(nu / kLanes<V> * kLanes<V>), rest(nu - full), single(false) {
    if (single_columns && full > 0 && rest == 1) {
      --rest;
      single = true;
    }
  }
  [[nodiscard]] SIMDBEZIER_PART std::size_t whole_registers() const { return full / kLanes<V>; }
  [[nodiscard]] SIMDBEZIER_PART std::size_t registers() const {
    return whole_registers() + (rest > 0 ? 1 : 0);
  }
};

/// The lanes that are corners of the patch, where both edges v = const share a register.
template <typename V>
struct SharedCorners {
  PairSelector<V> at_v0;
  PairSelector<V> at_v1;

  static SIMDBEZIER_PART MaskOf<V> first_half() {
    const ScalarOf<V> halves[2] = {0, 1};
    return RowGroups<2, V>::spread(halves) == broadcast<V>(ScalarOf<V>(0));
  }
  SIMDBEZIER_PART SharedCorners(V x, MaskOf<V> half)
      : at_v0((x == broadcast<V>(ScalarOf<V>(-0.5))) & half,
              (x == broadcast<V>(ScalarOf<V>(0.5))) & half),
        at_v1((x == broadcast<V>(ScalarOf<V>(-0.5))) & !half,
              (x == broadcast<V>(ScalarOf<V>(0.5))) & !half) {}
  explicit SIMDBEZIER_PART SharedCorners(V x) : SharedCorners(x, first_half()) {}

  SIMDBEZIER_PART V replace(V value, const ScalarOf<V>* corner) const {
    return at_v0.replace(at_v1.replace(value, corner + detail::corner_index(0, 1)),
                         corner + detail::corner_index(0, 0));
  }
};

template <std::size_t kRows, bool kWhole, bool kExtra, typename V, bool kStreams = false>
struct ColumnTile {
  static_assert(!kStreams || (kRows == 1 && kWhole && !kExtra));
  static_assert(kWhole || kRows <= 2);
  using T = ScalarOf<V>;
  using Vector = V;
  static constexpr std::size_t kTileRows = kRows;
  static constexpr bool kEveryLane = kWhole; ///< has a sample
  static constexpr bool kBuffered = kExtra;
  using Groups = RowGroups<kRows, V>;
  static constexpr std::size_t kColumns = kLanes<V> / kRows;
  /// Whether rows and their mirror images are computed together: where both are whole registers of
  /// their own. Others share cache lines with the rows beside them and, where stores across lines
  /// are slow, are faster one behind the other, except with normals, whose arithmetic outweighs
  /// that. Rows of more than a line gain nothing by it anywhere, and two rows a register only where
  /// it is a line.
  static constexpr bool kOwnLines = kRows == 1 && kWhole && !kExtra;
  static constexpr bool kTwoRows = kRows == 2 && !kWhole && kLineWide<V> && kLanes<V> > 2;
  static constexpr bool kOneLine = (kRows == 1 && sizeof(T) * kLanes<V> <= 64) || kTwoRows;
  static constexpr RowPairs kPairs = kOwnLines  ? RowPairs::always
                                     : kOneLine ? RowPairs::where_splits_are_cheap
                                                : RowPairs::never;
  static constexpr bool kNormalPairs =
      kRows == 1 || (kRows == 2 && kWhole && kLanes<V> > 2) || kTwoRows;
  static constexpr bool kShared = kRows > 1; ///< edges v = const share a register
  static constexpr bool kSingle = kRows == kLanes<V> && kHasFours<V>; ///< all lanes one column

  std::size_t first;  ///< column
  std::size_t active; ///< columns of kColumns that exist
  bool watertight;
  Column<V, kTurnsColumns<V> && kWhole && !kSingle> column;
  std::conditional_t<kShared, SharedCorners<V>, Nothing> corners;

  SIMDBEZIER_PART ColumnTile(const T* x, std::size_t first_column, std::size_t active_columns,
                             bool own_edges)
      : first(first_column), active(active_columns), watertight(own_edges),
        column(Groups::repeat(x + first_column), own_edges), corners(column.x) {}

  /// Stores the first `rows` rows of `value`, `step` samples from one to the next. extra is what
  /// follows them in kExtra tiles.
  SIMDBEZIER_PART void store(T* to, std::size_t step, V value, std::size_t rows,
                             const T* extra) const {
    if constexpr (kRows == kLanes<V>) {
      store_vector(to, value);
    } else if constexpr (kRows == 1) {
      if constexpr (kStreams) {
        store_streaming(to, value);
      } else if constexpr (kWhole) {
        store_vector(to, value);
      } else {
        store_first(to, value, active);
      }
    } else if (kWhole && rows == kRows) {
      store_vector(to, value);
    } else {
      store_lanes_from<kColumns, 0>(to, value, columns());
      if (rows > 1) {
        store_lanes_from<kColumns, kColumns>(to + step, value, columns());
      }
    }
    if constexpr (kExtra) {
      for (std::size_t r = 0; r < rows; ++r) {
        move_value(to + r * step + kColumns, extra + r);
      }
    }
  }
  /// Stores kRows rows in reverse order, from the one at `to` back.
  SIMDBEZIER_PART void store_mirrored(T* to, std::size_t step, V value, const T* extra) const {
    if constexpr (kRows == 1) {
      keep_stores_apart();
      store(to, step, value, 1, extra);
      keep_stores_apart();
    } else if constexpr (kNormalPairs) {
      static_assert(!kExtra);
      store_lanes_from<kColumns, 0>(to, value, columns());
      store_lanes_from<kColumns, kColumns>(to - step, value, columns());
    }
  }
  SIMDBEZIER_PART void store_if_wanted(T* plane, std::size_t at, std::size_t step, V value,
                                       std::size_t rows) const {
    if (plane != nullptr) {
      store(plane + at, step, value, rows, nullptr);
    }
  }

  /// Returns the first of the lanes in which an edge v = const stands.
  static SIMDBEZIER_PART std::size_t edge_lane(RowKind kind) {
    return kShared && kind == RowKind::edge_v1 ? kLanes<V> / 2 : 0;
  }
  SIMDBEZIER_PART void store_edge(T* to, V value, RowKind kind, const T* extra) const {
    if constexpr (!kShared) {
      store(to, 0, value, 1, extra);
      return;
    } else if (kind == RowKind::edge_v0) {
      store_lanes_from<kColumns, 0>(to, value, columns());
    } else {
      store_lanes_from<kColumns, kLanes<V> / 2>(to, value, columns());
    }
    if constexpr (kExtra) {
      move_value(to + kColumns, extra);
    }
  }
  SIMDBEZIER_PART void store_mirrored_if_wanted(T* plane, std::size_t at, std::size_t step,
                                                V value) const {
    if (plane != nullptr) {
      store_mirrored(plane + at, step, value, nullptr);
    }
  }
  SIMDBEZIER_PART void store_edge_if_wanted(T* plane, std::size_t at, V value, RowKind kind) const {
    if (plane != nullptr) {
      store_edge(plane + at, value, kind, nullptr);
    }
  }

  /// Returns the positions on the edge `edge`, or on both where they share a register, and du.
  SIMDBEZIER_PART V edge_rows(const Component<T>& c, std::size_t edge, V& du) const {
    V k[kOrder];
    edge_powers(c, edge, k);
    return finish(c, edge, row_value(k, column.along(), du));
  }
  SIMDBEZIER_PART V edge_rows(const Component<T>& c, std::size_t edge) const {
    V du; // takes no instruction where nothing reads it
    return edge_rows(c, edge, du);
  }
  SIMDBEZIER_PART V edge_rows_second(const Component<T>& c, std::size_t edge) const {
    V k[kOrder];
    edge_powers(c, edge, k);
    return row_second(k, column.along());
  }
  /// Returns the Y of these edges.
  static SIMDBEZIER_PART V edge_y(std::size_t edge) {
    constexpr T kBoth[2] = {T(-0.5), T(0.5)};
    if constexpr (kShared) {
      return RowGroups<2, V>::spread(kBoth);
    }
    return broadcast<V>(kBoth[edge]);
  }

private:
  /// Both halves of a line must be stored one after the other, or processors take twice as long for
  /// them; compilers would store a half of a row between those of its mirror image.
  static SIMDBEZIER_PART void keep_stores_apart() {
    if constexpr (kLanes<V> != kLanes<vec<T>>) {
      asm volatile("" ::: "memory");
    }
  }

  /// Returns `active`, as a constant where all columns exist.
  SIMDBEZIER_PART std::size_t columns() const { return kWhole ? kColumns : active; }

  /// Returns the edge's one of a pair of values, or both where the edges share a register.
  static SIMDBEZIER_INLINE V on_edges(const T* pair, std::size_t edge) {
    if constexpr (kShared) {
      return RowGroups<2, V>::spread(pair);
    }
    return broadcast<V>(pair[edge]);
  }
  static SIMDBEZIER_INLINE void edge_powers(const Component<T>& c, std::size_t edge, V k[kOrder]) {
    if constexpr (!kShared) {
      return edge_cubic(c, edge, k);
    }
    for (std::size_t i = 0; i < kOrder; ++i) {
      k[i] = on_edges(c.edge + i * kEdges + detail::kEdgeV0, edge);
    }
  }
  /// Turns values of the edges' cubics into positions: the origin is added, and corners are as
  /// stored.
  SIMDBEZIER_INLINE V finish(const Component<T>& c, std::size_t edge, V value) const {
    if (c.origins != nullptr) [[unlikely]] {
      value = value + on_edges(c.origin() + detail::kEdgeOriginsAt + detail::kEdgeV0, edge);
    }
    if constexpr (kShared) {
      return corners.replace(value, c.corner);
    } else {
      return column.replace(value, c.corner + detail::corner_index(0, edge));
    }
  }
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
