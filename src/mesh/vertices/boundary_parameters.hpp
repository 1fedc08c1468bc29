// u, v and patch of vertices on boundaries.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/mesh/topology/topology_data.hpp"
#include "src/mesh/vertices/vertex_target.hpp"

namespace simdbezier::detail {

/// Writes those of a patch's corner, 4 * patch + corner, to index `at`. A side that is a point has
/// all parameters from 0 to 1, whose middle is near to all.
template <typename T>
void put_corner_parameters(const TopologyData& topology, std::uint32_t corner, std::size_t at,
                           const ParameterOutputs<T>& to) noexcept {
  const std::size_t patch = corner / kPatchCorners;
  const Side* const sides = &topology.sides[kPatchEdges * patch];
  const T u = sides[corner % 4 / 2].collapsed() ? T(0.5) : T(corner % 2);
  const T v = sides[2 + corner % 2].collapsed() ? T(0.5) : T(corner % 4 / 2);
  to.put(at, static_cast<std::uint32_t>(patch), u, v);
}

/// Writes those of the point numerator / denominator of a side's edge, in the edge's direction.
template <typename T>
void put_side_parameters(const TopologyData& topology, std::uint32_t side, std::uint32_t numerator,
                         std::uint32_t denominator, std::size_t at,
                         const ParameterOutputs<T>& to) noexcept {
  const std::uint32_t along = topology.sides[side].reversed() ? denominator - numerator : numerator;
  const T t = static_cast<T>(along) / static_cast<T>(denominator);
  const T end = T(side % 2);
  to.put(at, side / 4, runs_in_u(side) ? t : end, runs_in_u(side) ? end : t);
}

} // namespace simdbezier::detail
