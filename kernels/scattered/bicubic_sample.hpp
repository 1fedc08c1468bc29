// One scattered sample of a bicubic patch, V = T: registers of samples leave it those on edges and
// those whose normal needs a second look.
#pragma once

#include "kernels/poly/bicubic.hpp"
#include "kernels/poly/half_centred.hpp"
#include "kernels/poly/normal_lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The place of a sample in the parameter plane.
template <typename T>
struct SamplePlace {
  std::size_t patch;
  Column<T> column;
  T y;
  bool on_edge; ///< v = 0 or 1
  std::size_t edge;

  SIMDBEZIER_PART SamplePlace(const ScatteredTask<T>& task, std::size_t k)
      : patch(task.patch[k]), column(finite_half_centred(task, task.u[k]), task.watertight),
        y(finite_half_centred(task, task.v[k])),
        on_edge(task.watertight && (y == T(-0.5) || y == T(0.5))),
        edge(y == T(0.5) ? detail::kEdgeV1 : detail::kEdgeV0) {}
};

template <typename T>
SIMDBEZIER_PART void store_point(const detail::Planes<T>& planes, std::size_t at,
                                 const T value[3]) {
  if (planes.wanted()) {
    for (int c = 0; c < 3; ++c) {
      planes.component[c][at] = value[c];
    }
  }
}

template <typename T>
SIMDBEZIER_PART void store_normal(const ScatteredTask<T>& task, std::size_t k,
                                  const SamplePlace<T>& place, const T du[3], const T dv[3]) {
  const T x = place.column.x;
  const T y = place.y;
  T n[3];
  const T squared = cross_product(du, dv, n);
  const T floor = floor_inside(x, floor_inside(y, task.normal_floor[place.patch]));
  normalise(n, squared);
  store_point(task.out[output_index(Output::normal)], k, n);
  if (!(squared > floor)) {
    resolve_normals(task, place.patch, UncertainNormals{0, 1, 1, 1, k, 0, 1}, x, y, squared, floor);
  }
}

/// Evaluates the position and the first derivatives.
template <typename T>
SIMDBEZIER_PART void evaluate_first(const ScatteredTask<T>& task, std::size_t k,
                                    const SamplePlace<T>& place) {
  T p[3];
  T du[3];
  T dv[3];
  const RowPoint<T> at(place.y);
  for (std::size_t c = 0; c < 3; ++c) {
    const Component<T> component(task, place.patch, c);
    T q[kOrder];
    T dq[kOrder];
    column_polynomial(component, place.column, q, dq);
    p[c] = column_origin(component, place.column).add_to(row_value(q, at, dv[c]));
    if (place.on_edge) {
      p[c] = edge_position(component, place.column, place.edge, du[c]);
    } else {
      du[c] = row_value(dq, at);
    }
  }
  store_point(task.out[output_index(Output::position)], k, p);
  store_point(task.out[output_index(Output::du)], k, du);
  store_point(task.out[output_index(Output::dv)], k, dv);
  if (task.out[output_index(Output::normal)].wanted()) {
    store_normal(task, k, place, du, dv);
  }
}

template <typename T>
SIMDBEZIER_PART void evaluate_second(const ScatteredTask<T>& task, std::size_t k,
                                     const SamplePlace<T>& place) {
  T duu[3];
  T duv[3];
  T dvv[3];
  const RowPoint<T> at(place.y);
  for (std::size_t c = 0; c < 3; ++c) {
    const Component<T> component(task, place.patch, c);
    SecondColumns<T> columns;
    columns.build(component, place.column);
    duu[c] = place.on_edge ? edge_second(component, place.column, place.edge) : columns.duu(at);
    duv[c] = columns.duv(at);
    dvv[c] = columns.dvv(at);
  }
  store_point(task.out[output_index(Output::duu)], k, duu);
  store_point(task.out[output_index(Output::duv)], k, duv);
  store_point(task.out[output_index(Output::dvv)], k, dvv);
}

/// Evaluates sample k from start to end: the outputs of order <= 1, or (kSecond) those of order 2.
template <bool kSecond, typename T>
SIMDBEZIER_KERNEL void evaluate_sample(const ScatteredTask<T>& task, std::size_t k) {
  const SamplePlace<T> place(task, k);
  if (task.status != nullptr && (place.column.x != place.column.x || place.y != place.y)) {
    task.status[k] = SampleStatus::non_finite;
  }
  if constexpr (kSecond) {
    evaluate_second(task, k, place);
  } else {
    evaluate_first(task, k, place);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
