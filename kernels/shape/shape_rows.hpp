// Grids on patches of any shape: lanes = columns, swept along v.
#pragma once

#include "kernels/drain/drain_kernel.hpp"
#include "kernels/shape/cell_rows.hpp"
#include "kernels/shape/shape_columns.hpp"
#include "kernels/shape/shape_outputs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Positions on rows of a cell, from the polynomials of a register of columns.
template <typename P, typename V>
class PositionRows {
  using T = ScalarOf<V>;

public:
  SIMDBEZIER_PART PositionRows(const GridTask<T>& task, const ShapeColumns<P, V>& columns,
                               std::size_t at, std::size_t active)
      : columns_(columns), planes_(task.out[output_index(Output::position)]), at_(at),
        active_(active) {}

  /// Puts kCount rows at once, whose parameters serve all components. What goes beyond them is the
  /// last one again.
  template <std::size_t kCount>
  SIMDBEZIER_INLINE void put(const CellRows<T>& rows) const {
    for (std::size_t r = 0; r < rows.count; r += kCount) {
      const ShapeRow<T>* const row = own_address(rows.row + r);
      V y[kCount];
      repeat<kCount>([&](std::size_t i)
                         SIMDBEZIER_INLINE_LAMBDA { y[i] = broadcast<V>(row[i].local); });
      columns_.slots().for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
        V values[kCount];
        evaluate<kCount>(own_address(columns_.polynomials().power[slot][0]), y, values);
        if (columns_.origins() != nullptr) [[unlikely]] {
          repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
            values[i] = values[i] + columns_.origins()->position[slot];
          });
        }
        store<kCount>(planes_.component[slot] + at_, row, values);
      });
    }
  }

  /// Puts the positions of one row.
  SIMDBEZIER_PART void put(const ShapeRow<T>& row, const V* position) const {
    columns_.slots().for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      store<1>(planes_.component[slot] + at_, &row, position + slot);
    });
  }

  /// So many rows go at once where rows take even and odd parts.
  static constexpr std::size_t kEvenOddRows = 4;

private:
  template <std::size_t kCount>
  SIMDBEZIER_INLINE void evaluate(const V* power, const V* y, V* values) const {
    const typename P::OrderV order = columns_.order_v();
    if (kCount == kEvenOddRows && takes_even_odd(order.value())) {
      Series<V> s[kCount];
      even_odd_rows<0, kCount>(
          order, y, [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return power[k]; }, s);
      repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA { values[i] = s[i].value; });
    } else {
      horner_values<kCount>(order.value(), y, power, values);
    }
  }

  template <std::size_t kCount>
  SIMDBEZIER_INLINE void store(T* plane, const ShapeRow<T>* row, const V* values) const {
    if (active_ == kLanes<V>) {
      repeat<kCount>([&](std::size_t i)
                         SIMDBEZIER_INLINE_LAMBDA { store_vector(plane + row[i].at, values[i]); });
    } else {
      repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
        store_first(plane + row[i].at, values[i], active_);
      });
    }
  }

  const ShapeColumns<P, V>& columns_;
  const detail::Planes<T>& planes_;
  std::size_t at_;     ///< the columns' first sample in a row at 0
  std::size_t active_; ///< lanes that are columns
};

/// A register of columns of one patch, through all rows, a few at a time. One function for each
/// step: loops over unknown numbers of powers have them in memory anyway.
template <typename P, typename T>
class ColumnSweep {
  using V = vec<T>;
  using Columns = ShapeColumns<P, V>;
  using Edges = typename Columns::Edges;

public:
  SIMDBEZIER_PART ColumnSweep(const GridTask<T>& task, const NetShape& shape,
                              const CellRow<T>* cells, std::size_t patch, std::size_t first)
      : task_(task), cells_(cells),
        x_(load_vector<V>(task.x + first), shape.cells_u(), task.watertight),
        columns_(shape, x_, task.first_component),
        edges_(shape, x_, load_vector<V>(task.x + first), task.watertight, task.first_component,
               cells[0]),
        first_at_(patch * task.patch_step + first) {
    const std::size_t left = task.nu - first;
    range_.patch = patch;
    range_.active = left < kLanes<V> ? left : kLanes<V>;
    range_.x = load_vector<V>(task.x + first);
    if constexpr (!kPositions) {
      range_.first_plane = 0;
      floor_ = floor_inside(range_.x, patch_floor<P, V>(task, patch));
    }
  }

  SIMDBEZIER_PART void run(const NetShape& shape, const RowsByCell<T>& rows) {
    for (std::size_t cell = 0; cell < shape.cells_v(); ++cell) {
      const CellRows<T>& of_cell = rows.of_cell(cell);
      edges_.enter(cells_[cell]);
      if (of_cell.count > 0) {
        build_columns(columns_, cells_[cell], edges_, origins_);
        if constexpr (kPositions) {
          put_positions(of_cell);
        } else {
          put_samples(of_cell);
        }
      }
      if constexpr (kPositions) {
        put_edges(of_cell);
      }
    }
  }

