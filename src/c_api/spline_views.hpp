// Splines of simdbezier.h as C++ has them, and what reports about them are about.
#pragma once

#include <algorithm>
#include <climits>

#include <simdbezier/splines.hpp>

#include "src/c_api/views.hpp"
#include "src/splines/spline_nets.hpp"

namespace simdbezier::c_api {

inline constexpr Path kSurface{"surface"};
inline constexpr Path kCurve{"curve"};

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
template <typename Struct>
std::span<const double> knots_of(const Given<Struct>& given, const double* first,
                                 std::size_t length, const char* name) {
  return span_of(numbers_at<double>(first, given.path / name), length, given.path / name);
}

/// A spline without its points, of which calls that are about knots read none.
template <typename S = double>
SplineSurface<S> axes_of(const Given<simdbezier_spline_surface>& given) {
  SplineSurface<S> surface;
  surface.rows = given.rows;
  surface.columns = given.columns;
  surface.periodic_u = given.periodic_u != 0;
  surface.periodic_v = given.periodic_v != 0;
  surface.degree_u = given.degree_u;
  surface.degree_v = given.degree_v;
  surface.knots_u = knots_of(given, given.knots_u, given.knots_u_length, "knots_u");
  surface.knots_v = knots_of(given, given.knots_v, given.knots_v_length, "knots_v");
  surface.u_range = {given.u_begin, given.u_end};
  surface.v_range = {given.v_begin, given.v_end};
  surface.knot_tolerance = given.knot_tolerance;
  return surface;
}
template <typename S = double>
SplineCurve<S> axes_of(const Given<simdbezier_spline_curve>& given) {
  SplineCurve<S> curve;
  curve.count = given.count;
  curve.periodic = given.periodic != 0;
  curve.degree = given.degree;
  curve.knots = knots_of(given, given.knots, given.knots_length, "knots");
  curve.range = {given.begin, given.end};
  curve.knot_tolerance = given.knot_tolerance;
  return curve;
}

template <typename S>
SplineSurface<S> view_of(const Given<simdbezier_spline_surface>& given) {
  auto surface = axes_of<S>(given);
  set_points<S>(surface, given, 1);
  surface.row_stride = given.row_stride;
  return surface;
}
template <typename S>
SplineCurve<S> view_of(const Given<simdbezier_spline_curve>& given) {
  auto curve = axes_of<S>(given);
  set_points<S>(curve, given, 1);
  return curve;
}

/// The member of a spline that a status is about, in one direction.
inline Path blamed_spline(Status status, int component, const Path& spline,
                          const SplineNames& names) {
  const int direction = component == 1 ? 1 : 0;
  return blamed(status,
                {{{Status::bad_knots}, spline / names.knots[direction]},
                 {{Status::bad_degree}, spline / names.degree[direction]},
                 {{Status::bad_grid, Status::size_overflow}, spline / names.points[direction]},
                 {{Status::bad_range}, spline / names.range[direction]},
                 {{Status::bad_tolerance}, spline / "knot_tolerance"}},
                blamed_nets(status, spline));
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
