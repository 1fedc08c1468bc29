// Parts of a model that several processes work on, each with some of its patches;
// docs/guide/clusters.md has a program that works like this.
//
// A part consists of patches of its own and of ghosts: all other patches that have a corner in a
// place where an own one has a corner. Together, in the order of the whole model, they are a model
// for find_topology(), lay_out_mesh(), evaluate_mesh() and write_triangles(). All that these find
// for own patches is what the whole model would give, bit for bit, except the numbers of vertices,
// which begin at 0 in each part. The first number of a part in the whole mesh is the number of
// vertices that own patches of earlier parts own. Vertices that ghosts before its own patches own
// are numbered by the part that these belong to, which tells where they begin (PatchVertices).
//
// Rates depend on a patch alone, except those of entangled ones (Topology::is_entangled()), and on
// where the topology forces a diagonal. Both are known of patches all of whose neighbours are
// there. Those of ghosts come from the part that they belong to, or follow if ghosts of ghosts, and
// those of entangled ones, are part of the model as well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/patch_edge.hpp>
#include <simdbezier/samples.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier {

/// Keys by which corners and edges of patches in different memories are compared.
struct PatchKeys {
  /// Of each corner, numbered 2 v + u: equal for points in one place, which are divided by weights.
  std::uint64_t corners[4] = {};
  /// Of each PatchEdge: equal for edges that find_adjacency() takes for one.
  std::uint64_t edges[4] = {};
  /// 1 << PatchEdge: the edge is a point. Its corners are one vertex, with different keys if
  /// divisions were rounded differently.
  std::uint8_t points = 0;
};

/// Finds the keys of all patches. Different places and edges hardly ever have equal keys, unless
/// they are made to; whoever must be sure compares control points.
/// keys:        one value a patch, in the order of all views.
/// options:     only threads counts. Allocation: some bytes a view. Cost: some 40 ns a patch.
/// Determinism: a function of the control points on all machines, but not in all versions.
/// Returns:     ok | the statuses of views | output_too_small | out_of_memory.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status find_patch_keys(std::span<const ControlNets<S>> nets,
                                                    std::span<PatchKeys> keys,
                                                    const Options& options = {}) noexcept;

/// Stands for a number that does not exist or is not known.
inline constexpr std::uint64_t kUnknownVertex = ~std::uint64_t{0};

/// Where the vertices that a patch owns begin in the whole mesh: those of a corner, 2 v + u, and
/// the inner ones of a PatchEdge. kUnknownVertex: it does not own them.
struct PatchVertices {
  std::uint64_t corners[4] = {kUnknownVertex, kUnknownVertex, kUnknownVertex, kUnknownVertex};
  std::uint64_t edges[4] = {kUnknownVertex, kUnknownVertex, kUnknownVertex, kUnknownVertex};
};

/// Tells where the vertices of own patches begin, for the parts that have these as ghosts.
/// part:    of lay_out_mesh(), split_creases() or split_parameters(). own: the part's own patches;
///          their numbers are those of the part, plus `first_vertex`, less that of the first one.
/// out:     one value for every own patch.
/// Returns: ok | bad_patch_range | output_too_small. Allocation: none. Cost: some 10 ns a patch.
[[nodiscard]] SIMDBEZIER_API Status owned_vertices(const MeshLayout& part, SetRange own,
                                                   std::uint64_t first_vertex,
                                                   std::span<PatchVertices> out) noexcept;

/// Finds the numbers of the whole mesh for the vertices of a part.
/// part, own: as above. first_vertex: the number of the first vertex that an own patch owns.
/// ghosts:    what owned_vertices() told about the patches before the own ones, one value each.
/// numbers:   one value for every vertex below part.first_vertex(own.first + own.count).
///            kUnknownVertex: nobody told it; no own patch needs it if all ghosts are there.
/// Returns:   ok | bad_patch_range | unequal_lengths (ghosts) | output_too_small. Allocation: none.
[[nodiscard]] SIMDBEZIER_API Status number_part(const MeshLayout& part, SetRange own,
                                                std::uint64_t first_vertex,
                                                std::span<const PatchVertices> ghosts,
                                                std::span<std::uint64_t> numbers) noexcept;

} // namespace simdbezier
