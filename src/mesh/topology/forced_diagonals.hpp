// Finds where cells at a patch's corners and edges must be cut in one way, or must be more than
// one.
#pragma once

#include "src/mesh/topology/net_corners.hpp"
#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {

/// Where a mesh would be wrong near a corner if a diagonal cut it off: at corners where patches
/// would have the same triangle; between a side that is a point and one that is not, where a
/// polygon would be left between a curve and its chord; where both sides leave in one direction,
/// and the triangle would have no area.
/// Repeated patches have to be known.
template <typename S>
void mark_corners(const NetCorners<S>& nets, TopologyData& topology);

/// Finds TopologyData::loops.
template <typename S>
void mark_loops(const NetCorners<S>& nets, TopologyData& topology);

} // namespace simdbezier::detail
