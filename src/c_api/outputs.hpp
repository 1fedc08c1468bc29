// simdbezier_outputs as the library has them.
#pragma once

#include <simdbezier/outputs.hpp>

#include "src/c_api/views.hpp"

namespace simdbezier::c_api {

/// The vector outputs in the order of Output.
inline constexpr simdbezier_vectors simdbezier_outputs::*kVectorMembers[] = {
    &simdbezier_outputs::position, &simdbezier_outputs::du,  &simdbezier_outputs::dv,
    &simdbezier_outputs::duu,      &simdbezier_outputs::duv, &simdbezier_outputs::dvv,
    &simdbezier_outputs::normal};
static_assert(std::size(kVectorMembers) == kVectorOutputs, "every vector output has its member");

inline constexpr simdbezier_values simdbezier_outputs::*kCurvatureMembers[] = {
    &simdbezier_outputs::gaussian, &simdbezier_outputs::mean, &simdbezier_outputs::minimum,
    &simdbezier_outputs::maximum};
static_assert(std::size(kCurvatureMembers) == kCurvatureKinds);

template <typename T>
Outputs<T> outputs_of(const simdbezier_outputs* given) {
  const Path path{"out"};
  const simdbezier_outputs known = read(given, path);
  Outputs<T> out;
  for (std::size_t k = 0; k < kVectorOutputs; ++k) {
    const auto output = static_cast<Output>(k);
    out[output] = vectors_of<T>(known.*kVectorMembers[k], path / output_name(output));
  }
  for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
    const auto curvature = static_cast<Curvature>(k);
    out.curvature[curvature] =
        values_of<T>(known.*kCurvatureMembers[k], path / output_name(curvature));
  }
  out.status = sample_statuses(known.status, known.status_length, path);
  out.first_component = known.first_component;
  return out;
}

} // namespace simdbezier::c_api
