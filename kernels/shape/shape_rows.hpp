// Grids on patches of any shape: lanes = columns, swept along v.
#pragma once

#include "kernels/drain/drain_kernel.hpp"
#include "kernels/shape/cell_rows.hpp"
#include "kernels/shape/shape_columns.hpp"
#include "kernels/shape/shape_outputs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridTask;
using detail::RowKind;
using detail::RowRun;

/// One component's positions on rows of a cell, from the polynomials of its columns.
template <typename P, typename V>
struct PositionRows {
  using T = ScalarOf<V>;
  typename P::OrderV order;
  const V* power;
  const V* origin; ///< null where there is none
  T* plane;
  std::size_t active; ///< lanes that are columns

  /// Puts kCount rows at once. What goes beyond them is the last one again.
  template <std::size_t kCount>
  SIMDBEZIER_PART void put(const CellRows<T>& rows) const {
    for (std::size_t r = 0; r < rows.count; r += kCount) {
      const ShapeRow<T>* const row = own_address(rows.row + r);
      V y[kCount];
      Series<V> s[kCount];
      repeat<kCount>([&](std::size_t i)
                         SIMDBEZIER_INLINE_LAMBDA { y[i] = broadcast<V>(row[i].local); });
      const auto coefficients = [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return power[k]; };
      if constexpr (kCount == kEvenOddRows) {
        rows_series<0, kCount>(order, y, coefficients, s);
      } else {
        horner_rows<0, kCount>(order, y, coefficients, s);
      }
      repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
        if (origin != nullptr) [[unlikely]] {
          s[i].value = s[i].value + *origin;
        }
      });
      if (active == kLanes<V>) {
        repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
          store_vector(plane + row[i].at, s[i].value);
        });
      } else {
        repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
          store_first(plane + row[i].at, s[i].value, active);
        });
      }
    }
  }

  /// So many rows go at once where rows take even and odd parts.
  static constexpr std::size_t kEvenOddRows = 4;
};

/// A register of columns of one patch, through all rows, a few at a time. One function for each
/// step: loops over unknown numbers of powers have them in memory anyway.
template <typename P, typename T>
class ColumnSweep {
  using V = vec<T>;
  using Columns = ShapeColumns<P, V>;
  using Edges = typename Columns::Edges;

public:
  SIMDBEZIER_PART ColumnSweep(const GridTask<T>& task, const NetShape& shape, std::size_t patch,
                              std::size_t first)
      : task_(task), x_(load_vector<V>(task.x + first), shape.cells_u(), task.watertight),
        columns_(shape, x_, task.first_component), first_at_(patch * task.patch_step + first) {
    const std::size_t left = task.nu - first;
    range_.patch = patch;
    range_.active = left < kLanes<V> ? left : kLanes<V>;
    range_.first_plane = 0;
    range_.x = load_vector<V>(task.x + first);
    floor_ = floor_inside(range_.x, patch_floor<P, V>(task, patch));
  }

  SIMDBEZIER_PART void run(const NetShape& shape, const RowsByCell<T>& rows) {
    for (std::size_t cell = 0; cell < shape.cells_v(); ++cell) {
      const CellRows<T>& of_cell = rows.of_cell(cell);
      const CellRow<T> row(task_, shape, range_.patch, cell);
      const Edges edges(shape, x_, range_.x, task_.watertight, task_.first_component, row);
      if (of_cell.count > 0) {
        build_columns(columns_, row, edges, origins_);
        if constexpr (kPositions) {
          put_positions(of_cell);
        } else {
          put_samples(edges, of_cell);
        }
      }
      if constexpr (kPositions) {
        put_edges(edges, of_cell);
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

  SIMDBEZIER_KERNEL void put_positions(const CellRows<T>& rows) {
    using Rows = PositionRows<P, V>;
    static_assert(kRowGroup == 8 && Rows::kEvenOddRows == 4);
    const bool even_odd = takes_even_odd(columns_.order_v().value());
    const std::size_t together = even_odd ? Rows::kEvenOddRows : rows.together;
    with_one_of<4, 5, 6, 7, 8>(together, [&]<std::size_t kCount>() SIMDBEZIER_INLINE_LAMBDA {
      const ColumnOrigins<V>* const origins = columns_.origins();
      columns_.slots().for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
        T* const plane = task_.out[output_index(Output::position)].component[slot] + first_at_;
        const V* const origin = origins == nullptr ? nullptr : &origins->position[slot];
        const V* const power = own_address(columns_.polynomials().power[slot][0]);
        Rows{columns_.order_v(), power, origin, plane, range_.active}.template put<kCount>(rows);
      });
    });
  }

  SIMDBEZIER_KERNEL void put_edges(const Edges& edges, const CellRows<T>& rows) {
    for (std::size_t k = 0; k < rows.edges; ++k) {
      const ShapeRow<T>& row = rows.edge_row(k);
      SampleJet<V> jet;
      if (!edges.find_positions(row.edge, jet.position)) {
        edges.replace_row(row.edge, jet);
      }
      range_.at = first_at_ + row.at;
      store_sample<P>(task_, range_, jet);
    }
  }

  SIMDBEZIER_KERNEL void put_samples(const Edges& edges, const CellRows<T>& rows) {
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
        columns_.template evaluate<kRows>(local, jet + k);
      }
      for (std::size_t k = 0; k < count; ++k) {
        if (row[k].edge < kEdges) {
          edges.replace_row(row[k].edge, jet[k]);
        }
        range[k].at = first_at_ + row[k].at;
        range[k].y = broadcast<V>(row[k].y);
        range[k].floor = row[k].outside ? no_floor<V>() : floor_;
      }
      store_jets<ShapePlan<P::kDepth, P::kWeighted, 0, 0, 0>>(task_, range, jet, count);
    }
  }

  const GridTask<T>& task_;
  CellColumns<V> x_;
  Columns columns_;
  ColumnOrigins<V> origins_;
  SampleRange<V> range_;
  V floor_; ///< of rows that are not outside
  std::size_t first_at_;
};

template <typename P, typename T>
SIMDBEZIER_KERNEL void sweep_shape(const GridTask<T>& shared_task) {
  // Copies, because stores through vector types might change anything that others can see.
  const GridTask<T> task = shared_task;
  const NetShape shape = P::shape(*shared_task.shape);
  RowsByCell<T> rows(task, shape.cells_v(), ColumnSweep<P, T>::kPositions);
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    for (std::size_t row = 0; row < rows.rows(); row += CellRows<T>::kMost) {
      if (patch == 0 || rows.rows() > CellRows<T>::kMost) {
        rows.take(task, row);
      }
      for (std::size_t first = 0; first < task.nu; first += kLanes<vec<T>>) {
        ColumnSweep<P, T>(task, shape, patch, first).run(shape, rows);
      }
    }
    drain_some(task.drain, task.patch_step * 3);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
