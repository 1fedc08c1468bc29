// Scattered samples, one at a time, in the grid's order of operations: V = T.
#pragma once

#include "kernels/bicubic.hpp"
#include "kernels/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::ScatteredTask;

template <typename T>
SIMDBEZIER_INLINE void store_point(const detail::Planes<T>& planes, std::size_t at,
                                   const T value[3]) {
  if (planes.wanted()) {
    for (int c = 0; c < 3; ++c) {
      planes.component[c][at] = value[c];
    }
  }
}

/// Positions and, with kJet, both derivatives of one sample.
template <Scheme kScheme, bool kJet, typename T>
SIMDBEZIER_INLINE void evaluate_sample(const ScatteredTask<T>& task, std::size_t k, T p[3], T du[3],
                                       T dv[3]) {
  const T y = task.y[k];
  const Column<T> column(task.x[k]);
  const bool at_v0 = y == T(-0.5);
  const bool on_edge = is_watertight(kScheme) && (at_v0 || y == T(0.5));
  const std::size_t edge = at_v0 ? detail::kEdgeV0 : detail::kEdgeV1;
  for (std::size_t c = 0; c < 3; ++c) {
    const Component<T> component(task, task.patch[k], c);
    const T origin = column_origin<kScheme>(component, column);
    T q[kOrder];
    if constexpr (kJet) {
      T dq[kOrder];
      column_polynomial<kScheme>(component, column, q, dq);
      p[c] = with_origin<kScheme>(horner(q, y, dv[c]), origin);
      if (on_edge) {
        p[c] = edge_position<kScheme>(component, column, edge, du[c]);
      } else {
        du[c] = horner(dq, y);
      }
    } else if (on_edge) {
      p[c] = edge_position<kScheme>(component, column, edge);
    } else {
      column_polynomial<kScheme>(component, column, q);
      p[c] = with_origin<kScheme>(horner(q, y), origin);
    }
  }
}

template <typename T>
SIMDBEZIER_INLINE void store_normal(const ScatteredTask<T>& task, std::size_t k, const T du[3],
                                    const T dv[3]) {
  const std::size_t patch = task.patch[k];
  const T x = task.x[k];
  const T y = task.y[k];
  T n[3];
  const T squared = cross_product(du, dv, n);
  const bool inside = x <= T(0.5) && x >= T(-0.5) && y <= T(0.5) && y >= T(-0.5);
  if (inside && squared > task.normal_floor[patch]) {
    normalise(n, squared);
  } else {
    const detail::NormalQuery<T> query{task.control_points + patch * detail::kCoefficients,
                                       x,
                                       y,
                                       {du[0], du[1], du[2]},
                                       {dv[0], dv[1], dv[2]}};
    const SampleStatus status = task.resolve_normal(query, n);
    if (task.status != nullptr) {
      task.status[k] = status;
    }
  }
  store_point(task.out[detail::kNormalGroup], k, n);
}

/// Second derivatives of one sample.
template <Scheme kScheme, typename T>
SIMDBEZIER_INLINE void evaluate_second(const ScatteredTask<T>& task, std::size_t k) {
  const T y = task.y[k];
  const Column<T> column(task.x[k]);
  const bool at_v0 = y == T(-0.5);
  const bool on_edge = is_watertight(kScheme) && (at_v0 || y == T(0.5));
  const std::size_t edge = at_v0 ? detail::kEdgeV0 : detail::kEdgeV1;
  T duu[3];
  T duv[3];
  T dvv[3];
  for (std::size_t c = 0; c < 3; ++c) {
    const Component<T> component(task, task.patch[k], c);
    SecondColumns<T> columns;
    columns.template build<kScheme>(component, column);
    duu[c] = on_edge ? edge_second(component, column, edge) : columns.duu(y);
    duv[c] = columns.duv(y);
    dvv[c] = columns.dvv(y);
  }
  store_point(task.out[detail::kDuuGroup], k, duu);
  store_point(task.out[detail::kDuvGroup], k, duv);
  store_point(task.out[detail::kDvvGroup], k, dvv);
}

template <typename T, Scheme kScheme>
void scattered_kernel(ScatteredTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  const bool jet = task.out[detail::kDuGroup].wanted() || task.out[detail::kDvGroup].wanted() ||
                   task.out[detail::kNormalGroup].wanted();
  const bool second = task.out[detail::kDuuGroup].wanted() ||
                      task.out[detail::kDuvGroup].wanted() || task.out[detail::kDvvGroup].wanted();
  for (std::size_t k = 0; k < task.count; ++k) {
    T p[3];
    T du[3];
    T dv[3];
    if (jet) {
      evaluate_sample<kScheme, true>(task, k, p, du, dv);
      store_point(task.out[detail::kDuGroup], k, du);
      store_point(task.out[detail::kDvGroup], k, dv);
      if (task.out[detail::kNormalGroup].wanted()) {
        store_normal(task, k, du, dv);
      }
    } else {
      evaluate_sample<kScheme, false>(task, k, p, du, dv);
    }
    store_point(task.out[detail::kPositionGroup], k, p);
    if (second) {
      evaluate_second<kScheme>(task, k);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
