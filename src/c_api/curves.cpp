// Curves of simdbezier.h.
#include <simdbezier/curves.hpp>

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

simdbezier_status simdbezier_iso_u(const simdbezier_patch_set* patches, double u0,
                                   const simdbezier_pack_options* options,
                                   simdbezier_curve_set** curves) {
  return iso_curves(__func__, patches, "u0", options, curves,
                    [&](const auto& set, auto& made, const PackOptions& how) {
                      return iso_u(set, u0, made, how);
                    });
}

simdbezier_status simdbezier_iso_v(const simdbezier_patch_set* patches, double v0,
                                   const simdbezier_pack_options* options,
                                   simdbezier_curve_set** curves) {
  return iso_curves(__func__, patches, "v0", options, curves,
                    [&](const auto& set, auto& made, const PackOptions& how) {
                      return iso_v(set, v0, made, how);
                    });
}

simdbezier_status simdbezier_iso_u_points(const simdbezier_nets* nets, double u0, double* points,
                                          size_t length, const simdbezier_options* options) {
  return iso_points(__func__, nets, "u0", points, length, options,
                    [&](const auto& views, const Values<double>& out, const Options& how) {
                      return iso_u(views, u0, out, how);
                    });
}

simdbezier_status simdbezier_iso_v_points(const simdbezier_nets* nets, double v0, double* points,
                                          size_t length, const simdbezier_options* options) {
  return iso_points(__func__, nets, "v0", points, length, options,
                    [&](const auto& views, const Values<double>& out, const Options& how) {
                      return iso_v(views, v0, out, how);
                    });
}
