// Scattered samples on patches of any shape: lanes = consecutive samples of one patch.
#pragma once

#include "kernels/scattered/bicubic_sample.hpp"
#include "kernels/shape/shape_outputs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::ScatteredTask;

/// The lanes of `yes` keep what `jet` has, the others get what `other` has.
template <typename P, typename V>
SIMDBEZIER_INLINE void keep_lanes(MaskOf<V> yes, const SampleJet<V>& other, SampleJet<V>& jet) {
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

/// Samples of one patch in one row of cells, at the local y. edge: the edge v = const of the cells
/// that all of them are on; kEdges where it is none. Out of line: it is large, and there are
/// several ways to it.
template <typename P, typename V>
__attribute__((noinline)) void evaluate_row(const ScatteredTask<ScalarOf<V>>& task,
                                            const NetShape& shape, std::size_t patch,
                                            std::size_t cell, const CellColumns<V>& columns, V y,
                                            std::size_t edge, SampleJet<V>& jet) {
  using T = ScalarOf<V>;
  const CellRow<T> cells(task, shape, patch, cell);
  ShapeColumns<P, V> polynomials(shape, columns, task.first_component);
  polynomials.build(cells);
  polynomials.evaluate(y, jet);
  if (edge < kEdges) [[unlikely]] {
    polynomials.replace_row(edge, jet);
  }
}

/// Samples of one patch at half-centred x, y; edge: as above, for samples that are all the same
/// one.
template <typename P, typename V>
SIMDBEZIER_INLINE void evaluate_lanes(const ScatteredTask<ScalarOf<V>>& task, const NetShape& shape,
                                      std::size_t patch, V x, V y, std::size_t edge,
                                      SampleJet<V>& jet) {
  const CellColumns<V> columns(x, shape.cells_u(), task.watertight);
  const CellColumns<V> rows(y, shape.cells_v(), task.watertight);
  const bool both = rows.any_low && rows.any_high;
  evaluate_row<P>(task, shape, patch, rows.any_low ? 0 : 1, columns, rows.local.x, edge, jet);
  if (both) {
    SampleJet<V> high;
    evaluate_row<P>(task, shape, patch, 1, columns, rows.local.x, edge, high);
    keep_lanes<P>(rows.low, high, jet);
  }
}

/// What the normals of scattered samples are tested with.
template <typename P, typename V>
SIMDBEZIER_INLINE V sample_floor(const ScatteredTask<ScalarOf<V>>& task,
                                 const SampleRange<V>& range) {
  const V floor = patch_floor<P, V>(task, range.patch);
  return floor_inside(range.y, floor_inside(range.x, floor));
}

/// Where a sample is among the edges v = const of its cells.
template <typename T>
SIMDBEZIER_INLINE std::size_t edge_at(const NetShape& shape, T y) {
  const T local = shape.cells_v() == 1 ? y : cell_parameter(y);
  return local == T(-0.5) ? detail::kEdgeV0 : local == T(0.5) ? detail::kEdgeV1 : kEdges;
}

/// Sample k alone, in all lanes of a register: with an edge v = const of its own where it is on
/// one.
template <typename P, typename T>
__attribute__((noinline)) void evaluate_single(const ScatteredTask<T>& task, const NetShape& shape,
                                               std::size_t k) {
  using V = vec<T>;
  const T x = finite_half_centred(task, task.u[k]);
  const T y = finite_half_centred(task, task.v[k]);
  SampleRange<V> range{task.patch[k], k, 1, 0, broadcast<V>(x), broadcast<V>(y), {}};
  range.floor = sample_floor<P>(task, range);
  SampleJet<V> jet;
  evaluate_lanes<P, V>(task, shape, range.patch, range.x, range.y,
                       task.watertight ? edge_at(shape, y) : kEdges, jet);
  if (task.status != nullptr && (x != x || y != y)) {
    task.status[k] = SampleStatus::non_finite;
  }
  store_sample<P>(task, range, jet);
}

/// Samples [k, k + count) of one patch, at most a register of them, the rest of it repeats the
/// last.
template <typename P, typename V>
SIMDBEZIER_INLINE void evaluate_together(const ScatteredTask<ScalarOf<V>>& task,
                                         const NetShape& shape, std::size_t k, std::size_t count) {
  using T = ScalarOf<V>;
  alignas(64) T x[kLanes<V>];
  alignas(64) T y[kLanes<V>];
  bool alone[kLanes<V>]; // on an edge v = const or not finite
  bool any_alone = false;
  for (std::size_t i = 0; i < kLanes<V>; ++i) {
    const std::size_t from = k + (i < count ? i : count - 1);
    x[i] = finite_half_centred(task, task.u[from]);
    y[i] = finite_half_centred(task, task.v[from]);
    alone[i] = edge_at(shape, y[i]) < kEdges || x[i] != x[i] || y[i] != y[i];
    any_alone = any_alone || alone[i];
  }
  SampleRange<V> range{task.patch[k], k, count, 0, load_vector<V>(x), load_vector<V>(y), {}};
  range.floor = sample_floor<P>(task, range);
  SampleJet<V> jet;
  evaluate_lanes<P, V>(task, shape, range.patch, range.x, range.y, kEdges, jet);
  store_sample<P>(task, range, jet);
  for (std::size_t i = 0; any_alone && i < count; ++i) {
    if (alone[i]) {
      if (task.status != nullptr) {
        task.status[k + i] = SampleStatus::regular;
      }
      evaluate_single<P>(task, shape, k + i);
    }
  }
}

template <typename P, typename T>
__attribute__((noinline)) void scatter_shape(const ScatteredTask<T>& task) {
  using V = vec<T>;
  const NetShape shape = P::shape(*task.shape);
  for (std::size_t k = 0; k < task.count;) {
    std::size_t count = 1;
    while (count < kLanes<V> && k + count < task.count && task.patch[k + count] == task.patch[k]) {
      ++count;
    }
    if (count == 1) {
      evaluate_single<P>(task, shape, k);
    } else {
      evaluate_together<P, V>(task, shape, k, count);
    }
    k += count;
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
