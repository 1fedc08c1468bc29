// Splines of simdbezier.h as C++ has them, and what reports about them are about.
#pragma once

#include <algorithm>
#include <climits>
#include <utility>
#include <vector>

#include <simdbezier/splines.hpp>

#include "src/c_api/views.hpp"
#include "src/splines/spline_nets.hpp"

namespace simdbezier::c_api {

inline constexpr Path kSurface{"surface"};
inline constexpr Path kCurve{"curve"};
inline constexpr Path kSplineOut{"out"};

/// What members of a spline are called, in u and in v.
struct SplineNames {
  const char* knots[2];
  const char* degree[2];
  const char* points[2];
  const char* range[2];
};
inline constexpr SplineNames kSurfaceNames{{"knots_u", "knots_v"},
                                           {"degree_u", "degree_v"},
                                           {"columns", "rows"},
                                           {"u_begin or u_end", "v_begin or v_end"}};
inline constexpr SplineNames kCurveNames{
    {"knots", "knots"}, {"degree", "degree"}, {"count", "count"}, {"begin or end", "begin or end"}};

/// The caller's knots; without any they are uniform.
inline std::span<const double> knots_at(const double* first, std::size_t length, const Path& path) {
  return span_of(numbers_at<double>(first, path), length, path);
}

/// The address of the first value of a spline's points, and their memory. S = void: of points that
/// are not read.
template <typename S, typename Struct>
std::pair<const S*, std::span<const S>> spline_points(const Struct& given, const Path& path) {
  simdbezier_nets like{};
  like.points = given.points;
  like.length = given.length;
  like.first = given.first;
  like.count = 1;
  like.scalar = given.scalar;
  return first_value<S>(like, path);
}

/// A surface as its knots alone are asked for.
inline SplineSurface<double> axes_of(const simdbezier_spline_surface& given, const Path& path) {
  SplineSurface<double> surface;
  surface.rows = given.rows;
  surface.columns = given.columns;
  surface.periodic_u = given.periodic_u != 0;
  surface.periodic_v = given.periodic_v != 0;
  surface.degree_u = given.degree_u;
  surface.degree_v = given.degree_v;
  surface.knots_u = knots_at(given.knots_u, given.knots_u_length, path / "knots_u");
  surface.knots_v = knots_at(given.knots_v, given.knots_v_length, path / "knots_v");
  surface.u_range = {given.u_begin, given.u_end};
  surface.v_range = {given.v_begin, given.v_end};
  surface.knot_tolerance = given.knot_tolerance;
  return surface;
}
inline SplineCurve<double> axes_of(const simdbezier_spline_curve& given, const Path& path) {
  SplineCurve<double> curve;
  curve.count = given.count;
  curve.periodic = given.periodic != 0;
  curve.degree = given.degree;
  curve.knots = knots_at(given.knots, given.knots_length, path / "knots");
  curve.range = {given.begin, given.end};
  curve.knot_tolerance = given.knot_tolerance;
  return curve;
}

template <typename S>
SplineSurface<S> spline_of(const simdbezier_spline_surface& given, const Path& path) {
  const auto [points, memory] = spline_points<S>(given, path);
  const SplineSurface<double> axes = axes_of(given, path);
  return {points,
          axes.rows,
          axes.columns,
          given.row_stride,
          given.point_stride,
          given.component_stride,
          given.components,
          weights_of(given.weights, path),
          axes.periodic_u,
          axes.periodic_v,
          axes.degree_u,
          axes.degree_v,
          axes.knots_u,
          axes.knots_v,
          axes.u_range,
          axes.v_range,
          axes.knot_tolerance,
          memory};
}
template <typename S>
SplineCurve<S> spline_of(const simdbezier_spline_curve& given, const Path& path) {
  const auto [points, memory] = spline_points<S>(given, path);
  const SplineCurve<double> axes = axes_of(given, path);
  return {points,
          axes.count,
          given.point_stride,
          given.component_stride,
          given.components,
          weights_of(given.weights, path),
          axes.periodic,
          axes.degree,
          axes.knots,
          axes.range,
          axes.knot_tolerance,
          memory};
}

/// body(std::span<const SplineSurface<S>>) with the surfaces of an array, S being their type.
template <typename Body>
auto with_surface_array(const simdbezier_spline_surface* surfaces, std::size_t length, Body body) {
  const char* const name = "surfaces";
  const simdbezier_scalar scalar =
      length == 0 ? SIMDBEZIER_F32 : read_element(surfaces, 0, name).scalar;
  return with_scalar(scalar, Path{name, 0} / "scalar", [&]<typename S>() {
    std::vector<SplineSurface<S>> views;
    reserve(views, length);
    for (std::size_t k = 0; k < length; ++k) {
      views.push_back(spline_of<S>(read_element(surfaces, k, name), {name, k}));
    }
    return body(std::span<const SplineSurface<S>>(views));
  });
}

/// The member of a spline that a status is about, in one direction.
inline Path blamed_spline(Status status, int component, const Path& spline,
                          const SplineNames& names) {
  const int direction = component == 1 ? 1 : 0;
  switch (status.code()) {
  case Status::bad_knots:
    return spline / names.knots[direction];
  case Status::bad_degree:
    return spline / names.degree[direction];
  case Status::bad_grid:
  case Status::size_overflow:
    return spline / names.points[direction];
  case Status::bad_range:
    return spline / names.range[direction];
  case Status::bad_tolerance:
    return spline / "knot_tolerance";
  default:
    return blamed_nets(status, spline);
  }
}

/// Refuses a call for a fault of a report; `numbered` is whether its point is known.
[[noreturn]] inline void refuse(const Report& report, const Path& path, bool numbered) {
  const int point =
      numbered ? static_cast<int>(std::min<std::ptrdiff_t>(report.point, INT_MAX)) : -1;
  throw Fault{code_of(report.status), path, report.item, point, report.component, "spline"};
}

/// Refuses a call for what a report says of a spline that is at fault itself.
inline void require_spline(const Report& own, const Path& spline, const SplineNames& names) {
  if (!own) {
    const bool numbered =
        own.status == Status::bad_knots || own.status == Status::non_finite_input ||
        own.status == Status::coefficient_overflow || own.status == Status::bad_weight;
    refuse(own, blamed_spline(own.status, own.component, spline, names), numbered);
  }
}

/// Refuses a call for the first surface that is at fault itself, whatever is wrong besides.
template <typename S>
void require_surfaces(std::span<const SplineSurface<S>> surfaces) {
  const Report own = detail::SplineList<S>().prepare(surfaces);
  require_spline(own, {"surfaces", own.item}, kSurfaceNames);
}

} // namespace simdbezier::c_api
