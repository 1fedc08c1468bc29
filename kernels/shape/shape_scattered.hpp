// Scattered samples on patches of any shape: lanes = consecutive samples of one patch.
#pragma once

#include <cstdint>

#include "kernels/poly/half_centred.hpp"
#include "kernels/shape/shape_outputs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The lanes of `yes` keep what `jet` has, the others get what `other` has.
template <typename P, typename V>
SIMDBEZIER_PART void keep_lanes(MaskOf<V> yes, const SampleJet<V>& other, SampleJet<V>& jet) {
  const auto keep = [&](V(&to)[3], const V(&from)[3]) SIMDBEZIER_INLINE_LAMBDA {
    for (std::size_t c = 0; c < 3; ++c) {
      to[c] = select_where<V>(yes, to[c], from[c]);
    }
  };
  keep(jet.position, other.position);
  if constexpr (P::kDepth > 0) {
    keep(jet.du, other.du);
    keep(jet.dv, other.dv);
  }
  if constexpr (P::kWeighted && P::kDepth > 0) {
    jet.inverse_weight = select_where<V>(yes, jet.inverse_weight, other.inverse_weight);
  }
  if constexpr (P::kDepth > 1) {
    keep(jet.duu, other.duu);
    keep(jet.duv, other.duv);
    keep(jet.dvv, other.dvv);
  }
}

/// Evaluates samples of one patch in one row of cells, at the local y and at x, of which `columns`
/// are made. edge is the edge v = const of the cells that all of them are on, or kEdges where it is
/// none. It is out of line because it is large and has several callers.
template <typename P, typename V>
SIMDBEZIER_KERNEL void evaluate_row(const ScatteredTask<ScalarOf<V>>& task, const NetShape& shape,
                                    std::size_t patch, std::size_t cell,
                                    const CellColumns<V>& columns, V x, V y, std::size_t edge,
                                    SampleJet<V>& jet) {
  using T = ScalarOf<V>;
  const CellRow<T> cells(task, shape, patch, cell);
  const typename ShapeColumns<P, V>::Edges edges(shape, columns, x, task.watertight,
                                                 task.first_component, cells);
  ShapeColumns<P, V> polynomials(shape, columns, task.first_component);
  ColumnOrigins<V> origins;
  build_columns(polynomials, cells, edges, origins);
  polynomials.template evaluate<1>(&y, &jet);
  if (edge < kEdges) [[unlikely]] {
    edges.replace_row(edge, jet);
  }
}

/// Evaluates samples of one patch at half-centred x, y. edge is as for evaluate_row(), for samples
/// that are all the same one.
template <typename P, typename V>
SIMDBEZIER_PART void evaluate_lanes(const ScatteredTask<ScalarOf<V>>& task, const NetShape& shape,
                                    std::size_t patch, V x, V y, std::size_t edge,
                                    SampleJet<V>& jet) {
  const CellColumns<V> columns(x, shape.cells_u(), task.watertight);
  const CellColumns<V> rows(y, shape.cells_v(), task.watertight);
  const bool both = rows.any_low && rows.any_high;
  evaluate_row<P>(task, shape, patch, rows.any_low ? 0 : 1, columns, x, rows.local.x, edge, jet);
  if (both) {
    SampleJet<V> high;
    evaluate_row<P>(task, shape, patch, 1, columns, x, rows.local.x, edge, high);
    keep_lanes<P>(rows.low, high, jet);
  }
}

/// Returns what the normals of scattered samples are tested with.
template <typename P, typename V>
SIMDBEZIER_PART V sample_floor(const ScatteredTask<ScalarOf<V>>& task,
                               const SampleRange<V>& range) {
  const V floor = patch_floor<P, V>(task, range.patch);
  return floor_inside(range.y, floor_inside(range.x, floor));
}

