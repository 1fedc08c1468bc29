// Splines of simdbezier.h: their patches, places and samples.

#include <simdbezier/splines.hpp>

#include "src/c_api/samples.hpp"
#include "src/c_api/spline_views.hpp"

namespace simdbezier::c_api {
namespace {

std::span<PatchInterval> intervals_at(simdbezier_patch_interval* first, std::size_t length) {
  return in_place<PatchInterval>(span_of(first, length, {"intervals"}));
}

/// What a call is refused for where the surfaces are sound: what they are to become. Surfaces
/// behind the first may differ from it.
Path blamed_result(const Report& report, const Path& out) {
  const Path surface{"surfaces", report.item};
  const bool first = report.item == 0;
  return blamed(report.status,
                {{{Status::unequal_lengths}, {"intervals_length"}},
                 {{Status::bad_degree},
                  first ? blamed_nets(report.status, out) : surface / "degree_u or degree_v"},
                 {{Status::bad_components}, (first ? out : surface) / "components or weights"},
                 {{Status::non_finite_input}, kOptions / "relative_to"},
                 {{Status::coefficient_overflow}, surface / "points"}},
                blamed_nets(report.status, out));
}

/// locate() where only knots are looked at.
Report look_at_knots(const SplineSurface<double>& surface) {
  return locate(surface, 0, nullptr, nullptr, {});
}
Report look_at_knots(const SplineCurve<double>& curve) { return locate(curve, 0, nullptr, {}); }

/// Refuses a call about places on a spline: for its knots, else for a parameter, which is called
/// parameters[direction].
template <typename Spline>
void require_places(const Report& report, const Spline& axes, const Path& path,
                    const SplineNames& names, const char* const (&parameters)[2]) {
  if (report) {
    return;
  }
  require_spline(look_at_knots(axes), path, names);
  if (report.status == Status::bad_range || report.status == Status::non_finite_input) {
    refuse(report, {parameters[report.component == 1 ? 1 : 0]}, true);
  }
}

/// Parameters of a spline.
std::span<const double> spline_parameters(const double* first, std::size_t length,
                                          const char* name) {
  return span_of(numbers_at<double>(first, {name}), length, {name});
}

SplinePlaces places_of(const simdbezier_spline_places* given, std::size_t count, bool is_curve) {
  const Path path{"places"};
  require(given != nullptr, SIMDBEZIER_NULL_OUTPUT, path);
  const auto known = read(given, path);
  require(known.length >= count, SIMDBEZIER_OUTPUT_TOO_SMALL, path / "length");
  SplinePlaces places;
  places.patch = numbers_at<std::uint32_t>(known.patch, path / "patch");
  places.u = numbers_at<double>(known.u, path / "u");
  places.length_u = numbers_at<double>(known.length_u, path / "length_u");
  places.centred_u = numbers_at<double>(known.centred_u, path / "centred_u");
  if (!is_curve) {
    places.centred_v = numbers_at<double>(known.centred_v, path / "centred_v");
    places.v = numbers_at<double>(known.v, path / "v");
    places.length_v = numbers_at<double>(known.length_v, path / "length_v");
  }
  return places;
}

/// evaluate_grid() or evaluate_samples(): call(set, surface, u, v, out, options) with the C++
/// objects. samples: how many there are of so many u and v.
template <typename Count, typename Call>
simdbezier_status evaluate_spline(const char* function, const simdbezier_patch_set* set,
                                  const simdbezier_spline_surface* surface, const double* u,
                                  std::size_t u_length, const double* v, std::size_t v_length,
                                  const simdbezier_outputs* out, const simdbezier_options* options,
                                  Count samples, Call call) noexcept {
  return answer(function, [&] {
    const SplineSurface<double> axes = axes_of(read(surface, kSurface));
    const auto us = spline_parameters(u, u_length, "u");
    const auto vs = spline_parameters(v, v_length, "v");
    with_object(set, {"set"}, [&]<typename T>(const PatchSet<T>& patches) {
      const Outputs<T> to = outputs_of<T>(out);
      const Options how = call_options_of(options);
      const Report report = call(patches, axes, us, vs, to, how);
      require_places(report, axes, kSurface, kSurfaceNames, {"u", "v"});
      require_ok(report.status, [&](Status status) {
        return status == Status::unequal_lengths
                   ? Path{"v_length"}
                   : blamed_in_evaluation<simdbezier_outputs>(status, {"first_patch"}, to,
                                                              samples(us.size(), vs.size()),
                                                              patches.components());
      });
    });
  });
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_spline_span_count(const simdbezier_spline_surface* surface,
                                               size_t* spans_u, size_t* spans_v) {
  return answer(__func__, [&] {
    const SplineSurface<double> axes = axes_of(read(surface, kSurface));
    require(spans_u != nullptr, SIMDBEZIER_NULL_OUTPUT, {"spans_u"});
    require(spans_v != nullptr, SIMDBEZIER_NULL_OUTPUT, {"spans_v"});
    require_spline(look_at_knots(axes), kSurface, kSurfaceNames);
    const SpanCounts counts = detail::spans_of(axes);
    *spans_u = counts.u;
    *spans_v = counts.v;
  });
}

simdbezier_status simdbezier_spline_curve_span_count(const simdbezier_spline_curve* curve,
                                                     size_t* spans) {
  return answer(__func__, [&] {
    const SplineCurve<double> axis = axes_of(read(curve, kCurve));
    require(spans != nullptr, SIMDBEZIER_NULL_OUTPUT, {"spans"});
    require_spline(look_at_knots(axis), kCurve, kCurveNames);
    *spans = detail::spans_of(detail::as_surface(axis)).u;
  });
}

simdbezier_status simdbezier_spline_to_bezier(const simdbezier_spline_surface* surfaces,
                                              size_t length, const simdbezier_mutable_nets* out,
                                              simdbezier_patch_interval* intervals,
                                              size_t intervals_length,
                                              const simdbezier_options* options) {
  return answer(__func__, [&] {
    require(out != nullptr, SIMDBEZIER_NULL_OUTPUT, kOut);
    const auto given = read(out, kOut);
    const std::span<PatchInterval> places = intervals_at(intervals, intervals_length);
    const Options how = call_options_of(options);
    with_array(
        surfaces, length, "surfaces",
        [&]<typename S>(std::span<const SplineSurface<S>> views) {
          const MutableNets<S> nets = view_of<S>(given);
          const Report report = to_bezier(views, nets, places, how);
          if (!report) {
            require_surfaces(views);
            refuse(report, blamed_result(report, kOut), false);
          }
        },
        given.scalar);
  });
}

simdbezier_status simdbezier_spline_curve_to_bezier(const simdbezier_spline_curve* curve,
                                                    simdbezier_values points,
                                                    simdbezier_interval* intervals,
                                                    size_t intervals_length,
                                                    const simdbezier_options* options) {
  return answer(__func__, [&] {
    const auto given = read(curve, kCurve);
    const auto to = SIMDBEZIER_ARRAY(intervals);
    const Options how = call_options_of(options);
    with_scalar(given.scalar, kCurve / "scalar", [&]<typename S>() {
      const auto view = view_of<S>(given);
      const Report report =
          to_bezier(view, output_of<S>(points, {"points"}), in_place<Interval>(to), how);
      if (!report) {
        require_spline(detail::SplineList<S>().prepare(view), kCurve, kCurveNames);
        const Path path{"points"};
        refuse(report, blamed(report.status, {{kOutputFaults, path}}, blamed_result(report, path)),
               false);
      }
    });
  });
}

simdbezier_status simdbezier_spline_pack(const simdbezier_spline_surface* surfaces, size_t length,
                                         simdbezier_scalar scalar,
                                         simdbezier_patch_interval* intervals,
                                         size_t intervals_length,
                                         const simdbezier_pack_options* options,
                                         simdbezier_patch_set** set) {
  return answer(__func__, [&] {
    require_place(set, {"set"});
    const std::span<PatchInterval> places = intervals_at(intervals, intervals_length);
    const PackOptions how = pack_options_of(options);
    with_array(surfaces, length, "surfaces",
               [&]<typename S>(std::span<const SplineSurface<S>> views) {
                 with_scalar(scalar, {"scalar"}, [&]<typename T>() {
                   PatchSet<T> packed;
                   const Report report = pack(views, packed, places, how);
                   if (!report) {
                     require_surfaces(views);
                     refuse(report, blamed_result(report, {"surfaces", report.item}), false);
                   }
                   give(set, std::move(packed));
                 });
               });
  });
}

simdbezier_status simdbezier_spline_locate(const simdbezier_spline_surface* surface,
                                           const double* u, size_t u_length, const double* v,
                                           size_t v_length,
                                           const simdbezier_spline_places* places) {
  return answer(__func__, [&] {
    const SplineSurface<double> axes = axes_of(read(surface, kSurface));
    const auto us = spline_parameters(u, u_length, "u");
    const auto vs = spline_parameters(v, v_length, "v");
    require(us.size() == vs.size(), SIMDBEZIER_UNEQUAL_LENGTHS, {"v_length"});
    const Report report =
        locate(axes, us.size(), us.data(), vs.data(), places_of(places, us.size(), false));
    require_places(report, axes, kSurface, kSurfaceNames, {"u", "v"});
    require_ok(report.status, [](Status) { return Path{}; });
  });
}

simdbezier_status simdbezier_spline_curve_locate(const simdbezier_spline_curve* curve,
                                                 const double* t, size_t t_length,
                                                 const simdbezier_spline_places* places) {
  return answer(__func__, [&] {
    const SplineCurve<double> axis = axes_of(read(curve, kCurve));
    const auto ts = spline_parameters(t, t_length, "t");
    const Report report = locate(axis, ts.size(), ts.data(), places_of(places, ts.size(), true));
    require_places(report, axis, kCurve, kCurveNames, {"t", "t"});
    require_ok(report.status, [](Status) { return Path{}; });
  });
}

simdbezier_status simdbezier_spline_evaluate_grid(const simdbezier_patch_set* set,
                                                  const simdbezier_spline_surface* surface,
                                                  const double* u, size_t u_length, const double* v,
                                                  size_t v_length, const simdbezier_outputs* out,
                                                  const simdbezier_options* options,
                                                  size_t first_patch) {
  return evaluate_spline(
      __func__, set, surface, u, u_length, v, v_length, out, options,
      [](std::size_t us, std::size_t vs) { return us * vs; },
      [&](const auto&... arguments) { return evaluate_grid(arguments..., first_patch); });
}

simdbezier_status simdbezier_spline_evaluate_samples(
    const simdbezier_patch_set* set, const simdbezier_spline_surface* surface, const double* u,
    size_t u_length, const double* v, size_t v_length, const simdbezier_outputs* out,
    const simdbezier_options* options, size_t first_patch) {
  return evaluate_spline(
      __func__, set, surface, u, u_length, v, v_length, out, options,
      [](std::size_t us, std::size_t /*vs*/) { return us; },
      [&](const auto&... arguments) { return evaluate_samples(arguments..., first_patch); });
}
