// Polylines of simdbezier.h.
#include <algorithm>

#include <simdbezier/flatten.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kCurves{"curves"};
constexpr Path kPolylines{"polylines"};

static_assert(std::uint32_t{SIMDBEZIER_MOST_POLYLINE_POINTS} == kMostPolylinePoints);

FlattenOptions flatten_options_of(const simdbezier_flatten_options* given) {
  const simdbezier_flatten_options known = read(given, kOptions);
  FlattenOptions options;
  options.tolerance = known.tolerance;
  options.tolerances = span_of(known.tolerances, known.tolerances_length, kOptions / "tolerances");
  options.errors = span_of(known.errors, known.errors_length, kOptions / "errors");
  options.most_points = known.most_points == 0 ? kMostPolylinePoints : known.most_points;
  return options;
}

/// body.operator()<S>(curves) with the caller's curves, S being their type.
template <typename Body>
void with_curves(const simdbezier_control_curves* given, Body body) {
  const simdbezier_control_curves known = read(given, kCurves);
  with_scalar(known.scalar, kCurves / "scalar",
              [&]<typename S>() { body(curves_of<S>(known, kCurves)); });
}

/// The first of the spans that is not one value a curve.
Path blamed_length(std::size_t curves, const FlattenOptions& options, std::size_t points) {
  if (!is_one_each(options.tolerances, curves)) {
    return kOptions / "tolerances";
  }
  if (!is_one_each(options.errors, curves)) {
    return kOptions / "errors";
  }
  return {points != curves ? "points" : "deviation"};
}

simdbezier_polyline_arrays arrays_of(const auto& lines) noexcept {
  simdbezier_polyline_arrays known{};
  known.scalar = kScalar<typename decltype(lines.points)::value_type::value_type>;
  known.curves = lines.first.size() - 1;
  known.vertices = lines.points.size();
  known.points = first_of(lines.points);
  known.first = first_of(lines.first);
  known.deviation = lines.deviation;
  return known;
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_choose_polylines(const simdbezier_control_curves* curves,
                                              const simdbezier_flatten_options* options,
                                              uint32_t* points, size_t points_length,
                                              double* deviation, size_t deviation_length) {
  return answer(__func__, [&] {
    const FlattenOptions how = flatten_options_of(options);
    const RunOptions run{.threads = read(options, kOptions).threads};
    const std::span<std::uint32_t> to = span_of(points, points_length, {"points"});
    const std::span<double> within = span_of(deviation, deviation_length, {"deviation"});
    with_curves(curves, [&](const auto& views) {
      const Report report = choose_polylines(views, how, to, within, run);
      const auto path_of = [&](Status status) {
        switch (status.code()) {
        case Status::unequal_lengths:
          return blamed_length(views.count, how, to.size());
        case Status::bad_tolerance:
          return blamed_tolerance(how, report.item);
        default:
          return blamed_curves(status, kCurves);
        }
      };
      if (!report) {
        throw Fault{code_of(report.status), path_of(report.status), report.item, -1};
      }
    });
  });
}

simdbezier_status simdbezier_flatten(const simdbezier_control_curves* curves,
                                     simdbezier_scalar scalar, double tolerance,
                                     const simdbezier_options* options,
                                     simdbezier_polylines** polylines) {
  return answer(__func__, [&] {
    require_place(polylines, kPolylines);
    const Options how = call_options_of(options);
    with_curves(curves, [&](const auto& views) {
      with_scalar(scalar, {"scalar"}, [&]<typename T>() {
        Polylines<T> made = flatten<T>(views, tolerance, how);
        if (!made) {
          const bool toleranced = made.report.status == Status::bad_tolerance;
          throw Fault{code_of(made.report.status),
                      toleranced ? Path{"tolerance"} : blamed_curves(made.report.status, kCurves),
                      made.report.item, -1};
        }
        give(polylines, std::move(made));
      });
    });
  });
}

void simdbezier_polylines_free(simdbezier_polylines* polylines) { delete polylines; }

simdbezier_status simdbezier_polylines_look(const simdbezier_polylines* polylines,
                                            simdbezier_polyline_arrays* arrays) {
  return answer(__func__, [&] {
    require_writable(arrays, {"arrays"});
    with_object(polylines, kPolylines, [&](const auto& of) { write(arrays, arrays_of(of)); });
  });
}
