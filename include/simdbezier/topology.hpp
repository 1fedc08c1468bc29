// How the patches of a model are connected: which edges and corners they share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/outputs.hpp>
#include <simdbezier/patch_set.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier {

namespace detail {
struct TopologyData;
}

/// What a model is made of. A side is an edge of one patch; sides with equal control points,
/// compared as by find_adjacency(), are one edge of the model.
struct TopologyCounts {
  std::size_t patches = 0;
  std::size_t edges = 0;              ///< collapsed ones are not counted
  std::size_t open_edges = 0;         ///< edges of one side
  std::size_t non_manifold_edges = 0; ///< edges of more than two sides
  std::size_t collapsed_sides = 0;    ///< sides that are a point
  std::size_t corners = 0;            ///< different corners
  /// Patches with all control points of an earlier one, whichever way round.
  std::size_t repeated_patches = 0;
  /// Edges of two sides along which the patches' normals disagree, as the patches are given.
  std::size_t turned_edges = 0;
  std::size_t snapped_sides = 0; ///< sides that became one with another by TopologyOptions::snap
  /// Whether patches can be turned so that no turned edge remains.
  bool orientable = true;
};

/// How edges are joined.
struct TopologyOptions {
  /// A side whose control points all lie within this distance of both of its ends counts as a
  /// point, with all sides that share its edge. 0: only if they are one point (find_adjacency()).
  double point_size = 0;
  /// Turns each patch that disagrees with the lowest one of its connected part, so that the normals
  /// of neighbours agree. false: all patches stay as they are given.
  bool orient = false;
  /// Turns all patches after that: triangles run, and normals point, the other way.
  bool flip = false;
  /// Joins pairs of open sides to one edge, in either direction, the closest first, if points of
  /// equal parameters are certainly within this distance of each other. A mesh then has the points
  /// of the lower side. The bound compares control points and weights after degrees have been
  /// raised to the higher one, and weights divided by the largest (docs/tessellation.md). Sides
  /// that are no longer than this, and open sides that match a point, become points. 0: only sides
  /// with equal control points are one.
  double snap = 0;
};

/// Which edges and corners the patches of a set share. Immutable; copies share the data.
class Topology {
public:
  Topology() noexcept = default;

  [[nodiscard]] SIMDBEZIER_API TopologyCounts counts() const noexcept;
  /// The same for some patches: edges and corners count for the lowest patch that has them, so that
  /// sums over all parts of a model are the model's. snapped_sides and `orientable` are those of
  /// all patches. Zeros if there are no such patches.
  [[nodiscard]] SIMDBEZIER_API TopologyCounts counts(SetRange patches) const noexcept;
  /// Whether a patch is turned (TopologyOptions::orient, flip).
  [[nodiscard]] SIMDBEZIER_API bool is_turned(std::size_t patch) const noexcept;
  /// Whether a patch has all control points of an earlier one.
  [[nodiscard]] SIMDBEZIER_API bool is_repeated(std::size_t patch) const noexcept;
  /// Whether a patch shares corners with another patch, or with itself, without a common edge that
  /// explains this. separate_vertices() may have to raise its rates, depending on its neighbours.
  [[nodiscard]] SIMDBEZIER_API bool is_entangled(std::size_t patch) const noexcept;

  /// This is for the library's own use.
  [[nodiscard]] const detail::TopologyData* data() const noexcept { return data_.get(); }
  explicit Topology(std::shared_ptr<const detail::TopologyData> data) noexcept
      : data_(std::move(data)) {}

private:
  std::shared_ptr<const detail::TopologyData> data_;
};

/// Joins the edges of all patches with equal control points (find_adjacency()), and their corners,
/// as meshes need them. Corners are joined through edges, not by their positions: corners that
/// touch only in a point stay apart. An edge may have any number of sides.
/// nets:    any views with three components; patches are numbered through, view after view.
/// Threads: a single one joins distant corners, snaps sides, and finds repeated patches.
///          Allocation: about 60 bytes a side. Determinism: a function of the control points and
///          options.
/// Cost:    some 0.2 to 0.7 us a patch. If thousands of patches have the same four edges, or nan
///          among their values, the cost grows with the square of their number.
/// Returns: ok | the statuses of views (bad_components: not three) | bad_tolerance (a point_size or
///          snap below 0, or nan) | not_orientable (if `orient` is asked for) | size_overflow (2^29
///          patches and more) | out_of_memory.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status find_topology(std::span<const ControlNets<S>> nets,
                                                  Topology& topology,
                                                  const TopologyOptions& options = {},
                                                  const RunOptions& run = {}) noexcept;

