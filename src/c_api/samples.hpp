// Where sets are evaluated and what is wanted there: structs of simdbezier.h as C++ has them.
#pragma once

#include <type_traits>

#include <simdbezier/curves.hpp>
#include <simdbezier/outputs.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"

namespace simdbezier::c_api {

inline constexpr Path kOut{"out"};

/// `count` parameters of a grid, which members `name` and `length_name` hold; null: uniform ones.
template <typename T, typename Struct>
const T* grid_parameters(const Given<Struct>& given, const void* first, std::size_t length,
                         std::size_t count, const char* name, const char* length_name) {
  if (first == nullptr) {
    require(length == 0, SIMDBEZIER_NULL_INPUT, given.path / length_name);
    return nullptr;
  }
  require_scalar<T>(given.scalar, given.path);
  require(length >= count, SIMDBEZIER_INPUT_TOO_SMALL, given.path / length_name);
  return numbers_at<T>(first, given.path / name);
}

/// The parameters of single samples.
template <typename T, typename Struct>
std::span<const T> sample_parameters(const Given<Struct>& given, const void* first,
                                     std::size_t length, const char* name) {
  require_scalar<T>(given.scalar, given.path);
  return span_of(numbers_at<T>(first, given.path / name), length, given.path / name);
}

template <typename Struct>
Parameters parameters_of(const Given<Struct>& given) {
  return choice(given.parameters, Parameters::centred, given.path / "parameters");
}

template <typename T>
Grid<T> where_of(const Given<simdbezier_grid>& grid) {
  return {grid.nu,
          grid.nv,
          grid_parameters<T>(grid, grid.u, grid.u_length, grid.nu, "u", "u_length"),
          grid_parameters<T>(grid, grid.v, grid.v_length, grid.nv, "v", "v_length"),
          parameters_of(grid),
          range_of(grid.first_patch, grid.patch_count)};
}
template <typename T>
PatchGrids where_of(const Given<simdbezier_patch_grids>& grids) {
  return {SIMDBEZIER_SPAN(grids, nu),
          SIMDBEZIER_SPAN(grids, nv),
          SIMDBEZIER_SPAN(grids, offset),
          {grids.first_patch, SetRange::kToTheEnd}};
}
template <typename T>
Samples<T> where_of(const Given<simdbezier_samples>& samples) {
  return {SIMDBEZIER_SPAN(samples, patch),
          sample_parameters<T>(samples, samples.u, samples.u_length, "u"),
          sample_parameters<T>(samples, samples.v, samples.v_length, "v"), parameters_of(samples)};
}
template <typename T>
CurveGrid<T> where_of(const Given<simdbezier_curve_grid>& grid) {
  return {grid.n, grid_parameters<T>(grid, grid.t, grid.t_length, grid.n, "t", "t_length"),
          parameters_of(grid), range_of(grid.first_curve, grid.curve_count)};
}
template <typename T>
CurveGrids where_of(const Given<simdbezier_curve_grids>& grids) {
  return {SIMDBEZIER_SPAN(grids, n),
          SIMDBEZIER_SPAN(grids, offset),
          {grids.first_curve, SetRange::kToTheEnd}};
}
template <typename T>
CurveSamples<T> where_of(const Given<simdbezier_curve_samples>& samples) {
  return {SIMDBEZIER_SPAN(samples, curve),
          sample_parameters<T>(samples, samples.t, samples.t_length, "t"), parameters_of(samples)};
}

/// visit(member in C, member in C++, name) for every output of one vector or number a sample.
template <typename Out, typename Visit>
void for_outputs(simdbezier_outputs& known, Out& out, Visit visit) {
  visit(known.position, out.position, "position");
  visit(known.du, out.du, "du");
  visit(known.dv, out.dv, "dv");
  visit(known.duu, out.duu, "duu");
  visit(known.duv, out.duv, "duv");
  visit(known.dvv, out.dvv, "dvv");
  visit(known.normal, out.normal, "normal");
  visit(known.gaussian, out.curvature.gaussian, "gaussian");
  visit(known.mean, out.curvature.mean, "mean");
  visit(known.minimum, out.curvature.minimum, "minimum");
  visit(known.maximum, out.curvature.maximum, "maximum");
}
template <typename Out, typename Visit>
void for_outputs(simdbezier_curve_outputs& known, Out& out, Visit visit) {
  visit(known.position, out.position, "position");
  visit(known.d1, out.d1, "d1");
  visit(known.d2, out.d2, "d2");
  visit(known.tangent, out.tangent, "tangent");
  visit(known.curvature, out.curvature, "curvature");
}
static_assert(kVectorOutputs + kCurvatureKinds == 11 && kCurveVectorOutputs == 4,
              "every output has its row");

/// Outputs of the struct's kind, all of which for_outputs() has read.
template <typename T, typename Struct>
auto outputs_of(const Struct* given) {
  constexpr bool kCurves = std::is_same_v<Struct, simdbezier_curve_outputs>;
  Given<Struct> known = read(given, kOut);
  std::conditional_t<kCurves, CurveOutputs<T>, Outputs<T>> out;
  for_outputs(known, out, [](const auto& from, auto& to, const char* name) {
    to = output_of<T>(from, kOut / name);
  });
  require(known.status != nullptr || known.status_length == 0, SIMDBEZIER_NULL_OUTPUT,
          kOut / "status");
  if (known.status != nullptr) { // SIMDBEZIER_SAMPLE_… and SampleStatus are the same bytes
    out.status = std::span(reinterpret_cast<SampleStatus*>(known.status), known.status_length);
  }
  out.first_component = known.first_component;
  return out;
}

/// What a status of an evaluation is about: the first output that alone is at fault, else all of
/// them, or `where` the samples are.
template <typename Struct, typename Out>
Path blamed_in_evaluation(Status status, const Path& where, const Out& out, std::size_t samples,
                          int components) {
  const Path all = blamed_in_call(status, where);
  if (!all.is_of(kOut) || all.member != nullptr) {
    return all;
  }
  Path blamed = all;
  Struct unread{};
  for_outputs(unread, out, [&](const auto&, const auto& output, const char* name) {
    if (blamed.member == nullptr &&
        is_at_fault(output, status, samples, components - out.first_component)) {
      blamed = blamed_plane(status, kOut / name);
    }
  });
  const bool short_status = blamed.member == nullptr && is_at_fault(out.status, status, samples, 1);
  return short_status ? kOut / "status" : blamed;
}

} // namespace simdbezier::c_api