/// Evaluates samples [k, k + count) of one patch, at most a register of them; further lanes repeat
/// the last. Returns those that need a call of their own: samples on an edge v = const of their
/// cell, and samples that are not finite. alone says that this is that call, and count is 1. A
/// register has one formula, which is that of samples off these edges unless it is called for a
/// sample alone.
template <typename P, typename T>
SIMDBEZIER_KERNEL std::uint32_t evaluate_together(const ScatteredTask<T>& task,
                                                  const NetShape& shape, std::size_t k,
                                                  std::size_t count, bool alone) {
  using V = vec<T>;
  alignas(64) T x[kLanes<V>];
  alignas(64) T y[kLanes<V>];
  std::uint32_t special = 0;
  std::size_t edge = kEdges;
  bool finite = true;
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = finite_half_centred(task, task.u[k + i]);
    y[i] = finite_half_centred(task, task.v[k + i]);
    edge = edge_of_cell(shape.cells_v() == 1 ? y[i] : cell_parameter(y[i]));
    finite = x[i] == x[i] && y[i] == y[i];
    special |= edge < kEdges || !finite ? std::uint32_t{1} << i : 0;
  }
  for (std::size_t i = count; i < kLanes<V>; ++i) {
    x[i] = x[count - 1];
    y[i] = y[count - 1];
  }
  SampleRange<V> range{task.patch[k], k, count, 0, load_vector<V>(x), load_vector<V>(y), {}};
  range.floor = sample_floor<P>(task, range);
  SampleJet<V> jet;
  evaluate_lanes<P, V>(task, shape, range.patch, range.x, range.y,
                       alone && task.watertight ? edge : kEdges, jet);
  if (alone && !finite && task.status != nullptr) {
    task.status[k] = SampleStatus::non_finite;
  }
  store_shared<P>(task, range, jet);
  return alone ? 0 : special;
}

/// Evaluates one sample, which nothing shares a register with: lanes are powers of Y, in a quarter
/// of the time. Returns false, and does nothing, where it is on an edge of its cell or not finite,
/// or the set has origins.
template <typename P, typename T>
SIMDBEZIER_KERNEL bool evaluate_single(const ScatteredTask<T>& task, const NetShape& shape,
                                       std::size_t k) {
  const T x = finite_half_centred(task, task.u[k]);
  const T y = finite_half_centred(task, task.v[k]);
  const CellColumns<T> column(x, shape.cells_u(), task.watertight);
  const CellColumns<T> row(y, shape.cells_v(), task.watertight);
  if (task.origins != nullptr || x != x || y != y || column.local.on_edge || row.local.on_edge) {
    return false;
  }
  const std::size_t patch = task.patch[k];
  const CellRow<T> cells(task, shape, patch, row.any_low ? 0 : 1);
  ShapeColumns<P, T> columns(shape, column, task.first_component);
  columns.build_across(column.any_low ? cells.low : cells.high);
  SampleJet<T> jet;
  columns.template evaluate<1>(&row.local.x, &jet);
  SampleRange<T> range{patch, k, 1, 0, x, y, {}};
  range.floor = sample_floor<P>(task, range);
  store_shared<P>(task, range, jet);
  return true;
}

/// Asks for the coefficients of a sample that comes soon.
template <typename T>
SIMDBEZIER_PART void prefetch_sample(const ScatteredTask<T>& task, const NetShape& shape,
                                     std::size_t k) {
  constexpr std::size_t kAhead = 8;
  if (k + kAhead < task.count) {
    const std::size_t next = k + kAhead;
    const bool high_u = shape.cells_u() == 2 && half_centred(task, task.u[next]) >= T(0);
    const bool high_v = shape.cells_v() == 2 && half_centred(task, task.v[next]) >= T(0);
    const std::size_t cell = task.patch[next] * shape.cells() + high_v * shape.cells_u() + high_u;
    prefetch_values(task.coefficients + cell * shape.cell_coefficients(),
                    shape.cell_coefficients());
  }
}

template <typename P, typename T>
SIMDBEZIER_KERNEL void scatter_shape(const ScatteredTask<T>& task) {
  using V = vec<T>;
  const NetShape shape = P::shape(*task.shape);
  constexpr std::size_t kFew = 3; // samples that take longer together than one after the other
  for (std::size_t k = 0; k < task.count;) {
    if (task.prefetch) {
      prefetch_sample(task, shape, k);
    }
    std::size_t count = 1;
    while (count < kLanes<V> && k + count < task.count && task.patch[k + count] == task.patch[k]) {
      ++count;
    }
    if ((kLanes<V>) > 1 && count <= kFew && evaluate_single<P>(task, shape, k)) {
      ++k;
      continue;
    }
    std::uint32_t special = evaluate_together<P>(task, shape, k, count, count == 1);
    for (std::size_t i = 0; i < count && special != 0; ++i, special >>= 1) {
      if (special % 2 != 0) {
        if (task.status != nullptr) {
          task.status[k + i] = SampleStatus::regular;
        }
        evaluate_together<P>(task, shape, k + i, 1, true);
      }
    }
    k += count;
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