template <typename S>
[[nodiscard]] Status find_topology(const ControlNets<S>& nets, Topology& topology,
                                   const TopologyOptions& options = {},
                                   const RunOptions& run = {}) noexcept {
  return find_topology(std::span<const ControlNets<S>>(&nets, 1), topology, options, run);
}

/// The patches of a model that repeat no earlier one.
template <typename S>
struct DistinctNets {
  std::vector<ControlNets<S>> nets;   ///< in the memory of the views that they come from
  std::vector<std::uint32_t> patches; ///< the number of each patch there
};

/// Leaves out the patches that Topology::is_repeated() names. What remains is a model of its own,
/// for which find_topology() has to be called again, since its patches have other numbers.
/// nets:    those of `topology`. A view ends before a patch that is left out, and another one
///          begins behind it.
/// Threads: one. Allocation: 4 bytes a patch, and the views. Cost: some nanoseconds a patch.
/// Returns: ok | null_input (no list) | size_overflow | unequal_lengths (other number of patches) |
///          out_of_memory.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status find_distinct_nets(std::span<const ControlNets<S>> nets,
                                                       const Topology& topology,
                                                       DistinctNets<S>& distinct) noexcept;

/// Whether nets have all joints of a topology that was found for others of the same shapes, such as
/// an earlier frame of a model that moves: sides that it joins still have equal control points or
/// are within TopologyOptions::snap of each other. Sides that it takes for points still are points,
/// within point_size or snap. Sides that matched a point are no farther from it than they were
/// then. Meshes of such nets have no gap there. Sides that have become equal since then are not
/// looked for. choose_rates() and certify_rates() refuse nets that do not fit.
/// Allocation: some bytes a view. Cost: some 40 ns a patch; 1 us if snapped.
/// Determinism: a function of the topology and the control points.
/// Returns: false also if find_topology() would refuse the nets, or memory is lacking.
template <typename S>
[[nodiscard]] SIMDBEZIER_API bool fits(const Topology& topology,
                                       std::span<const ControlNets<S>> nets,
                                       const RunOptions& options = {}) noexcept;

template <typename S>
[[nodiscard]] bool fits(const Topology& topology, const ControlNets<S>& nets,
                        const RunOptions& options = {}) noexcept {
  return fits(topology, std::span<const ControlNets<S>>(&nets, 1), options);
}

// Which edges of a set of patches are the same: bit-equal control points, in either direction.

enum class EdgeKind : std::uint8_t {
  boundary,     ///< no other edge has these control points
  shared,       ///< exactly one other has
  non_manifold, ///< more than one other has
  collapsed     ///< all control points are one; never matched with another edge
};

/// What one edge of one patch is.
struct EdgeLink {
  EdgeKind kind = EdgeKind::boundary;
  PatchEdge edge = PatchEdge::v0; ///< the matching edge
  bool reversed = false;          ///< whether that runs the other way; false if both ways are equal
  std::size_t patch = 0;          ///< its patch, which may be the same one
  friend bool operator==(const EdgeLink&, const EdgeLink&) = default;
};

