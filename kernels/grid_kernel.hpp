// Grid kernels, strategy "rows": lanes = u. The columns' polynomials in Y stay in registers while
// the rows are swept, so a position costs 3 madd, with first derivatives 8, a component.
//
// Without normals one component is swept after the other (4 or 8 registers, one to three store
// streams); normals need all three at once (24 registers, which AVX2 keeps partly in L1).
#pragma once

#include "kernels/bicubic.hpp"
#include "kernels/drain_kernel.hpp"
#include "kernels/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridTask;
using detail::RowKind;
using detail::RowRun;

SIMDBEZIER_INLINE bool is_edge(RowKind kind) {
  return kind == RowKind::edge_v0 || kind == RowKind::edge_v1;
}

SIMDBEZIER_INLINE std::size_t edge_of(RowKind kind) {
  return kind == RowKind::edge_v0 ? detail::kEdgeV0 : detail::kEdgeV1;
}

/// Stores a full register, or its first `active` lanes at the end of a row.
template <bool kFull, typename V>
SIMDBEZIER_INLINE void store_lanes(ScalarOf<V>* to, V value, std::size_t active) {
  if constexpr (kFull) {
    store_vector(to, value);
  } else {
    store_first(to, value, active);
  }
}

template <bool kFull, typename V>
SIMDBEZIER_INLINE void store_if_wanted(ScalarOf<V>* plane, std::size_t at, V value,
                                       std::size_t active) {
  if (plane != nullptr) {
    store_lanes<kFull>(plane + at, value, active);
  }
}

/// Positions of one component: one register of columns, all rows.
template <Scheme kScheme, bool kFull, typename V>
SIMDBEZIER_INLINE void sweep_position(const GridTask<ScalarOf<V>>& task,
                                      const Component<ScalarOf<V>>& c, const Column<V>& column,
                                      ScalarOf<V>* to, std::size_t active) {
  V q[kOrder];
  column_polynomial<kScheme>(c, column, q);
  const V origin = column_origin<kScheme>(c, column);
  const std::size_t nu = task.nu;
  const RowRun<ScalarOf<V>>* const last_run = task.runs + task.run_count;
  for (const RowRun<ScalarOf<V>>* run = task.runs; run != last_run; ++run) {
    const ScalarOf<V>* y = run->y;
    const ScalarOf<V>* const end = y + run->rows;
    if (is_watertight(kScheme) && is_edge(run->kind)) {
      const V p = edge_position<kScheme>(c, column, edge_of(run->kind));
      for (; y != end; ++y, to += nu) {
        store_lanes<kFull>(to, p, active);
      }
    } else {
      for (; y != end; ++y, to += nu) {
        const V p = with_origin<kScheme>(horner(q, broadcast<V>(*y)), origin);
        store_lanes<kFull>(to, p, active);
      }
    }
    pace(task.drain, run->rows * active);
  }
}

/// A register of columns as cubics in Y: one component's positions and u derivatives.
template <Scheme kScheme, typename V>
struct JetColumns {
  V q[kOrder];
  V dq[kOrder];
  V origin;

  SIMDBEZIER_INLINE void build(const Component<ScalarOf<V>>& c, const Column<V>& column) {
    column_polynomial<kScheme>(c, column, q, dq);
    origin = column_origin<kScheme>(c, column);
  }

  /// Position and both derivatives at one row; kEdge: on the edge v = 0 or 1.
  template <bool kEdge>
  SIMDBEZIER_INLINE V at(const Component<ScalarOf<V>>& c, const Column<V>& column, V y,
                         std::size_t edge, V& du, V& dv) const {
    const V p = horner(q, y, dv);
    if constexpr (kEdge) {
      return edge_position<kScheme>(c, column, edge, du);
    }
    du = horner(dq, y);
    return with_origin<kScheme>(p, origin);
  }
};

/// Where the samples of one component go.
template <typename T>
struct JetPlanes {
  T* position;
  T* du;
  T* dv;
};

template <bool kEdge, bool kFull, Scheme kScheme, typename V>
SIMDBEZIER_INLINE void derivative_rows(const RowRun<ScalarOf<V>>& run,
                                       const Component<ScalarOf<V>>& c, const Column<V>& column,
                                       const JetColumns<kScheme, V>& columns,
                                       const JetPlanes<ScalarOf<V>>& to, std::size_t at,
                                       std::size_t nu, std::size_t active) {
  const std::size_t edge = edge_of(run.kind);
  const ScalarOf<V>* const end = run.y + run.rows;
  for (const ScalarOf<V>* y = run.y; y != end; ++y, at += nu) {
    V du;
    V dv;
    const V p = columns.template at<kEdge>(c, column, broadcast<V>(*y), edge, du, dv);
    store_lanes<kFull>(to.position + at, p, active);
    store_lanes<kFull>(to.du + at, du, active);
    store_lanes<kFull>(to.dv + at, dv, active);
  }
}

