// Finds where cells at a patch's corners and edges must be cut in one way, or must be more than
// one.
#pragma once

#include <cstdint>
#include <span>

#include "src/mesh/topology/net_corners.hpp"
#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {

/// Where a mesh would be wrong near a corner if a diagonal cut it off: at corners where patches
/// would have the same triangle; between a side that is a point and one that is not, where a
/// polygon would be left between a curve and its chord; where both sides leave in one direction,
/// and the triangle would have no area.
/// Repeated patches have to be known. doubts: of nets. candidates: as of entanglement_candidates(),
/// since patches with the same triangle share more than an edge, and a point leaves a patch with
/// fewer than four corners.
template <typename S>
void mark_corners(const NetCorners<S>& nets, std::span<const std::uint8_t> doubts,
                  std::span<const std::uint32_t> candidates, TopologyData& topology);

/// Finds TopologyData::loops. doubts: of nets.
template <typename S>
void mark_loops(const NetCorners<S>& nets, std::span<const std::uint8_t> doubts,
                TopologyData& topology);

} // namespace simdbezier::detail