/// Finds the counterpart of every edge of every patch. Meshes take find_topology() instead.
/// nets:      views of any degrees: an edge of degree 3 of a 3 x 5 patch may match one of a 7 x 3
///            patch. Patches are numbered through, view after view.
/// edges:     [4 * patch + PatchEdge]; may not overlap the memory from the first to the last value
///            of any view, gaps included. A shared edge gets its counterpart. A non_manifold edge
///            gets the next one with the same points, in order of patch and edge; the last of them
///            gets the first. edge, reversed and patch of boundary and collapsed edges are 0.
/// Match:     equal degree and components, and bit-equal control points, weights included, in the
///            same or the opposite order; -0 equals +0, nan is compared by bits. A weight of 1
///            counts as none; other weights must have the same form. Such edges are watertight.
/// Collapsed: all points are one, whatever their weights: Cartesian ones if their coordinates are
///            equal, homogeneous ones also if no coordinate of their quotients differs by more than
///            16 u of the largest coordinate of them all (u = 2^-24 or 2^-53). Of points with more
///            than three components, each component counts by itself.
/// Returns:   ok | the statuses of views (also size_overflow: 2^30 patches or more) | null_output |
///            output_too_small | overlapping_outputs | out_of_memory.
/// Cost:      by hashing, some 50 ns an edge, for values that are not made to collide. Allocation:
///            about 30 bytes an edge. Determinism: a function of the input.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status find_adjacency(std::span<const ControlNets<S>> nets,
                                                   Values<EdgeLink> edges,
                                                   const RunOptions& options = {}) noexcept;

template <typename S>
[[nodiscard]] Status find_adjacency(const ControlNets<S>& nets, Values<EdgeLink> edges,
                                    const RunOptions& options = {}) noexcept {
  return find_adjacency(std::span<const ControlNets<S>>(&nets, 1), edges, options);
}

// Patches cut at corners of neighbours that lie on their sides, so that one long edge against
// several short ones becomes several pairs of edges.

/// How edges are split.
struct SplitOptions {
  /// How near a part of a long edge has to be to the short one, as TopologyOptions::snap measures
  /// it. Roundings are allowed in any case: 64 (n + 1) u of the largest coordinate of all control
  /// points, n being the largest degree and u = 2^-24 (float) or 2^-53 (double).
  double snap = 0;
  /// The most patches and pieces in all; cuts that lead to more are not made. 0: 8 times the
  /// patches given, at least 512.
  std::size_t most_pieces = 0;
};

/// Where a piece of a patch comes from.
struct PatchPiece {
  std::uint32_t patch = 0; ///< among those given
  double u0 = 0;           ///< the piece is the patch over [u0, u1] x [v0, v1]
  double u1 = 1;
  double v0 = 0;
  double v1 = 1;
  double error = 0; ///< how far cutting may have moved any of its points, by roundings

  /// The parameters of the patch at u or v of the piece.
  [[nodiscard]] constexpr double whole_u(double u) const noexcept { return between(u0, u1, u); }
  [[nodiscard]] constexpr double whole_v(double v) const noexcept { return between(v0, v1, v); }

private:
  static constexpr double between(double from, double to, double place) noexcept {
    return place == 1 ? to : from + (to - from) * place;
  }
};

/// How many short edges lie along a part of a longer one, and what came of them.
struct SplitCounts {
  std::size_t splits = 0;   ///< edges that patches were cut for
  std::size_t unjoined = 0; ///< edges that stay open
  double largest_gap = 0;   ///< at least the distance of each open one from the longer edge
};

/// Patches of which some are pieces of those given.
template <typename S>
struct SplitNets {
  std::vector<ControlNets<S>> nets; ///< in the memory of those given, and in `memory`
  std::vector<PatchPiece> pieces;   ///< of each patch of `nets`, in the order of the patches given
  std::vector<std::shared_ptr<const std::vector<S>>> memory;
  double snap = 0; ///< for TopologyOptions: joins what was split for
  SplitCounts counts;
};

/// Cuts patches at the corners of others that lie on their open sides, if the part of the side
/// between two such corners is the side of another patch. A cut divides the opposite side as well.
/// It therefore goes on through the patches across, until it comes to an open side, a side that is
/// a point, or the patch where it began. This is repeated until nothing is found. If nothing is
/// cut, SplitNets::nets are those given.
/// Gap:     a short edge counts as unjoined if it stays open although a part of another edge is at
///          most 1/32 of its size away, or if cuts for it would lead to more pieces than allowed.
/// Cost:    that of find_topology() each time, and microseconds for each open side that lies in the
///          box of another one.
/// Returns: as find_topology(), and the statuses of segment() for patches that are to be cut. Nets,
///          threads and determinism are as there. Allocation: as there, and the pieces.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status split_edges(std::span<const ControlNets<S>> nets,
                                                SplitNets<S>& split,
                                                const SplitOptions& options = {},
                                                const RunOptions& run = {}) noexcept;

} // namespace simdbezier
