// Whether control polygons can be read.
#pragma once

#include <simdbezier/control_nets.hpp>

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
  return curves.degree >= 1 && curves.degree <= kMostDegree ? check_places(as_rows(curves))
                                                            : Status(Status::bad_degree);
}

} // namespace simdbezier::detail
