// Watertight grids of sets without origins whose samples are records: triples of each group, or one
// vertex of all.
//
// A register of samples is computed with all its components, put together in registers and stored
// where it belongs. Planes in staging and a drain would take longer than the shuffles do.
//
// Rows are at least one register long. A rest of one column is computed before the rows, several
// rows in a register, and moved to the rows' ends as they are stored. For a longer rest a last
// register begins within the one before it: what both hold is stored twice.
#pragma once

#include "kernels/fast/record_samples.hpp"
#include "kernels/grid/prefetch.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether kernels put records together.
template <typename V>
inline constexpr bool kPutsRecords = !kIsScalar<V> && kNonuples;

/// So many rows have normals that wait for their length.
constexpr std::size_t kWaitingRows = 20;

/// Whether positions of rows that are mirror images of each other are computed together. With
/// registers as long as a line this pays where rows are whole registers and results stay in the
/// caches. With six or nine values a sample, two rows do not fit into the registers.
template <typename V>
SIMDBEZIER_PART bool pairs_records(const GridTask<ScalarOf<V>>& task) {
  return !kLineWide<V> || (task.nu % kLanes<V> == 0 && !task.streaming);
}
/// Rows are paired if at least so many lie between the edges.
constexpr std::size_t kLeastPaired = 6;

/// The rows of a register of columns of one patch, and behind them `column` unless it is null.
template <detail::OutputSet kOutputs, typename V>
struct RecordRows {
  using T = ScalarOf<V>;
  using Sweep = RecordSweep<kOutputs, ColumnTile<1, true, false, V>>;
  using RecordValues = typename Sweep::RecordValues;
  using Column = RecordColumn<kOutputs, V>;
  /// These are p, n and |n|^2 of each row.
  using Waiting = T[kWaitingRows][7][kLanes<V>];

  /// What changes from row to row, and what goes with it: in variables of loops of their own, since
  /// stores through vector types might change anything that others can see.
  struct Cursor {
    std::size_t next_edge; ///< no row before it is on an edge
    std::size_t trail;
    const T* next_y; ///< of the next row that is on no edge
    const Column* column;
    RecordPlaces<kOutputs, T> places;
  };

  const Sweep sweep;
  const GridTask<T>& shared_task;
  const RowPiece<T>& piece;
  std::size_t patch;
  std::size_t at;    ///< first sample
  std::size_t lead;  ///< row on an edge; no row where there is none
  std::size_t trail; ///< likewise

  SIMDBEZIER_PART RecordRows(const GridTask<T>& task, const GridTask<T>& the_shared_task,
                             const RowPiece<T>& the_piece,
                             const ColumnTile<1, true, false, V>& tile, std::size_t the_patch,
                             std::size_t first)
      : sweep(task, tile, the_patch), shared_task(the_shared_task), piece(the_piece),
        patch(the_patch), at(first), lead(piece.lead ? 0 : ~std::size_t(0)),
        trail(piece.trail ? piece.rows() - 1 : ~std::size_t(0)) {}

  [[nodiscard]] SIMDBEZIER_PART Cursor start(const GridTask<T>& task, const Column* column) const {
    return {lead == 0 ? lead : trail,
            trail,
            piece.middle.y,
            column,
            {task, at, sweep.tile.first, piece.first}};
  }

  /// Returns the edge v = const that a row is on, or kEdges, no edge's number, if it is on none.
  [[nodiscard]] SIMDBEZIER_PART std::size_t edge(std::size_t row) const {
    return row == lead    ? edge_of(piece.lead_kind)
           : row == trail ? edge_of(piece.trail_kind)
                          : kEdges;
  }
  /// Numbers a row that is on no edge among such rows alone, as piece.middle.y and Column do.
  [[nodiscard]] SIMDBEZIER_PART std::size_t middle(std::size_t row) const {
    return row - (piece.lead ? 1 : 0);
  }
  SIMDBEZIER_PART V compute_edge(std::size_t row, RecordValues& s) const {
    sweep.edge(edge(row), s);
    s.assign();
    return sweep.tile.edge_y(edge(row));
  }
  SIMDBEZIER_PART V compute_middle(const T* y, RecordValues& s) const {
    const auto point = RowPowers<T>::template point<1, V>(y);
    sweep.interior(point, s);
    s.assign();
    return point.y;
  }
  SIMDBEZIER_PART void compute_next(Cursor& next, std::size_t row, RecordValues& s) const {
    if (row == next.next_edge) [[unlikely]] {
      next.next_edge = next.trail;
      compute_edge(row, s);
    } else {
      compute_middle(next.next_y++, s);
    }
  }

