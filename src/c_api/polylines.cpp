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

FlattenOptions flatten_options_of(const Given<simdbezier_flatten_options>& known) {
  FlattenOptions options;
  options.tolerance = limit_of(known.tolerance);
  options.tolerances = SIMDBEZIER_SPAN(known, tolerances);
  options.errors = SIMDBEZIER_SPAN(known, errors);
  options.most_points = known.most_points == 0 ? kMostPolylinePoints : known.most_points;
  return options;
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
    const auto known = read(options, kOptions);
    const FlattenOptions how = flatten_options_of(known);
    const std::span<std::uint32_t> to = SIMDBEZIER_ARRAY(points);
    const std::span<double> within = SIMDBEZIER_ARRAY(deviation);
    with_view(read(curves, kCurves), [&](const auto& views) {
      const Report report = choose_polylines(views, how, to, within, {.threads = known.threads});
      require_item(report, [&](Status status) {
        return blamed(status,
                      {{{Status::unequal_lengths}, blamed_length(views.count, how, to.size())},
                       {{Status::bad_tolerance}, blamed_tolerance(how, report.item)}},
                      blamed_curves(status, kCurves));
      });
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
    with_view(read(curves, kCurves), [&](const auto& views) {
      with_scalar(scalar, {"scalar"}, [&]<typename T>() {
        Polylines<T> made = flatten<T>(views, tolerance, how);
        require_item(made.report, [](Status status) {
          return blamed(status, {{{Status::bad_tolerance}, {"tolerance"}}},
                        blamed_curves(status, kCurves));
        });
        give(polylines, std::move(made));
      });
    });
  });
}

void simdbezier_polylines_free(simdbezier_polylines* polylines) { delete polylines; }

simdbezier_status simdbezier_polylines_look(const simdbezier_polylines* polylines,
                                            simdbezier_polyline_arrays* arrays) {
  return look(__func__, polylines, kPolylines, arrays, {"arrays"},
              [](const auto& of) { return arrays_of(of); });
}
