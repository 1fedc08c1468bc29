// The numbers of MeshOptions that say how fine a mesh is to be, and what it joins.
#pragma once

#include <simdbezier/mesh.hpp>

namespace simdbezier::detail {

/// The first of them that has no meaning, by its name there or in a member; null where all have
/// one.
inline const char* meaningless_measure(const MeshOptions& options) noexcept {
  const struct {
    const char* name;
    double value;
    bool may_be_zero;
  } measures[] = {{"tolerance", options.rates.tolerance, false},
                  {"relative_tolerance", options.relative_tolerance, false},
                  {"pixels", options.pixels, false},
                  {"longest_edge", options.rates.longest_edge, false},
                  {"normal_degrees", options.rates.normal_degrees, false},
                  {"point_size", options.topology.point_size, true},
                  {"snap", options.topology.snap, true},
                  {"crease_degrees", options.crease_degrees, true}};
  for (const auto& measure : measures) {
    if (!(measure.value > 0 || (measure.may_be_zero && measure.value == 0))) { // or nan
      return measure.name;
    }
  }
  return nullptr;
}

} // namespace simdbezier::detail