  SIMDBEZIER_PART void end_row(Cursor& next, std::size_t row) const {
    if (next.column != nullptr) {
      const std::size_t e = edge(row);
      next.column->move_to(next.places, 0,
                           e < kEdges ? Column::edge(e) : Column::middle(middle(row)));
    }
    next.places.next_row();
  }

  SIMDBEZIER_PART void put(Cursor next) const {
    const std::size_t rows = piece.rows();
    for (std::size_t row = 0; row < rows; ++row) {
      RecordValues s;
      compute_next(next, row, s);
      next.places.store(s.value, 0);
      end_row(next, row);
    }
  }

  /// This is put(), but rows that are mirror images of each other are computed together.
  SIMDBEZIER_PART void put_pairs(const RecordPlaces<kOutputs, T>& places,
                                 const Column* column) const {
    const auto store = [&](auto& s, RowPlace place, std::size_t row) SIMDBEZIER_INLINE_LAMBDA {
      s.assign();
      places.store(s.value, place.at);
      if (column != nullptr) {
        column->move_to(places, place.at, row);
      }
    };
    for_rows<RowOrder{1, RowPairs::always, 1}>(
        piece, 0, places.step,
        [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
          RecordValues s;
          sweep.edge(edge_of(kind), s);
          store(s, place, Column::edge(edge_of(kind)));
        },
        [&](const T* y, RowPlace place, RowPlace mirror) SIMDBEZIER_INLINE_LAMBDA {
          RecordValues s;
          RecordValues mirrored;
          sweep.pair(RowPowers<T>::template point<1, V>(y), s, mirrored);
          store(s, place, Column::middle(middle(place.row)));
          store(mirrored, mirror, Column::middle(middle(mirror.row)));
        },
        [&](const T* y, RowPlace place, std::size_t /*rows*/) SIMDBEZIER_INLINE_LAMBDA {
          RecordValues s;
          sweep.interior(RowPowers<T>::template point<1, V>(y), s);
          store(s, place, Column::middle(middle(place.row)));
        });
  }

  /// Puts rows with normals, in two passes. Root and division take as long as all else, and
  /// processors do not look far enough ahead to begin with the rows behind meanwhile.
  SIMDBEZIER_PART void put_normals(Cursor next) const {
    alignas(64) Waiting waiting;
    const std::size_t rows = piece.rows();
    // Streaming stores leave slowly, and all the time.
    const std::size_t most = next.places.streaming ? 2 : kWaitingRows;
    const std::size_t parts = (rows + most - 1) / most;
    const std::size_t part = (rows + parts - 1) / parts;
    T* position = next.places.to[0];
    for (std::size_t row = 0; row < rows; row += part) {
      const std::size_t last = row + part < rows ? row + part : rows;
      begin_normals(next, waiting, row, last, position);
      finish_normals(next, waiting, row, last);
    }
  }

private:
  /// position says where the next row's positions go, unless they are members of vertices.
  SIMDBEZIER_PART void begin_normals(Cursor& next, Waiting& waiting, std::size_t row,
                                     std::size_t last, T*& position) const {
    const bool vertices = next.places.record > 3;
    T(*wait)[kLanes<V>] = waiting[0];
    for (; row < last; ++row, wait += 7) {
      RecordValues s;
      compute_next(next, row, s);
      store_vector(wait[3], s.value[3]);
      store_vector(wait[4], s.value[4]);
      store_vector(wait[5], s.value[5]);
      store_vector(wait[6], s.squared);
      if (vertices) {
        store_vector(wait[0], s.value[0]);
        store_vector(wait[1], s.value[1]);
        store_vector(wait[2], s.value[2]);
      } else {
        store_triples(s.value, position, next.places.streaming);
        position += next.places.step;
      }
    }
  }

