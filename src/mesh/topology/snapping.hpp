// Open sides that match nearly, and what that moves.
#pragma once

#include <cstddef>
#include <vector>

#include "src/mesh/topology/net_corners.hpp"
#include "src/nets/edge_rings.hpp"

namespace simdbezier::detail {

/// At least the largest distance between points of two sides at equal parameters; infinite where
/// they cannot be compared. The proof stands in docs/tessellation.md: with one degree and one scale
/// of weights, that is the largest distance of control points, and the largest relative difference
/// of weights times the size of the curves.
[[nodiscard]] double distance_of(const SideNet& a, const SideNet& b, bool reversed);

/// Links open sides in pairs, those closest to each other first, where points at equal parameters,
/// from the same or from opposite ends, are certainly within a distance of each other. Open sides
/// that match a point become points. Returns how many sides were linked.
template <typename S>
std::size_t snap_sides(const NetCorners<S>& nets, double distance, EdgeRings& rings);

/// How far a side may be from what it is joined with: the first side of its edge, or, where it
/// counts as a point, the vertices at its ends. nan, or infinite, where a value is no number.
template <typename S>
double distance_from_joint(const NetCorners<S>& nets, const TopologyData& topology,
                           std::size_t side);
/// How far the vertices of each patch may lie from where its own corners and edges would put them.
template <typename S>
std::vector<double> find_displacements(const NetCorners<S>& nets, const TopologyData& topology);

} // namespace simdbezier::detail
