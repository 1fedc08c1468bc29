// Grids on patches of any shape: lanes = columns, swept along v.
#pragma once

#include "kernels/drain_kernel.hpp"
#include "kernels/shape_outputs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridTask;
using detail::RowKind;
using detail::RowRun;

/// A register of columns of one patch, through all rows.
template <typename P, typename T>
class ColumnSweep {
  using V = vec<T>;

public:
  SIMDBEZIER_INLINE ColumnSweep(const GridTask<T>& task, const NetShape& shape, std::size_t patch,
                                std::size_t first, bool watertight)
      : task_(task), watertight_(watertight), cells_v_(P::shape(shape).cells_v()),
        x_(load_vector<V>(task.x + first)), columns_(x_, P::shape(shape).cells_u()),
        polynomials_(shape, columns_, task.first_component, watertight) {
    range_.patch = patch;
    range_.active = task.nu - first < kLanes<V> ? task.nu - first : kLanes<V>;
    range_.x = x_;
    first_at_ = patch * task.patch_step + first;
    for (std::size_t cell = 0; cell < cells_v_; ++cell) {
      const CellRow<T> cells(task, shape, patch, cell);
      polynomials_.build(cells);
      sweep(cell);
    }
  }

private:
  SIMDBEZIER_INLINE void sweep(std::size_t cell) {
    range_.at = first_at_;
    for (std::size_t r = 0; r < task_.run_count; ++r) {
      const RowRun<T> run = task_.runs[r];
      if (cells_v_ == 2) {
        sweep_half(run, cell);
      } else if (watertight_ && (run.kind == RowKind::edge_v0 || run.kind == RowKind::edge_v1)) {
        for (std::size_t j = 0; j < run.rows; ++j, range_.at += task_.nu) {
          put_edge(run.y[j], run.y[j]);
        }
      } else {
        for (std::size_t j = 0; j < run.rows; ++j, range_.at += task_.nu) {
          put(run.y[j], run.y[j]);
        }
      }
    }
  }

  /// The rows of a run that lie in one of two cells.
  SIMDBEZIER_INLINE void sweep_half(const RowRun<T>& run, std::size_t cell) {
    for (std::size_t j = 0; j < run.rows; ++j, range_.at += task_.nu) {
      const bool low = run.y[j] < T(0);
      if (low != (cell == 0)) {
        continue;
      }
      const T y = cell_parameter(run.y[j]);
      if (watertight_ && (y == T(-0.5) || y == T(0.5))) {
        put_edge(run.y[j], y);
      } else {
        put(run.y[j], y);
      }
    }
  }

  SIMDBEZIER_INLINE void put(T y, T local) {
    SampleJet<V> jet;
    polynomials_.evaluate(broadcast<V>(local), jet);
    range_.y = broadcast<V>(y);
    store_sample<P>(task_, range_, jet);
  }
  /// Rare, and with values in memory that others keep in registers.
  SIMDBEZIER_INLINE void put_edge(T y, T local) {
    SampleJet<V> jet;
    if constexpr (P::kDepth > 0) {
      polynomials_.evaluate(broadcast<V>(local), jet);
    }
    polynomials_.replace_row(local < T(0) ? detail::kEdgeV0 : detail::kEdgeV1, jet);
    range_.y = broadcast<V>(y);
    store_sample<P>(task_, range_, jet);
  }

  const GridTask<T>& task_;
  bool watertight_;
  std::size_t cells_v_; ///< a constant where the degree is
  V x_;
  CellColumns<V> columns_;
  ShapeColumns<P, V> polynomials_;
  SampleRange<V> range_;
  std::size_t first_at_;
};

template <typename P, typename T>
__attribute__((noinline)) void sweep_shape(const GridTask<T>& shared_task, bool watertight) {
  // Copies, because stores through vector types might change anything that others can see.
  const GridTask<T> task = shared_task;
  const NetShape shape = P::shape(*shared_task.shape);
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    for (std::size_t first = 0; first < task.nu; first += kLanes<vec<T>>) {
      const ColumnSweep<P, T> sweep(task, shape, patch, first, watertight);
    }
    pace(task.drain, task.patch_step * 3);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
