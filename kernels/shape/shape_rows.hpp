// Grids on patches of any shape: lanes = columns, swept along v.
#pragma once

#include "kernels/drain/drain_kernel.hpp"
#include "kernels/shape/shape_columns.hpp"
#include "kernels/shape/shape_outputs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridTask;
using detail::RowKind;
using detail::RowRun;

/// A register of columns of one patch, through all rows, a few at a time. One function for each
/// step: loops over unknown numbers of powers have them in memory anyway.
template <typename P, typename T>
class ColumnSweep {
  using V = vec<T>;
  using Columns = ShapeColumns<P, V>;

public:
  SIMDBEZIER_PART ColumnSweep(const GridTask<T>& task, const NetShape& shape, std::size_t patch,
                              std::size_t first)
      : task_(task), x_(load_vector<V>(task.x + first), shape.cells_u(), task.watertight),
        columns_(shape, x_, task.first_component) {
    const std::size_t left = task.nu - first;
    range_.patch = patch;
    range_.active = left < kLanes<V> ? left : kLanes<V>;
    range_.first_plane = 0;
    range_.x = load_vector<V>(task.x + first);
    floor_ = floor_inside(range_.x, patch_floor<P, V>(task, patch));
    first_at_ = patch * task.patch_step + first;
  }

  void run(const NetShape& shape) {
    const std::size_t cells = shape.cells_v();
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const CellRow<T> row(task_, shape, range_.patch, cell);
      const typename Columns::Edges edges(shape, x_, range_.x, task_.watertight,
                                          task_.first_component, row);
      build_columns(columns_, row, edges, origins_);
      std::size_t at = first_at_;
      for (std::size_t r = 0; r < task_.run_count; ++r) {
        const RowRun<T> run = task_.runs[r];
        for (std::size_t j = 0; j < run.rows; ++j, at += task_.nu) {
          const T y = run.y[j];
          if (cells == 1 || (y < T(0)) == (cell == 0)) {
            add({y, cells == 1 ? y : cell_parameter(y), at, run.kind == RowKind::outside}, edges);
          }
        }
      }
      put_waiting(edges);
    }
  }

private:
  struct Row {
    T y;
    T local; ///< y in its cell
    std::size_t at;
    bool outside;
  };
  /// Rows that are evaluated together, as many as hide the latency of Horner's rule; fewer where
  /// sums of second derivatives fill the registers.
  static constexpr std::size_t kRows = sizeof(V) == 64 ? (P::kDepth < 2 ? 4 : 2) : 4 >> P::kDepth;

  SIMDBEZIER_PART void add(const Row& row, const typename Columns::Edges& edges) {
    if (P::kDepth == 0 && edge_of(row) < kEdges) { // nothing there comes from the columns
      SampleJet<V> jet;
      put(row, edges, jet);
      return;
    }
    rows_[waiting_++] = row;
    if (waiting_ == kRows) {
      put_waiting(edges);
    }
  }

  /// What is evaluated beyond the rows that wait is rows before, which are not stored again.
  SIMDBEZIER_KERNEL void put_waiting(const typename Columns::Edges& edges) {
    V local[kRows];
    repeat<kRows>([&](std::size_t r)
                      SIMDBEZIER_INLINE_LAMBDA { local[r] = broadcast<V>(rows_[r].local); });
    SampleJet<V> jet[kRows];
    columns_.template evaluate<kRows>(local, jet);
    for (std::size_t r = 0; r < waiting_; ++r) {
      put(rows_[r], edges, jet[r]);
    }
    waiting_ = 0;
  }

  SIMDBEZIER_PART void put(const Row& row, const typename Columns::Edges& edges,
                           SampleJet<V>& jet) {
    if (const std::size_t edge = edge_of(row); edge < kEdges) {
      edges.replace_row(edge, jet);
    }
    range_.at = row.at;
    range_.y = broadcast<V>(row.y);
    range_.floor = row.outside ? no_floor<V>() : floor_;
    if constexpr (P::kDepth == 0) { // little else is done
      store_sample<P>(task_, range_, jet);
    } else {
      store_shared<P>(task_, range_, jet);
    }
  }
  SIMDBEZIER_PART std::size_t edge_of(const Row& row) const {
    return task_.watertight ? edge_of_cell(row.local) : kEdges;
  }

  const GridTask<T>& task_;
  CellColumns<V> x_;
  Columns columns_;
  ColumnOrigins<V> origins_;
  SampleRange<V> range_;
  V floor_; ///< of rows that are not outside
  std::size_t first_at_;
  Row rows_[kRows] = {};
  std::size_t waiting_ = 0;
};

template <typename P, typename T>
SIMDBEZIER_KERNEL void sweep_shape(const GridTask<T>& shared_task) {
  // Copies, because stores through vector types might change anything that others can see.
  const GridTask<T> task = shared_task;
  const NetShape shape = P::shape(*shared_task.shape);
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    for (std::size_t first = 0; first < task.nu; first += kLanes<vec<T>>) {
      ColumnSweep<P, T>(task, shape, patch, first).run(shape);
    }
    drain_some(task.drain, task.patch_step * 3);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
