// Open sides that match nearly, and what that moves.
#pragma once

#include "src/mesh/topology/net_corners.hpp"
#include "src/nets/edge_rings.hpp"

namespace simdbezier::detail {

/// Links open sides in pairs: those closest to each other first, where control points are within a
/// distance, one by one in the same or the opposite order, and weights are equal. Returns how many
/// sides were linked.
template <typename S>
std::size_t snap_sides(const NetCorners<S>& nets, double distance, EdgeRings<std::uint32_t>& rings);

/// How far the vertices of each patch may lie from where its own corners and edges would put them.
template <typename S>
void find_displacements(const NetCorners<S>& nets, TopologyData& topology);

} // namespace simdbezier::detail
