// The vertices and triangles of a mesh: how many there are, and which vertices are whose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include <simdbezier/options.hpp>
#include <simdbezier/patch_edge.hpp>
#include <simdbezier/status.hpp>
#include <simdbezier/topology.hpp>

namespace simdbezier {

namespace detail {
struct MeshData;
}

/// The largest number of segments of a patch in one direction.
inline constexpr std::uint32_t kMostSegments = 4096;

/// Segments of every patch in u and in v, 1 to kMostSegments, and how its cells are cut (Zone).
/// Both spans of rates have one value a patch.
struct PatchRates {
  std::span<const std::uint32_t> nu;
  std::span<const std::uint32_t> nv;
  /// One value a patch, or empty: every cell has the diagonal from (0,0) to (1,1).
  std::span<const std::uint16_t> diagonals;
};

/// The zones of a patch's cells, which share a diagonal: low, high and middle cells in u and in v,
/// the middle ones being those across the patch's middle if a rate is odd. Bit 3 * zone_v + zone_u
/// is set if the diagonal runs from (1,0) to (0,1).
enum class Zone : std::uint8_t { low, high, middle };

/// What a mesh consists of.
struct MeshSize {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

/// Stands for a vertex that there is none of.
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
  /// The vertex at (i / nu, j / nv) inside of a patch: 0 < i < nu, 0 < j < nv.
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
/// cells, and three if a third side is a point, too. Other rates stay, also those of patches that
/// repeat an earlier one (their triangles coincide with its own) or have two neighbouring sides
/// that are one edge (more cells would not help).
/// nu, nv:  one value a patch, 1 to kMostSegments; undefined after out_of_memory.
/// raised:  the number of patches that changed.
/// Threads: the caller's alone. Determinism: a function of the topology and the rates.
/// Returns: ok | bad_rates (not one value a patch, or outside of that range) | out_of_memory.
[[nodiscard]] SIMDBEZIER_API Status separate_vertices(const Topology& topology,
                                                      std::span<std::uint32_t> nu,
                                                      std::span<std::uint32_t> nv,
                                                      std::size_t& raised) noexcept;

/// Numbers the vertices of the mesh in which patch p has nu[p] x nv[p] cells.
///
/// An edge carries the union of the parameters i/n of all of its sides, so that no neighbour's rate
/// can leave a gap. Vertices are numbered patch by patch: the corners that the patch owns, inner
/// points of edges that it owns (v0, v1, u0, u1, in the direction of its parameter), then its inner
/// points row by row. The lowest of the patches that share a vertex owns it, on its first edge.
/// Triangles with one vertex twice do not exist and do not count: cells at sides that are points,
/// or between neighbouring sides that are one edge, have fewer than two. Without
/// separate_vertices(), a patch whose points are all one vertex may have no triangle.
/// options: only threads counts. Allocation: about 40 bytes a patch and 8 an edge.
/// Cost:    some 50 ns a patch. Determinism: a function of the topology and the rates.
/// Returns: ok | bad_rates (not one value a patch, or outside of 1 to kMostSegments) |
///          size_overflow (2^32 vertices and more) | out_of_memory.
[[nodiscard]] SIMDBEZIER_API Status lay_out_mesh(const Topology& topology, const PatchRates& rates,
                                                 MeshLayout& layout,
                                                 const Options& options = {}) noexcept;

} // namespace simdbezier
