// Curves and polylines of simdbezier.h.
#include <simdbezier/curves.hpp>
#include <simdbezier/flatten.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"
#include "src/nets/net_call.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kNets{"nets"};

static_assert(SIMDBEZIER_EDGE_U1 == static_cast<int>(PatchEdge::u1));

/// iso_u() or iso_v() of a set.
template <typename Call>
simdbezier_status iso_curves(const char* function, const simdbezier_patch_set* patches,
                             const char* parameter, const simdbezier_pack_options* options,
                             simdbezier_curve_set** curves, Call call) noexcept {
  return answer(function, [&] {
    require_place(curves, {"curves"});
    const PackOptions how = pack_options_of(options);
    with_object(patches, {"patches"}, [&]<typename T>(const PatchSet<T>& set) {
      CurveSet<T> made;
      require_ok(call(set, made, how), [&](Status status) -> Path {
        if (status == Status::unsupported_isa) {
          return kOptions / "isa";
        }
        return {status == Status::non_finite_input ? parameter : "patches"};
      });
      give(curves, std::move(made));
    });
  });
}

/// iso_u() or iso_v() of nets.
template <typename Call>
simdbezier_status iso_points(const char* function, const simdbezier_nets* nets,
                             const char* parameter, double* points, std::size_t length,
                             const simdbezier_options* options, Call call) noexcept {
  return answer(function, [&] {
    const auto given = read(nets, kNets);
    const Values<double> out = span_of(points, length, {"points"});
    const Options how = call_options_of(options);
    with_view(given, [&](const auto& view) {
      const Report report = call(view, out, how);
      require_ok(report, [&](Status status) {
        const bool at_fault = status == Status::non_finite_input && report.point < 0;
        return at_fault ? Path{parameter}
                        : blamed(status, {{kOutputFaults, {"points"}}}, blamed_nets(status, kNets));
      });
    });
  });
}

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

simdbezier_status simdbezier_boundary_curves(const simdbezier_nets* nets, simdbezier_edge edge,
                                             simdbezier_control_curves* curves) {
  return answer(__func__, [&] {
    const auto given = read(nets, kNets);
    const auto which = choice(edge, PatchEdge::u1, {"edge"});
    require_writable(curves, {"curves"});
    with_view(given, [&](const auto& view) {
      require_ok(detail::check_input(view),
                 [&](Status status) { return blamed_nets(status, kNets); });
      const auto of = boundary_curves(view, which);
      simdbezier_control_curves known{};
      known.points = given.points;
      known.length = given.length;
      known.first = view.points == nullptr ? 0 : given.first + (of.points - view.points);
      known.count = of.count;
      known.curve_stride = of.curve_stride;
      known.point_stride = of.point_stride;
      known.component_stride = of.component_stride;
      known.degree = of.degree;
      known.components = of.components;
      known.weights = given.weights;
      known.scalar = given.scalar;
      write(curves, known);
    });
  });
}

#define SIMDBEZIER_ISO(u, parameter)                                                               \
  simdbezier_status simdbezier_iso_##u(const simdbezier_patch_set* patches, double parameter,      \
                                       const simdbezier_pack_options* options,                     \
                                       simdbezier_curve_set** curves) {                            \
    return iso_curves(__func__, patches, #parameter, options, curves,                              \
                      [&](const auto& set, auto& made, const PackOptions& how) {                   \
                        return iso_##u(set, parameter, made, how);                                 \
                      });                                                                          \
  }                                                                                                \
  simdbezier_status simdbezier_iso_##u##_points(const simdbezier_nets* nets, double parameter,     \
                                                double* points, size_t length,                     \
                                                const simdbezier_options* options) {               \
    return iso_points(__func__, nets, #parameter, points, length, options,                         \
                      [&](const auto& view, const Values<double>& out, const Options& how) {       \
                        return iso_##u(view, parameter, out, how);                                 \
                      });                                                                          \
  }
SIMDBEZIER_ISO(u, u0)
SIMDBEZIER_ISO(v, v0)

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