template <Scheme kScheme, bool kFull, typename V>
SIMDBEZIER_INLINE void sweep_derivatives(const GridTask<ScalarOf<V>>& task,
                                         const Component<ScalarOf<V>>& c, const Column<V>& column,
                                         const JetPlanes<ScalarOf<V>>& to, std::size_t active) {
  JetColumns<kScheme, V> columns;
  columns.build(c, column);
  const std::size_t nu = task.nu;
  std::size_t at = 0;
  const RowRun<ScalarOf<V>>* const last_run = task.runs + task.run_count;
  for (const RowRun<ScalarOf<V>>* run = task.runs; run != last_run; ++run) {
    if (is_watertight(kScheme) && is_edge(run->kind)) {
      derivative_rows<true, kFull>(*run, c, column, columns, to, at, nu, active);
    } else {
      derivative_rows<false, kFull>(*run, c, column, columns, to, at, nu, active);
    }
    at += run->rows * nu;
    pace(task.drain, run->rows * active * 3);
  }
}

/// Second derivatives of one component.
template <Scheme kScheme, bool kFull, typename V>
SIMDBEZIER_INLINE void sweep_second(const GridTask<ScalarOf<V>>& task,
                                    const Component<ScalarOf<V>>& c, const Column<V>& column,
                                    std::size_t component, std::size_t at, std::size_t active) {
  using T = ScalarOf<V>;
  SecondColumns<V> columns;
  columns.template build<kScheme>(c, column);
  T* const duu = task.out[detail::kDuuGroup].component[component];
  T* const duv = task.out[detail::kDuvGroup].component[component];
  T* const dvv = task.out[detail::kDvvGroup].component[component];
  const RowRun<T>* const last_run = task.runs + task.run_count;
  for (const RowRun<T>* run = task.runs; run != last_run; ++run) {
    const bool edge = is_watertight(kScheme) && is_edge(run->kind);
    const V edge_duu = edge ? edge_second(c, column, edge_of(run->kind)) : column.x;
    const T* const end = run->y + run->rows;
    for (const T* y = run->y; y != end; ++y, at += task.nu) {
      const V row = broadcast<V>(*y);
      store_if_wanted<kFull>(duu, at, edge ? edge_duu : columns.duu(row), active);
      store_if_wanted<kFull>(duv, at, columns.duv(row), active);
      store_if_wanted<kFull>(dvv, at, columns.dvv(row), active);
    }
    pace(task.drain, run->rows * active * 3);
  }
}

/// What the rows of one register of columns have in common.
template <Scheme kScheme, typename V>
struct NormalColumns {
  using T = ScalarOf<V>;

  const GridTask<T>& task;
  std::size_t patch;
  std::size_t first; ///< column
  std::size_t active;
  Component<T> component[3];
  Column<V> column;
  JetColumns<kScheme, V> jet[3];

  SIMDBEZIER_INLINE NormalColumns(const GridTask<T>& the_task, std::size_t the_patch,
                                  std::size_t first_column, std::size_t active_lanes)
      : task(the_task), patch(the_patch), first(first_column),
        active(active_lanes), component{{the_task, the_patch, 0},
                                        {the_task, the_patch, 1},
                                        {the_task, the_patch, 2}},
        column(load_vector<V>(the_task.x + first_column)) {
    for (std::size_t c = 0; c < 3; ++c) {
      jet[c].build(component[c], column);
    }
  }
};

/// The lanes whose normal did not pass the quick test, one by one. Rare, so kept out of line;
/// vectors come by value, or the fast path would have to keep them in memory.
template <typename V>
__attribute__((noinline, cold)) void
resolve_normals(const GridTask<ScalarOf<V>>& task, std::size_t patch, std::size_t first,
                std::size_t active, std::size_t at, const ScalarOf<V>* y, V du0, V du1, V du2,
                V dv0, V dv1, V dv2, V squared, V floor) {
  using T = ScalarOf<V>;
  const V vectors[8] = {du0, du1, du2, dv0, dv1, dv2, squared, floor};
  alignas(64) T lanes[8][kLanes<V>];
  for (int i = 0; i < 8; ++i) {
    store_vector(lanes[i], vectors[i]);
  }
  for (std::size_t i = 0; i < active; ++i) {
    if (lanes[6][i] > lanes[7][i]) {
      continue;
    }
    const detail::NormalQuery<T> query{task.control_points + patch * detail::kCoefficients,
                                       task.x[first + i],
                                       *y,
                                       {lanes[0][i], lanes[1][i], lanes[2][i]},
                                       {lanes[3][i], lanes[4][i], lanes[5][i]}};
    T normal[3];
    const SampleStatus status = task.resolve_normal(query, normal);
    for (int c = 0; c < 3; ++c) {
      task.out[detail::kNormalGroup].component[c][at + i] = normal[c];
    }
    if (task.status != nullptr) {
      task.status[at + i] = status;
    }
  }
}

