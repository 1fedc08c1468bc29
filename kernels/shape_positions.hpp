// Positions on grids of patches whose degrees the compiler knows: the columns' polynomials stay in
// registers from the first row to the last.
#pragma once

#include "kernels/shape_grid.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A register of columns as polynomials in y, away from the edges v = const.
template <typename P, typename V>
struct ColumnPolynomials {
  static constexpr std::size_t kPowers = P::OrderV::kMost;
  V power[P::Slots::kSlots][kPowers];
  V origin[3];

  SIMDBEZIER_INLINE explicit ColumnPolynomials(const ShapeColumns<P, V>& from) {
    repeat<P::Slots::kSlots>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      repeat<kPowers>([&](std::size_t l)
                          SIMDBEZIER_INLINE_LAMBDA { power[slot][l] = from.power(slot)[l]; });
    });
    repeat<3>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA { origin[slot] = from.origin(slot); });
  }

  SIMDBEZIER_INLINE V value(std::size_t slot, V y) const {
    const V* const c = power[slot];
    return horner_series<0>(Order<kPowers>(kPowers), y,
                            [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return c[k]; })
        .value;
  }

  SIMDBEZIER_INLINE void evaluate(V y, bool origins, V p[3]) const {
    for (std::size_t slot = 0; slot < 3; ++slot) {
      p[slot] = value(slot, y);
    }
    if constexpr (P::kWeighted) {
      const Quotient<V> quotient(value(P::Slots::kSlots - 1, y));
      for (std::size_t slot = 0; slot < 3; ++slot) {
        p[slot] = quotient.value(p[slot]);
      }
    }
    for (std::size_t slot = 0; origins && slot < 3; ++slot) {
      p[slot] = p[slot] + origin[slot];
    }
  }
};

/// Where a row goes, and how much of it.
template <typename T>
struct PositionRow {
  T* to[3];
  std::size_t step;
  std::size_t active;

  template <bool kFull, typename V>
  SIMDBEZIER_INLINE void put(const V p[3]) {
    for (std::size_t c = 0; c < 3; ++c) {
      if constexpr (kFull) {
        store_vector(to[c], p[c]);
      } else {
        store_first(to[c], p[c], active);
      }
      to[c] += step;
    }
  }
};

template <typename P, bool kFull, typename T>
SIMDBEZIER_INLINE void sweep_positions(const GridTask<T>& task, bool watertight,
                                       const ShapeColumns<P, vec<T>>& columns, PositionRow<T> row) {
  using V = vec<T>;
  const ColumnPolynomials<P, V> polynomials(columns);
  const bool origins = task.origins != nullptr;
  for (std::size_t r = 0; r < task.run_count; ++r) {
    const RowRun<T> run = task.runs[r];
    if (watertight && (run.kind == RowKind::edge_v0 || run.kind == RowKind::edge_v1)) {
      SampleJet<V> jet;
      columns.replace_row(run.kind == RowKind::edge_v0 ? detail::kEdgeV0 : detail::kEdgeV1, jet);
      for (std::size_t j = 0; j < run.rows; ++j) {
        row.template put<kFull>(jet.position);
      }
    } else {
      for (std::size_t j = 0; j < run.rows; ++j) {
        V p[3];
        polynomials.evaluate(broadcast<V>(run.y[j]), origins, p);
        row.template put<kFull>(p);
      }
    }
  }
}

template <typename P, typename T>
__attribute__((noinline)) void sweep_position_patches(const GridTask<T>& shared_task,
                                                      bool watertight) {
  using V = vec<T>;
  // Copies, because stores through vector types might change anything that others can see.
  const GridTask<T> task = shared_task;
  const NetShape shape = P::shape(*shared_task.shape);
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    const CellRow<T> cell(task, shape, patch, 0);
    for (std::size_t first = 0; first < task.nu; first += kLanes<V>) {
      const std::size_t left = task.nu - first;
      const CellColumns<V> at(load_vector<V>(task.x + first), 1);
      ShapeColumns<P, V> columns(shape, at, 0, watertight);
      columns.build(cell);
      PositionRow<T> row{{}, task.nu, left};
      for (std::size_t c = 0; c < 3; ++c) {
        row.to[c] = task.out[detail::kPositionGroup].component[c] + patch * task.patch_step + first;
      }
      if (left >= kLanes<V>) {
        sweep_positions<P, true>(task, watertight, columns, row);
      } else {
        sweep_positions<P, false>(task, watertight, columns, row);
      }
    }
    pace(task.drain, task.patch_step * 3);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
