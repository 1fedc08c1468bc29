// What a topology marks once it is known which edges and corners are one: patches that meet in more
// than a corner or an edge, corners whose cells have to be cut in one way, and normals that
// disagree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/topology/net_corners.hpp"
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

/// Counts edges along which normals disagree, and turns patches where that is asked for:
/// ok | not_orientable.
Status orient(const TopologyOptions& options, int threads, TopologyData& topology);

/// Marks corners and sides whose normals still disagree with those of the first patch there. Edges
/// of more than two sides are taken as they are: no rule says which of their sides belong together.
void mark_apart(TopologyData& topology);

} // namespace simdbezier::detail