/// One run of rows; kAny: groups with null planes are computed and dropped.
template <bool kEdge, bool kFull, bool kAny, Scheme kScheme, typename V>
SIMDBEZIER_INLINE void normal_rows(const RowRun<ScalarOf<V>>& run,
                                   const NormalColumns<kScheme, V>& s, V floor, std::size_t at) {
  const detail::Planes<ScalarOf<V>> position = s.task.out[detail::kPositionGroup];
  const detail::Planes<ScalarOf<V>> normal = s.task.out[detail::kNormalGroup];
  const std::size_t nu = s.task.nu;
  const std::size_t edge = edge_of(run.kind);
  const ScalarOf<V>* const end = run.y + run.rows;
  for (const ScalarOf<V>* y = run.y; y != end; ++y, at += nu) {
    V du[3];
    V dv[3];
    for (std::size_t c = 0; c < 3; ++c) {
      const V p = s.jet[c].template at<kEdge>(s.component[c], s.column, broadcast<V>(*y), edge,
                                              du[c], dv[c]);
      if constexpr (kAny) {
        store_if_wanted<kFull>(position.component[c], at, p, s.active);
        store_if_wanted<kFull>(s.task.out[detail::kDuGroup].component[c], at, du[c], s.active);
        store_if_wanted<kFull>(s.task.out[detail::kDvGroup].component[c], at, dv[c], s.active);
      } else {
        store_lanes<kFull>(position.component[c] + at, p, s.active);
      }
    }
    if (kAny && !normal.wanted()) {
      continue;
    }
    V n[3];
    const V squared = cross_product(du, dv, n);
    normalise(n, squared);
    for (std::size_t c = 0; c < 3; ++c) {
      store_lanes<kFull>(normal.component[c] + at, n[c], s.active);
    }
    if (!all_of<V>(squared > floor)) [[unlikely]] {
      resolve_normals(s.task, s.patch, s.first, s.active, at, y, du[0], du[1], du[2], dv[0], dv[1],
                      dv[2], squared, floor);
    }
  }
}

/// All three components and their cross product.
template <Scheme kScheme, bool kFull, bool kAny, typename V>
SIMDBEZIER_INLINE void sweep_normals(const GridTask<ScalarOf<V>>& task, std::size_t patch,
                                     std::size_t first, std::size_t active) {
  using T = ScalarOf<V>;
  const NormalColumns<kScheme, V> s(task, patch, first, active);
  // A column outside of [0,1] may have derivatives of any size: its normals take a second look.
  const V never = broadcast<V>(static_cast<T>(__builtin_inf()));
  const V half = broadcast<V>(T(0.5));
  const V floor = select_where<V>((s.column.x <= half) & (s.column.x >= -half),
                                  broadcast<V>(task.normal_floor[patch]), never);
  std::size_t at = patch * task.patch_step + first;
  const RowRun<ScalarOf<V>>* const last_run = task.runs + task.run_count;
  for (const RowRun<ScalarOf<V>>* run = task.runs; run != last_run; ++run) {
    if (is_watertight(kScheme) && is_edge(run->kind)) {
      normal_rows<true, kFull, kAny>(*run, s, floor, at);
    } else {
      normal_rows<false, kFull, kAny>(*run, s, run->kind == RowKind::outside ? never : floor, at);
    }
    at += run->rows * task.nu;
    pace(task.drain, run->rows * active * (kAny ? 12 : 6));
  }
}

/// One register of columns of one patch.
template <detail::OutputSet kOutputs, Scheme kScheme, bool kFull, typename V>
SIMDBEZIER_INLINE void evaluate_columns(const GridTask<ScalarOf<V>>& task, std::size_t patch,
                                        std::size_t first, std::size_t active) {
  using T = ScalarOf<V>;
  if constexpr (kOutputs == detail::kPositionNormal || kOutputs == detail::kAnyOutputs) {
    sweep_normals<kScheme, kFull, kOutputs == detail::kAnyOutputs, V>(task, patch, first, active);
  } else {
    const Column<V> column(load_vector<V>(task.x + first));
    const std::size_t at = patch * task.patch_step + first;
    for (std::size_t c = 0; c < 3; ++c) {
      const Component<T> component(task, patch, c);
      T* const position = task.out[detail::kPositionGroup].component[c] + at;
      if constexpr (kOutputs == detail::kPosition) {
        sweep_position<kScheme, kFull>(task, component, column, position, active);
      } else if constexpr (kOutputs == detail::kSecondDerivatives) {
        sweep_second<kScheme, kFull>(task, component, column, c, at, active);
      } else {
        const JetPlanes<T> to{position, task.out[detail::kDuGroup].component[c] + at,
                              task.out[detail::kDvGroup].component[c] + at};
        sweep_derivatives<kScheme, kFull>(task, component, column, to, active);
      }
    }
  }
}

template <typename T, detail::OutputSet kOutputs, Scheme kScheme>
void grid_kernel(GridTask<T>& task) {
  using V = vec<T>;
  task.executed = Isa::SIMDBEZIER_ISA;
  const std::size_t full = task.nu / kLanes<V> * kLanes<V>;
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    for (std::size_t first = 0; first < full; first += kLanes<V>) {
      evaluate_columns<kOutputs, kScheme, true, V>(task, patch, first, kLanes<V>);
    }
    if (full < task.nu) {
      evaluate_columns<kOutputs, kScheme, false, V>(task, patch, full, task.nu - full);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
