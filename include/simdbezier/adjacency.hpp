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
  bool reversed = false;          ///< … runs the other way; false where both ways are equal
  std::size_t patch = 0;          ///< … of this patch, which may be the same one
  friend bool operator==(const EdgeLink&, const EdgeLink&) = default;
};

/// Finds every edge's counterpart.
///
/// nets:        any number of views; their degrees may differ, and an edge of degree 3 of a 3 x 5
///              patch may match one of a 7 x 3 patch. Patches are numbered consecutively, view
///              after view.
/// edges:       4 values a patch, [4 * patch + PatchEdge]. They may not overlap the memory from the
///              first to the last value of any view; gaps between strided nets belong to it. A
///              shared edge gets the other one. A non_manifold edge gets the next one with the same
///              points, in order of patch and edge, and the last gets the first. For boundary and
///              collapsed edges, edge, reversed and patch are 0.
/// Match:       equal degree and components, and bit-equal control points, weights included, in the
///              same or the opposite order; -0 equals +0, nan is compared by bits. A weight of 1
///              counts as none; the forms of other weights have to be the same. These are the edges
///              along which evaluation is watertight. Collapsed: all points are one, whatever their
///              weights. Cartesian points are one where their coordinates are equal, homogeneous
///              ones where the quotients differ by roundings: by 16 u of the larger of two, in each
///              coordinate, u = 2^-24 or 2^-53.
/// Allocation:  about 30 bytes an edge. Threads: Options::threads, for hashing; other options have
///              no meaning. Determinism: the result is a function of the input.
/// Returns:     ok | null_input | input_too_small | null_output | output_too_small | bad_degree |
///              bad_components | bad_stride | overlapping_outputs | size_overflow | out_of_memory.
///              On an error nothing has been written.
/// Cost:        O(edges) by hashing, some 50 ns an edge, for values that are not made to collide.
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