  SIMDBEZIER_PART void finish_normals(Cursor& next, const Waiting& waiting, std::size_t row,
                                      std::size_t last) const {
    const V floor =
        floor_inside(sweep.tile.column.x, broadcast<V>(shared_task.normal_floor[patch]));
    const bool outside = piece.middle.kind == RowKind::outside;
    const bool vertices = next.places.record > 3;
    const T(*wait)[kLanes<V>] = waiting[0];
    for (; row < last; ++row, wait += 7) {
      V value[6];
      value[3] = load_vector<V>(wait[3]);
      value[4] = load_vector<V>(wait[4]);
      value[5] = load_vector<V>(wait[5]);
      const V squared = load_vector<V>(wait[6]);
      normalise(value + 3, squared);
      if (vertices) {
        value[0] = load_vector<V>(wait[0]);
        value[1] = load_vector<V>(wait[1]);
        value[2] = load_vector<V>(wait[2]);
        next.places.store(value, 0);
      } else {
        store_triples(value + 3, next.places.to[1], next.places.streaming);
      }
      end_row(next, row);
      if (outside || !all_of<V>(squared > floor)) [[unlikely]] {
        look_again(row, floor, outside, next.places.record);
      }
    }
  }

  SIMDBEZIER_PART void look_again(std::size_t row, V floor, bool outside,
                                  std::size_t record) const {
    const bool on_edge = edge(row) < kEdges;
    RecordValues s;
    const V y = on_edge ? compute_edge(row, s) : compute_middle(piece.middle.y + middle(row), s);
    sweep.resolve(
        shared_task, patch,
        UncertainNormals{0, kLanes<V>, kLanes<V>, 1, at + row * shared_task.nu, 0, 1, record}, s, y,
        outside && !on_edge ? no_floor<V>() : floor);
  }
};

/// Sweeps a register of columns of consecutive patches, and the column behind it where it is the
/// only one; see sweep_tile().
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_KERNEL void sweep_records(const GridTask<T>& shared_task,
                                     const RowPiece<T>& shared_piece, std::size_t first_column,
                                     std::size_t patch, std::size_t last_patch) {
  using V = vec<T>;
  const bool extra = first_column + kLanes<V> + 1 == shared_task.nu;
  GridTask<T> task = shared_task;
  assume<Known::watertight>(task);
  RowPiece<T> piece = shared_piece;
  piece.mirrored = piece.mirrored && piece.middle.rows >= kLeastPaired;
  const ColumnTile<1, true, false, V> tile(task.x, first_column, kLanes<V>, task.watertight);
  const SingleColumnTile<V> column_tile(task.x, first_column + (extra ? kLanes<V> : 0), 1,
                                        task.watertight);
  RecordColumn<kOutputs, V> column;
  const bool prefetch = task.prefetch && first_column == 0;
  for (; patch < last_patch; ++patch) {
    if (prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * task.nu + first_column;
    if (extra) {
      column.sweep(shared_task, shared_piece, column_tile, patch, at + kLanes<V>);
    }
    const RecordRows<kOutputs, V> rows(task, shared_task, piece, tile, patch, at);
    const auto start = rows.start(task, extra ? &column : nullptr);
    if constexpr (RecordGroups<kOutputs>::kNormals) {
      rows.put_normals(start);
    } else if constexpr (kOutputs == detail::kPosition) {
      if (pairs_records<V>(task)) {
        rows.put_pairs({task, at, first_column, piece.first}, extra ? &column : nullptr);
      } else {
        rows.put(start);
      }
    } else {
      rows.put(start);
    }
  }
}

/// Sweeps all columns of patches [patch, end), at least a register of them.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void sweep_record_tiles(const GridTask<T>& task, const RowPiece<T>& piece,
                                        std::size_t patch, std::size_t end) {
  constexpr std::size_t kL = kLanes<vec<T>>;
  for (std::size_t first = 0; first + 1 < task.nu; first += kL) {
    const std::size_t last = task.nu - kL;
    sweep_records<kOutputs>(task, piece, first < last ? first : last, patch, end);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
