// The vertices and triangles of a mesh: how many there are, and which vertices are whose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/patch_set.hpp>
#include <simdbezier/status.hpp>
#include <simdbezier/topology.hpp>

namespace simdbezier {

namespace detail {
struct MeshData;
}

/// The largest number of cells of a patch in one direction.
inline constexpr std::uint32_t kMostSegments = 4096;

/// How many cells each patch has in u and in v, from 1 to kMostSegments, and how they are cut.
struct PatchRates {
  std::span<const std::uint32_t> cells_u;
  std::span<const std::uint32_t> cells_v;
  /// One value a patch, or empty: every cell has the diagonal from (0,0) to (1,1).
  std::span<const std::uint16_t> diagonals;
};

/// Cells of one zone share a diagonal. In u and in v, a cell lies in the low or the high half of
/// the patch. If the rate is odd, one cell lies across the middle, and is `middle`. Bit 3 * zone_v
/// + zone_u is set if the diagonal runs from (1,0) to (0,1).
enum class Zone : std::uint8_t { low, high, middle };

/// What a mesh consists of.
struct MeshSize {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

/// Stands for a vertex that does not exist.
inline constexpr std::uint32_t kNoLayoutVertex = 0xffffffff;

/// The numbering of a mesh's vertices. Immutable; copies share it.
class MeshLayout {
public:
  MeshLayout() noexcept = default;

  [[nodiscard]] SIMDBEZIER_API MeshSize size() const noexcept;
  /// The number of a patch's first triangle; size().triangles for the patch behind the last one.
  [[nodiscard]] SIMDBEZIER_API std::size_t first_triangle(std::size_t patch) const noexcept;
  /// The first vertex that is a patch's own; size().vertices for the patch behind the last one.
  [[nodiscard]] SIMDBEZIER_API std::size_t first_vertex(std::size_t patch) const noexcept;

  // Single vertices as a patch has them; kNoLayoutVertex if it has no such corner, edge or point.
  /// The vertex of a corner, numbered 2 v + u.
  [[nodiscard]] SIMDBEZIER_API std::uint32_t corner(std::size_t patch,
                                                    std::size_t corner) const noexcept;
  /// The number of the mesh's segments along an edge, a union over its patches; 0 if it is a point.
  [[nodiscard]] SIMDBEZIER_API std::uint32_t segments(std::size_t patch,
                                                      PatchEdge edge) const noexcept;
  /// The vertex at point k, 0 to segments(), in the direction of the patch's own parameter.
  [[nodiscard]] SIMDBEZIER_API std::uint32_t along(std::size_t patch, PatchEdge edge,
                                                   std::uint32_t k) const noexcept;
  /// The vertex at (i / cells_u, j / cells_v) inside of a patch: 0 < i < cells_u, 0 < j < cells_v.
  [[nodiscard]] SIMDBEZIER_API std::uint32_t inner(std::size_t patch, std::uint32_t i,
                                                   std::uint32_t j) const noexcept;

