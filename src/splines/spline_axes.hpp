// The directions of splines, and what their calls have in common.
#pragma once

#include <new>

#include "src/splines/spline_knots.hpp"

namespace simdbezier::detail {

/// 0: u, 1: v.
template <typename S>
SplineAxis axis_of(const SplineSurface<S>& surface, int direction) noexcept {
  return direction == 0 ? SplineAxis{surface.degree_u, surface.columns, surface.periodic_u,
                                     surface.knots_u,  surface.u_range, surface.knot_tolerance}
                        : SplineAxis{surface.degree_v, surface.rows,    surface.periodic_v,
                                     surface.knots_v,  surface.v_range, surface.knot_tolerance};
}

/// A curve as a surface of one row. Its direction v is none, and of degree 0.
template <typename S>
SplineSurface<S> as_surface(const SplineCurve<S>& curve) noexcept {
  SplineSurface<S> surface;
  surface.points = curve.points;
  surface.rows = 1;
  surface.columns = curve.count;
  surface.point_stride = curve.point_stride;
  surface.component_stride = curve.component_stride;
  surface.components = curve.components;
  surface.weights = curve.weights;
  surface.periodic_u = curve.periodic;
  surface.degree_u = curve.degree;
  surface.degree_v = 0;
  surface.knots_u = curve.knots;
  surface.u_range = curve.range;
  surface.knot_tolerance = curve.knot_tolerance;
  surface.memory = curve.memory;
  return surface;
}

/// What a step reports; out_of_memory where it throws.
template <typename Step>
Report guarded(const Step& step) noexcept {
  try {
    return step();
  } catch (const std::bad_alloc&) {
    return {Status::out_of_memory};
  }
}

} // namespace simdbezier::detail
