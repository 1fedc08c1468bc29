// Patches that meet in more than a corner or an edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {

/// All patches, ascending, that have a corner or an edge twice, or that share with another patch
/// more than one corner, or one edge with its ends; and some more near those. Of usual models these
/// are none, so that nothing else needs to ask for what only such patches can be: entangled,
/// repeated, or half of a pillow.
std::vector<std::uint32_t> entanglement_candidates(const TopologyData& topology, int threads);

/// Marks those of the candidates that are as entanglement_candidates() says. All others meet so
/// that no two edges of a mesh can have the same two vertices, whatever the rates.
void mark_entangled(std::span<const std::uint32_t> candidates, TopologyData& topology);

} // namespace simdbezier::detail
