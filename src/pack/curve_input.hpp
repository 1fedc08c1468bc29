// Whether control polygons can be read.
#pragma once

#include <simdbezier/control_nets.hpp>
#include <simdbezier/status.hpp>

#include "src/nets/net_places.hpp"

namespace simdbezier::detail {

/// Polygons as nets of one row.
template <typename S>
[[nodiscard]] ControlNets<S> as_rows(const ControlCurves<S>& curves) noexcept {
  return {curves.points,       curves.count,
          curves.degree,       0,
          curves.curve_stride, 0,
          curves.point_stride, curves.component_stride,
          curves.components,   curves.weights,
          curves.memory};
}

/// ok | bad_degree | bad_components | null_input | bad_stride | size_overflow | input_too_small.
template <typename S>
[[nodiscard]] Status check_curves(const ControlCurves<S>& curves) noexcept {
  if (curves.degree < 1 || curves.degree > kMostDegree) {
    return Status::bad_degree;
  }
  if (curves.components < 1 || curves.components > kMostComponents ||
      curves.weights > Weights::homogeneous) {
    return Status::bad_components;
  }
  if (curves.points == nullptr && curves.count > 0) {
    return Status::null_input;
  }
  const bool single = curves.components == 1 && curves.weights == Weights::none;
  if (curves.point_stride == 0 || (curves.component_stride == 0 && !single)) {
    return Status::bad_stride;
  }
  Lattice lattice;
  if (!lattice_of(as_rows(curves), lattice)) {
    return Status::size_overflow;
  }
  return lies_in(lattice, curves.count, curves.memory) ? Status::ok : Status::input_too_small;
}

} // namespace simdbezier::detail