  /// Whether these are positions that are not divided by weights: on an edge v = const nothing
  /// comes from the columns then.
  static constexpr bool kPositions = P::kDepth == 0 && !P::kWeighted;

private:
  /// Rows that are evaluated together, as many as hide the latency of Horner's rule; fewer where
  /// sums of second derivatives fill the registers.
  static constexpr std::size_t kRows = sizeof(V) == 64 ? (P::kDepth < 2 ? 4 : 2) : 4 >> P::kDepth;

  SIMDBEZIER_PART void put_positions(const CellRows<T>& rows) {
    using Rows = PositionRows<P, V>;
    static_assert(kRowGroup == 8 && Rows::kEvenOddRows == 4);
    const bool even_odd = takes_even_odd(columns_.order_v().value());
    const std::size_t together = even_odd ? Rows::kEvenOddRows : rows.together;
    const Rows to(task_, columns_, first_at_, range_.active);
    with_one_of<4, 5, 6, 7, 8>(together, [&]<std::size_t kCount>() SIMDBEZIER_INLINE_LAMBDA {
      to.template put<kCount>(rows);
    });
  }

  SIMDBEZIER_PART void put_edges(const CellRows<T>& rows) {
    const PositionRows<P, V> to(task_, columns_, first_at_, range_.active);
    for (std::size_t k = 0; k < rows.edges; ++k) {
      const ShapeRow<T>& row = rows.edge_row(k);
      SampleJet<V> jet;
      if (!edges_.find_positions(row.edge, jet.position)) {
        edges_.replace_row(row.edge, jet);
      }
      to.put(row, jet.position);
    }
  }

  SIMDBEZIER_KERNEL void put_samples(const CellRows<T>& rows) {
    SampleJet<V> jet[kTogether];
    SampleRange<V> range[kTogether]; // one by one, since compilers call memmove() for whole ones
    for (SampleRange<V>& each : range) {
      each.patch = range_.patch;
      each.active = range_.active;
      each.first_plane = 0;
      each.x = range_.x;
    }
    static_assert(kTogether <= kRowGroup && kTogether % kRows == 0);
    for (std::size_t r = 0; r < rows.count; r += kTogether) {
      const ShapeRow<T>* const row = rows.row + r;
      const std::size_t count = rows.count - r < kTogether ? rows.count - r : kTogether;
      for (std::size_t k = 0; k < count; k += kRows) {
        V local[kRows];
        repeat<kRows>([&](std::size_t i)
                          SIMDBEZIER_INLINE_LAMBDA { local[i] = broadcast<V>(row[k + i].local); });
        const Columns* columns = &columns_;
        if constexpr (P::kDepth > 1) { // else g++ copies all polynomials to the stack first
          columns = own_address(columns);
        }
        columns->template evaluate<kRows>(local, jet + k);
      }
      for (std::size_t k = 0; k < count; ++k) {
        if (row[k].edge < kEdges) {
          edges_.replace_row(row[k].edge, jet[k]);
        }
        range[k].at = first_at_ + row[k].at;
        range[k].y = broadcast<V>(row[k].y);
        range[k].floor = row[k].outside ? no_floor<V>() : floor_;
      }
      store_jets<ShapePlan<P::kDepth, P::kWeighted, 0, 0, 0>>(task_, range, jet, count);
    }
  }

  const GridTask<T>& task_;
  const CellRow<T>* cells_; ///< of the patch, row by row
  CellColumns<V> x_;
  Columns columns_;
  Edges edges_;
  ColumnOrigins<V> origins_;
  SampleRange<V> range_;
  V floor_; ///< of rows that are not outside
  std::size_t first_at_;
};

/// Returns the first column of the register that is to hold column `next`. The last register of a
/// row ends with it and overlaps the one before, since a part of a register takes several stores.
/// That does not pay for a single column, nor where the register would then have columns of both
/// cells, nor where registers are lines, which have masks.
template <typename V>
SIMDBEZIER_PART std::size_t register_start(std::size_t next, std::size_t nu, std::size_t cells) {
  const bool overlaps = !kLineWide<V> && nu >= cells * kLanes<V> && nu - next > 1;
  return overlaps ? std::min(next, nu - kLanes<V>) : next;
}

template <typename P, typename T>
SIMDBEZIER_KERNEL void sweep_shape(const GridTask<T>& shared_task) {
  const GridTask<T> task = shared_task;
  const NetShape shape = P::shape(*shared_task.shape);
  RowsByCell<T> rows(task, shape.cells_v(), ColumnSweep<P, T>::kPositions);
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    const CellRow<T> cells[2] = {{task, shape, patch, 0},
                                 {task, shape, patch, shape.cells_v() - 1}};
    for (std::size_t row = 0; row < rows.rows(); row += CellRows<T>::kMost) {
      if (patch == 0 || rows.rows() > CellRows<T>::kMost) {
        rows.take(task, row);
      }
      for (std::size_t next = 0; next < task.nu; next += kLanes<vec<T>>) {
        const std::size_t first = register_start<vec<T>>(next, task.nu, shape.cells_u());
        ColumnSweep<P, T>(task, shape, cells, patch, first).run(shape, rows);
      }
    }
    drain_some(task.drain, task.patch_step * 3);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
