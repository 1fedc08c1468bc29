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
//   Options      Options::threads is honoured, by write_triangles() also isa, executed and
//                destination; the other members have no meaning.
//   Allocation   scratch per thread, and 8 to 24 bytes a patch for sizes not in the layout.
//   Determinism  a function of the layout. Spans may not overlap each other, which is not checked.
//   Cost         O(cells). A size takes about as long as what it is for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/options.hpp>
#include <simdbezier/samples.hpp>

namespace simdbezier {

/// Writes three numbers a triangle; MeshLayout::size() says how many triangles there are.
/// options: Destination::automatic streams numbers that take more than half of the last-level
///          cache, without a measurement; SIMDBEZIER_DESTINATION counts. Any alignment will do.
/// patches: all of them, or some: the first number is that of MeshLayout::first_triangle() of the
///          first patch. bad_patch_range if the layout has no such patches.
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
                                                 const Options& options = {},
                                                 SetRange patches = {}) noexcept;

/// Writes a quad for every cell of four vertices, triangles for all others. The certificate holds
/// if quads are cut from their first to their third vertex. patches: as for write_triangles().
/// indices: the vertices of all polygons. sizes: 3 or 4, one value a polygon.
template <typename Index>
[[nodiscard]] SIMDBEZIER_API Status write_polygons(const MeshLayout& layout,
                                                   std::span<Index> indices,
                                                   std::span<std::uint8_t> sizes,
                                                   const Options& options = {},
                                                   SetRange patches = {}) noexcept;

/// Counts the numbers that write_strips() writes.
[[nodiscard]] SIMDBEZIER_API Status strip_size(const MeshLayout& layout, std::size_t& indices,
                                               const Options& options = {}) noexcept;

/// Writes triangle strips; the largest value of Index ends each of them (primitive restart).
template <typename Index>
[[nodiscard]] SIMDBEZIER_API Status write_strips(const MeshLayout& layout, std::span<Index> indices,
                                                 const Options& options = {}) noexcept;

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
/// Counts the clusters that write_clusters() writes, and the values that they take.
[[nodiscard]] SIMDBEZIER_API Status cluster_size(const MeshLayout& layout, ClusterSize& size,
                                                 const Options& options = {}) noexcept;

/// Where clusters go: as many values as ClusterSize says, three corners a triangle.
struct ClusterOutputs {
  std::span<MeshCluster> clusters;
  std::span<std::uint32_t> vertices; ///< numbers of the mesh
  std::span<std::uint8_t> corners;   ///< numbers of the cluster's vertices
};

/// Writes the mesh in clusters of at most kMostClusterTriangles triangles and kMostClusterVertices
/// vertices of one patch, in blocks of about 8 x 8 cells.
[[nodiscard]] SIMDBEZIER_API Status write_clusters(const MeshLayout& layout,
                                                   const ClusterOutputs& out,
                                                   const Options& options = {}) noexcept;

} // namespace simdbezier