  /// This is for the library's own use.
  [[nodiscard]] const detail::MeshData* data() const noexcept { return data_.get(); }
  explicit MeshLayout(std::shared_ptr<const detail::MeshData> data) noexcept
      : data_(std::move(data)) {}

private:
  std::shared_ptr<const detail::MeshData> data_;
};

/// Raises small rates, by as little as needed, if the mesh would otherwise contain two triangles on
/// the same three vertices, an edge shared by more than two triangles, or a cell whose corners
/// require different diagonals. Between opposite sides that are points there are then at least two
/// cells, and three if a third side is a point, too. Other rates stay. More cells would not help
/// patches that repeat an earlier one, nor patches with two neighbouring sides that are one edge.
/// cells_u, cells_v: one value a patch, 1 to kMostSegments; undefined after out_of_memory.
/// raised:  the number of patches that changed.
/// Threads: the caller's alone. Determinism: a function of the topology and the rates.
/// Returns: ok | bad_rates (not one value a patch, or outside of that range) | out_of_memory.
[[nodiscard]] SIMDBEZIER_API Status separate_vertices(const Topology& topology,
                                                      std::span<std::uint32_t> cells_u,
                                                      std::span<std::uint32_t> cells_v,
                                                      std::size_t& raised) noexcept;

/// Numbers the vertices of the mesh in which patch p has cells_u[p] x cells_v[p] cells. An edge
/// carries the union of the parameters i/n of all of its sides, so that no neighbour's rate can
/// leave a gap. The lowest of the patches that share a vertex owns it, on its first edge. Vertices
/// are numbered patch by patch: corners that the patch owns, inner points of its own edges (v0, v1,
/// u0, u1, in the direction of its parameter), inner points row by row. Triangles with one vertex
/// twice do not count. Therefore cells at sides that are points, or between neighbouring sides that
/// are one edge, have fewer than two triangles. Without separate_vertices(), a patch may have no
/// triangles.
/// Cost:    some 50 ns a patch. Allocation: about 40 bytes a patch and 8 an edge. Determinism: a
///          function of the topology and the rates.
/// Returns: ok | bad_rates (not one value a patch, or outside of 1 to kMostSegments) |
///          size_overflow (2^32 vertices and more) | out_of_memory.
[[nodiscard]] SIMDBEZIER_API Status lay_out_mesh(const Topology& topology, const PatchRates& rates,
                                                 MeshLayout& layout,
                                                 const RunOptions& options = {}) noexcept;

// The cells of a mesh as triangles, polygons, strips or clusters.
// For every call
//   Index        std::uint32_t or std::uint16_t; its largest value is no vertex.
//   Order        patch after patch in ascending order; within a patch row by row.
//   Orientation  counter-clockwise about du x dv; the other way round on patches that the topology
//                turned. Triangles without area, beside a side that is a point, are left out.
//   Returns      ok | null_output | output_too_small (a span is shorter than the mesh needs) |
//                size_overflow (more vertices than Index has numbers; clusters of more than 2^32 -
//                1 vertices or triangles) | out_of_memory (spans are undefined then) | unknown_isa
//                and unsupported_isa (of triangles, as resolve_isa()).
//   Allocation   scratch per thread, and 8 to 24 bytes a patch for sizes not in the layout.
//   Determinism  a function of the layout. Spans may not overlap each other, which is not checked.
//   Cost         O(cells). Counting takes about as long as writing.

/// Writes three numbers a triangle; MeshLayout::size() says how many triangles there are.
/// options: Destination::automatic streams numbers that take more than half of the last-level
///          cache, without a measurement, unless SIMDBEZIER_DESTINATION decides. Any alignment will
///          do.
/// patches: all of them, or some. The first triangle written then has the number
///          MeshLayout::first_triangle() of the first patch. bad_patch_range if the layout has no
///          such patches.
template <typename Index>
[[nodiscard]] SIMDBEZIER_API Status write_triangles(const MeshLayout& layout,
                                                    std::span<Index> triangles,
                                                    const Options& options = {},
                                                    SetRange patches = {}) noexcept;

/// What a mesh of quads and triangles needs.
struct PolygonSize {
  std::size_t polygons = 0;
  std::size_t indices = 0;
};
/// Counts what write_polygons() writes. patches: as for write_triangles().
[[nodiscard]] SIMDBEZIER_API Status polygon_size(const MeshLayout& layout, PolygonSize& size,
                                                 const RunOptions& options = {},
                                                 SetRange patches = {}) noexcept;

/// Writes a quad for every cell of four vertices, triangles for all others. The certificate holds
/// if quads are cut from their first to their third vertex. patches: as for write_triangles().
/// indices: the vertices of all polygons. sizes: 3 or 4, one value a polygon.
template <typename Index>
[[nodiscard]] SIMDBEZIER_API Status write_polygons(const MeshLayout& layout,
                                                   std::span<Index> indices,
                                                   std::span<std::uint8_t> sizes,
                                                   const RunOptions& options = {},
                                                   SetRange patches = {}) noexcept;

/// Counts the numbers that write_strips() writes. patches: as for write_triangles().
[[nodiscard]] SIMDBEZIER_API Status strip_size(const MeshLayout& layout, std::size_t& indices,
                                               const RunOptions& options = {},
                                               SetRange patches = {}) noexcept;

/// Writes triangle strips; the largest value of Index ends each of them (primitive restart).
/// patches: as for write_triangles(); no strip has triangles of two patches.
template <typename Index>
[[nodiscard]] SIMDBEZIER_API Status write_strips(const MeshLayout& layout, std::span<Index> indices,
                                                 const RunOptions& options = {},
                                                 SetRange patches = {}) noexcept;

/// A group of neighbouring triangles with vertices of its own, as mesh shaders take them.
struct MeshCluster {
  std::uint32_t first_vertex = 0;   ///< its place in ClusterOutputs::vertices
  std::uint32_t first_triangle = 0; ///< its number in ClusterOutputs::corners, three values each
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  std::uint32_t patch = 0; ///< the one that all of its triangles are part of
};
inline constexpr std::uint32_t kMostClusterTriangles = 128;
inline constexpr std::uint32_t kMostClusterVertices = 128;

/// What clusters need.
struct ClusterSize {
  std::size_t clusters = 0;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};
/// Counts the clusters that write_clusters() writes, and the values that they take. patches: as for
/// write_triangles().
[[nodiscard]] SIMDBEZIER_API Status cluster_size(const MeshLayout& layout, ClusterSize& size,
                                                 const RunOptions& options = {},
                                                 SetRange patches = {}) noexcept;

/// Where clusters go: as many values as ClusterSize says, three corners a triangle.
struct ClusterOutputs {
  std::span<MeshCluster> clusters;
  std::span<std::uint32_t> vertices; ///< numbers of the mesh
  std::span<std::uint8_t> corners;   ///< numbers of the cluster's vertices
};

/// Writes the mesh in clusters of at most kMostClusterTriangles triangles and kMostClusterVertices
/// vertices of one patch, in blocks of about 8 x 8 cells. patches: as for write_triangles();
/// first_vertex and first_triangle begin at 0 for the first of them.
[[nodiscard]] SIMDBEZIER_API Status write_clusters(const MeshLayout& layout,
                                                   const ClusterOutputs& out,
                                                   const RunOptions& options = {},
                                                   SetRange patches = {}) noexcept;

// Parts of a model that several processes work on, each with some of its patches.
// docs/guide/clusters.md describes a program that works like this.
//
// A part consists of its own patches and of ghosts. Ghosts are all other patches that have a corner
// in a place where a patch of the part's own has one. Together, in the order of the whole model,
// they are a model for find_topology(), lay_out_mesh(), evaluate_mesh() and write_triangles(). For
// the part's own patches, these calls give what the whole model would give, bit for bit. Only the
// numbers of vertices differ: they begin at 0 in each part. In the whole mesh, the numbers of a
// part follow those of all vertices that the parts before it own. These parts also tell where the
// vertices of ghosts begin (PatchVertices).
//
// Rates depend on the patch and on diagonals that the topology forces. A part that contains all
// neighbours of a patch knows both, unless the patch is entangled (Topology::is_entangled()). Take
// the rates of ghosts from their own part, or add the ghosts of ghosts to the model.

/// Keys by which corners and edges of patches in different memories are compared.
struct PatchKeys {
  /// Of each corner, numbered 2 v + u: equal for points in one place, after division by weights.
  std::uint64_t corners[4] = {};
  /// Of each PatchEdge: equal for edges that find_adjacency() takes for one.
  std::uint64_t edges[4] = {};
  /// 1 << PatchEdge: the edge is a point. Its corners are one vertex, with different keys if
  /// divisions were rounded differently.
  std::uint8_t points = 0;
};

/// Finds the keys of all patches. Different places and edges hardly ever have equal keys, unless
/// somebody makes them so: to be sure, compare control points.
/// keys:        one value a patch, in the order of all views.
/// Allocation:  some bytes a view. Cost: some 40 ns a patch.
/// Determinism: a function of the control points on all machines, but not in all versions.
/// Returns:     ok | the statuses of views | output_too_small | out_of_memory.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Status find_patch_keys(std::span<const ControlNets<S>> nets,
                                                    std::span<PatchKeys> keys,
                                                    const RunOptions& options = {}) noexcept;

/// Stands for a number that does not exist or is not known.
inline constexpr std::uint64_t kUnknownVertex = ~std::uint64_t{0};

/// Where the vertices that a patch owns begin in the whole mesh: those of a corner, 2 v + u, and
/// the inner ones of a PatchEdge. kUnknownVertex: it does not own them.
struct PatchVertices {
  std::uint64_t corners[4] = {kUnknownVertex, kUnknownVertex, kUnknownVertex, kUnknownVertex};
  std::uint64_t edges[4] = {kUnknownVertex, kUnknownVertex, kUnknownVertex, kUnknownVertex};
};

/// Tells where the vertices of a part's own patches begin, for the parts that have these as ghosts.
/// part:    of lay_out_mesh(), split_creases() or split_parameters(). own: the part's own patches.
///          Vertex k of the part gets the number first_vertex + k - part.first_vertex(own.first).
/// out:     one value for every own patch.
/// Returns: ok | bad_patch_range | output_too_small. Allocation: none. Cost: some 10 ns a patch.
[[nodiscard]] SIMDBEZIER_API Status owned_vertices(const MeshLayout& part, SetRange own,
                                                   std::uint64_t first_vertex,
                                                   std::span<PatchVertices> out) noexcept;

/// Finds the numbers of the whole mesh for the vertices of a part.
/// part, own: as above. first_vertex: the number of the first vertex that an own patch owns.
/// ghosts:    what owned_vertices() told about the patches before the own ones, one value each.
/// numbers:   one value for every vertex below part.first_vertex(own.first + own.count).
///            kUnknownVertex stands for numbers that `ghosts` do not give. If all ghosts are there,
///            no such number belongs to a vertex of an own patch.
/// Returns:   ok | bad_patch_range | unequal_lengths (ghosts) | output_too_small. Allocation: none.
[[nodiscard]] SIMDBEZIER_API Status number_part(const MeshLayout& part, SetRange own,
                                                std::uint64_t first_vertex,
                                                std::span<const PatchVertices> ghosts,
                                                std::span<std::uint64_t> numbers) noexcept;

} // namespace simdbezier
