// Patches that meet in more than a corner or an edge.
#pragma once

#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {

/// Marks every patch that has a corner or an edge twice, or that shares with another patch more
/// than one corner, or one edge with its ends. All others meet so that no two edges of a mesh can
/// have the same two vertices, whatever the rates.
void mark_entangled(TopologyData& topology);

} // namespace simdbezier::detail
