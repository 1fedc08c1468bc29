// Curves of simdbezier.h.
#include <simdbezier/curves.hpp>

#include "src/c_api/evaluate_set.hpp"
#include "src/nets/net_call.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kGrid{"grid"};
constexpr Path kGrids{"grids"};
constexpr Path kSamples{"samples"};
constexpr Path kOut{"out"};

static_assert(SIMDBEZIER_EDGE_U1 == static_cast<int>(PatchEdge::u1));

/// The vector outputs in the order of CurveOutput.
constexpr simdbezier_vectors simdbezier_curve_outputs::*kVectors[] = {
    &simdbezier_curve_outputs::position, &simdbezier_curve_outputs::d1,
    &simdbezier_curve_outputs::d2, &simdbezier_curve_outputs::tangent};
static_assert(std::size(kVectors) == kCurveVectorOutputs, "every vector output has its member");

template <typename T>
CurveOutputs<T> outputs_of(const simdbezier_curve_outputs* given) {
  const simdbezier_curve_outputs known = read(given, kOut);
  CurveOutputs<T> out;
  for (std::size_t k = 0; k < kCurveVectorOutputs; ++k) {
    const auto output = static_cast<CurveOutput>(k);
    out[output] = vectors_of<T>(known.*kVectors[k], kOut / output_name(output));
  }
  out.curvature = values_of<T>(known.curvature, kOut / "curvature");
  out.status = sample_statuses(known.status, known.status_length, kOut);
  out.first_component = known.first_component;
  return out;
}

template <typename T>
CurveGrid<T> where_of(const simdbezier_curve_grid* given) {
  const simdbezier_curve_grid known = read(given, kGrid);
  return {
      known.n,
      grid_parameters<T>(known.t, known.t_length, known.n, known.scalar, kGrid, {"t", "t_length"}),
      parameters_of(known.parameters, kGrid), range_of(known.first_curve, known.curve_count)};
}

template <typename T>
CurveGrids where_of(const simdbezier_curve_grids* given) {
  const simdbezier_curve_grids known = read(given, kGrids);
  return {span_of(known.n, known.n_length, kGrids / "n"),
          span_of(known.offset, known.offset_length, kGrids / "offset"),
          {known.first_curve, SetRange::kToTheEnd}};
}

template <typename T>
CurveSamples<T> where_of(const simdbezier_curve_samples* given) {
  const simdbezier_curve_samples known = read(given, kSamples);
  return {span_of(known.curve, known.curve_length, kSamples / "curve"),
          sample_parameters<T>(known.t, known.t_length, known.scalar, kSamples, "t"),
          parameters_of(known.parameters, kSamples)};
}

template <typename Where>
simdbezier_status evaluate_at(const char* function, const simdbezier_curve_set* set,
                              const Where* given, const Path& path,
                              const simdbezier_curve_outputs* out,
                              const simdbezier_options* options) noexcept {
  return evaluate_set(function, set, path, options, [&]<typename T>(std::type_identity<T>) {
    return SetCall{where_of<T>(given), outputs_of<T>(out)};
  });
}

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
    const Path path{"nets"};
    const simdbezier_nets given = read(nets, path);
    const Values<double> out = span_of(points, length, {"points"});
    const Options how = call_options_of(options);
    with_scalar(given.scalar, path / "scalar", [&]<typename S>() {
      const Report report = call(nets_of<S>(given, path), out, how);
      require_ok(report, [&](Status status) {
        if (status == Status::non_finite_input && report.point < 0) {
          return Path{parameter};
        }
        const bool about_points = status == Status::null_output ||
                                  status == Status::output_too_small ||
                                  status == Status::overlapping_outputs;
        return about_points ? Path{"points"} : blamed_nets(status, path);
      });
    });
  });
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_evaluate_curve_grid(const simdbezier_curve_set* set,
                                                 const simdbezier_curve_grid* grid,
                                                 const simdbezier_curve_outputs* out,
                                                 const simdbezier_options* options) {
  return evaluate_at(__func__, set, grid, kGrid, out, options);
}

simdbezier_status simdbezier_evaluate_curve_grids(const simdbezier_curve_set* set,
                                                  const simdbezier_curve_grids* grids,
                                                  const simdbezier_curve_outputs* out,
                                                  const simdbezier_options* options) {
  return evaluate_at(__func__, set, grids, kGrids, out, options);
}

simdbezier_status simdbezier_evaluate_curve_samples(const simdbezier_curve_set* set,
                                                    const simdbezier_curve_samples* samples,
                                                    const simdbezier_curve_outputs* out,
                                                    const simdbezier_options* options) {
  return evaluate_at(__func__, set, samples, kSamples, out, options);
}

size_t simdbezier_curve_grid_sample_count(const simdbezier_curve_set* set,
                                          const simdbezier_curve_grid* grid) {
  return samples_at(set, [&]<typename T>(std::type_identity<T>) { return where_of<T>(grid); });
}

size_t simdbezier_curve_grids_sample_count(const simdbezier_curve_set* set,
                                           const simdbezier_curve_grids* grids) {
  return samples_at(set, [&]<typename T>(std::type_identity<T>) { return where_of<T>(grids); });
}

simdbezier_status simdbezier_boundary_curves(const simdbezier_nets* nets, simdbezier_edge edge,
                                             simdbezier_control_curves* curves) {
  return answer(__func__, [&] {
    const Path path{"nets"};
    const simdbezier_nets given = read(nets, path);
    const auto which = choice(edge, PatchEdge::u1, {"edge"});
    require_writable(curves, {"curves"});
    with_scalar(given.scalar, path / "scalar", [&]<typename S>() {
      const ControlNets<S> view = nets_of<S>(given, path);
      require_ok(detail::check_input(view),
                 [&](Status status) { return blamed_nets(status, path); });
      const ControlCurves<S> of = boundary_curves(view, which);
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
