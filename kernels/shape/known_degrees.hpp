// Grids of patches whose degree in v the compiler knows: the columns' polynomials stay in registers
// from the first row to the last.
#pragma once

#include "kernels/poly/row_runs.hpp"
#include "kernels/shape/shape_rows.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns the edge v = const that a run of rows is on, or kEdges where it is on none, or edges are
/// as good as any row.
template <typename T>
SIMDBEZIER_PART std::size_t own_edge(const GridTask<T>& task, const RowRun<T>& run) {
  return task.watertight && is_edge(run.kind) ? edge_of(run.kind) : kEdges;
}

/// Whether rows of a plan can be evaluated two at a time, Y and -Y.
template <typename P>
inline constexpr bool kInPairs = takes_even_odd(P::OrderV::kMost) &&
                                 (P::kDepth == 0 || (P::kDepth == 1 && P::kSingle));

/// Whether single columns, such as sides of patches in a mesh, have rows as lanes: with normals,
/// where a row has much to compute.
template <typename P>
inline constexpr bool kSweepsSingle = !P::kSingle && P::kDepth == 1;

/// Sweeps all rows of a register of columns. kFull says that all lanes are columns; kPairs, that
/// pairs_pay(). Lanes of a single column are rows, so that a register holds as many points.
///
/// Rows on edges, pairs and single rows have loops of their own: in one loop, polynomials leave the
/// registers, which costs 10 to 30 % of the speed (docs/experiments.md).
template <typename P, bool kFull, bool kPairs, typename T>
SIMDBEZIER_PART void sweep_rows(const GridTask<T>& task, const ShapeColumns<P, vec<T>>& columns,
                                const typename ShapeColumns<P, vec<T>>::Edges& edges,
                                SampleRange<vec<T>> range) {
  using V = vec<T>;
  const ColumnPolynomials<P, V> polynomials = columns.polynomials();
  const ColumnOrigins<V>* const origins = columns.origins();
  const V floor = range.floor;
  const bool single = kSweepsSingle<P> && task.nu == 1;
  const std::size_t active = kFull ? kLanes<V> : range.active;
  const auto evaluate = [&](SampleJet<V>& jet) SIMDBEZIER_INLINE_LAMBDA {
    polynomials.template evaluate<1>(columns.slots(), columns.order_v(), &range.y, origins, &jet);
  };
  for (std::size_t r = 0; r < task.run_count; ++r) {
    const RowRun<T> run = task.runs[r];
    const std::size_t edge = own_edge(task, run);
    range.active = active;
    if constexpr (!P::kSingle) {
      range.floor = run.kind == RowKind::outside ? no_floor<V>() : floor;
    }
    if (edge < kEdges) {
      SampleJet<V> jet;
      range.y = broadcast<V>(run.y[0]);
      if constexpr (P::kDepth > 0) { // of positions, edges need nothing that the columns give
        evaluate(jet);
      }
      edges.replace_row(edge, jet);
      for (std::size_t j = 0; j < run.rows; ++j, range.at += task.nu) {
        store_sample<P>(task, range, jet);
      }
    } else if constexpr (kPairs) {
      SampleRange<V> image = range;
      image.at += (run.rows - 1) * task.nu;
      const std::size_t behind = image.at + task.nu;
      const std::size_t pairs = (run.rows + 1) / 2;
      for (std::size_t j = 0; j < pairs; ++j, range.at += task.nu, image.at -= task.nu) {
        SampleJet<V> jet;
        SampleJet<V> mirrored;
        polynomials.evaluate_pair(columns.slots(), broadcast<V>(run.y[j]), origins, jet, mirrored);
        store_sample<P>(task, range, jet);
        if (range.at != image.at) {
          store_sample<P>(task, image, mirrored);
        }
      }
      range.at = behind;
    } else {
      for (std::size_t j = 0; j < run.rows; j += single ? kLanes<V> : 1) {
        SampleJet<V> jet;
        if (single) {
          range.y = load_vector<V>(run.y + j);
          range.active = std::min(run.rows - j, kLanes<V>);
        } else {
          range.y = broadcast<V>(run.y[j]);
        }
        evaluate(jet);
        store_sample<P>(task, range, jet);
        range.at += single ? range.active : task.nu;
      }
    }
  }
}

/// Whether all rows that are on no edge are pairs Y and -Y whose registers share no lines.
template <typename T>
SIMDBEZIER_PART bool pairs_pay(const GridTask<T>& task) {
  bool mirrored = task.nu % kLanes<vec<T>> == 0;
  for (std::size_t r = 0; r < task.run_count && mirrored; ++r) {
    const RowRun<T> run = task.runs[r];
    mirrored = own_edge(task, run) < kEdges || are_mirrored(run.y, run.rows);
  }
  return mirrored;
}

/// Sweeps the columns from `first` on of one patch, and components from `component` on. pairs is
/// what pairs_pay() returns.
template <typename P, typename T>
SIMDBEZIER_PART void sweep_columns(const GridTask<T>& task, const NetShape& shape,
                                   std::size_t patch, std::size_t first, std::size_t component,
                                   bool pairs) {
  using V = vec<T>;
  const CellRow<T> cells(task, shape, patch, 0);
  const bool single = kSweepsSingle<P> && task.nu == 1;
  const V x = single ? broadcast<V>(task.x[0]) : load_vector<V>(task.x + first);
  const CellColumns<V> at(x, 1, task.watertight);
  const std::size_t first_component = P::kSingle ? task.first_component + component : 0;
  const typename ShapeColumns<P, V>::Edges edges(shape, at, x, task.watertight, first_component,
                                                 cells);
  const std::size_t left = task.nu - first < kLanes<V> ? task.nu - first : kLanes<V>;
  SampleRange<V> range{patch, patch * task.patch_step + first, left, component, x, x, x};
  ShapeColumns<P, V> columns(shape, at, first_component);
  ColumnOrigins<V> origins;
  columns.build(cells, edges, origins);
  if constexpr (kInPairs<P>) {
    if (pairs) {
      return sweep_rows<P, true, true>(task, columns, edges, range);
    }
  }
  if constexpr (P::kDepth == 0 || P::kSingle) {
    if (left == kLanes<V>) {
      return sweep_rows<P, true, false>(task, columns, edges, range);
    }
  } else { // much code, and many operations for each store
    range.floor = floor_inside(x, patch_floor<P, V>(task, patch));
  }
  sweep_rows<P, false, false>(task, columns, edges, range);
}

template <typename P, typename T>
SIMDBEZIER_KERNEL void sweep_known(const GridTask<T>& shared_task) {
  const GridTask<T> task = shared_task;
  const NetShape shape = P::shape(*shared_task.shape);
  const bool pairs = kInPairs<P> && pairs_pay(task);
  const std::size_t left = static_cast<std::size_t>(shape.components) - task.first_component;
  const std::size_t components = P::kSingle ? std::min<std::size_t>(left, 3) : 1;
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    for (std::size_t next = 0; next < task.nu; next += kLanes<vec<T>>) {
      const std::size_t first = register_start<vec<T>>(next, task.nu, 1);
      for (std::size_t c = 0; c < components; ++c) {
        sweep_columns<P>(task, shape, patch, first, c, pairs);
      }
    }
    drain_some(task.drain, task.patch_step * 3);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
