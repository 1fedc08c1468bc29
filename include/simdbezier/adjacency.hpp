// Which edges of a set of patches are the same: bit-equal control points, in either direction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/patch_edge.hpp>
#include <simdbezier/status.hpp>
#include <simdbezier/vectors.hpp>

namespace simdbezier {

enum class EdgeKind : std::uint8_t {
  boundary,     ///< no other edge has these control points
  shared,       ///< exactly one other has
  non_manifold, ///< more than one other has
  collapsed     ///< all control points are one; never matched with another edge
};

/// What one edge of one patch is.
struct EdgeLink {
  EdgeKind kind = EdgeKind::boundary;
  PatchEdge edge = PatchEdge::v0; ///< the matching edge …
  bool reversed = false;          ///< … runs the other way; false if both ways are equal
  std::size_t patch = 0;          ///< … of this patch, which may be the same one
  friend bool operator==(const EdgeLink&, const EdgeLink&) = default;
};

/// Finds the counterpart of every edge of every patch. Meshes take find_topology() instead.
/// nets:      any number of views; their degrees may differ, and an edge of degree 3 of a 3 x 5
///            patch may match one of a 7 x 3 patch. Patches are numbered through, view after view.
/// edges:     [4 * patch + PatchEdge]; may not overlap the memory from the first to the last value
///            of any view, gaps included. A shared edge gets the other one. A non_manifold edge
///            gets the next one with the same points, in order of patch and edge, the last the
///            first. edge, reversed and patch of boundary and collapsed edges are 0.
/// Match:     equal degree and components, and bit-equal control points, weights included, in the
///            same or the opposite order; -0 equals +0, nan is compared by bits. A weight of 1
///            counts as none; other weights must have the same form. Such edges are watertight.
/// Collapsed: all points are one, whatever their weights: Cartesian ones if their coordinates are
///            equal, homogeneous ones also if their quotients differ by roundings, 16 u of the
///            larger of two in each coordinate (u = 2^-24 or 2^-53).
/// Options:   only threads counts. Allocation: about 30 bytes an edge. Determinism: a function of
///            the input.
/// Returns:   ok | the statuses of views | null_output | output_too_small | overlapping_outputs |
///            out_of_memory.
/// Cost:      O(edges) by hashing, some 50 ns an edge, for values that are not made to collide.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status find_adjacency(std::span<const ControlNets<S>> nets,
                                                   Values<EdgeLink> edges,
                                                   const Options& options = {}) noexcept;

template <typename S>
[[nodiscard]] Status find_adjacency(const ControlNets<S>& nets, Values<EdgeLink> edges,
                                    const Options& options = {}) noexcept {
  return find_adjacency(std::span<const ControlNets<S>>(&nets, 1), edges, options);
}

} // namespace simdbezier
