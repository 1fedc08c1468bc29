// Numbers the vertices of a mesh whose edges have their segments, and counts its triangles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "src/mesh/layout/mesh_data.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier::detail {

/// The triangles of a patch: two a cell, one more for every vertex that its sides have besides its
/// own ones, and one less for every cell at a side that is a point. Where that is less than
/// none, all points of the patch are one vertex, and it has no triangle.
inline std::uint64_t triangles_of(const TopologyData& topology, const MeshData& mesh,
                                  std::size_t patch) {
  std::int64_t triangles = 2 * std::int64_t{mesh.nu[patch]} * mesh.nv[patch];
  for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
    const Side& own = topology.sides[side];
    triangles += own.collapsed() ? 0 : std::int64_t{mesh.segments[own.edge()]};
    triangles -= mesh.rate(side);
  }
  return static_cast<std::uint64_t>(std::max<std::int64_t>(triangles, 0));
}

/// Numbers vertices patch by patch. Each share of the patches counts those of its own first, so
/// that all can be numbered at once.
class VertexNumbers {
public:
  /// corner_groups: see number_vertices().
  VertexNumbers(std::span<const std::uint32_t> corner_groups, MeshData& mesh, int threads)
      : topology_(*mesh.topology.data()), mesh_(mesh), corner_groups_(corner_groups),
        shares_(topology_.patches(), kNanoseconds, threads), found_(shares_.count()) {
    mesh.corners.resize(topology_.corners.size());
    mesh.edge_first.resize(topology_.edges());
    mesh.inner.resize(topology_.patches());
    mesh.triangles.resize(topology_.patches() + 1);
  }

  /// Returns the number of vertices.
  std::uint64_t run() {
    if (shares_.count() > 1) {
      shares_.run([this](std::size_t share) { found_[share].vertices = own_vertices(share); });
    }
    std::uint64_t vertices = 0;
    for (Share& share : found_) {
      share.first_vertex = std::exchange(vertices, vertices + share.vertices);
    }
    mesh_.triangles[0] = 0;
    shares_.run([this](std::size_t share) { number(share); });
    mesh_.most_boundary_vertices = 0;
    mesh_.most_boundary_samples = 0;
    for (const Share& share : found_) {
      mesh_.most_boundary_vertices =
          std::max(mesh_.most_boundary_vertices, share.most_boundary_vertices);
      mesh_.most_boundary_samples =
          std::max(mesh_.most_boundary_samples, share.most_boundary_samples);
    }
    if (shares_.count() > 1) {
      std::uint64_t triangles = 0;
      for (Share& share : found_) {
        share.first_triangle = std::exchange(triangles, triangles + share.triangles);
      }
      shares_.run([this](std::size_t share) { shift_triangles(share); });
    }
    return found_.back().end_vertex;
  }

private:
  static constexpr std::size_t kNanoseconds = 15; ///< a patch

  struct Share {
    std::uint64_t vertices = 0; ///< counted where there are more shares than one
    std::uint64_t first_vertex = 0;
    std::uint64_t end_vertex = 0;
    std::uint64_t triangles = 0;
    std::uint64_t first_triangle = 0;
    std::size_t most_boundary_vertices = 0; ///< as in MeshData
    std::size_t most_boundary_samples = 0;
  };

  /// Without regard to groups, which several shares have no part in.
  [[nodiscard]] std::uint64_t own_vertices(std::size_t share) const {
    std::uint64_t vertices = 0;
    const std::size_t begin = kPatchCorners * shares_.begin(share);
    const std::size_t end = kPatchCorners * shares_.end(share);
    for (std::size_t k = begin; k < end; ++k) {
      vertices += topology_.corners[k] == k ? 1 : 0;
    }
    const std::size_t end_edge = topology_.edge_from(end);
    for (std::size_t edge = topology_.edge_from(begin); edge < end_edge; ++edge) {
      vertices += mesh_.segments[edge] - 1;
    }
    for (std::size_t patch = shares_.begin(share); patch < shares_.end(share); ++patch) {
      vertices += mesh_.inner_points(patch);
    }
    return vertices;
  }

  void number(std::size_t share) {
    std::uint64_t vertices = found_[share].first_vertex;
    std::uint64_t triangles = 0;
    std::size_t most_vertices = 0;
    std::size_t most_samples = 0;
    for (std::size_t patch = shares_.begin(share); patch < shares_.end(share); ++patch) {
      const std::uint64_t first = vertices;
      std::size_t samples = 0;
      for (std::size_t k = kPatchCorners * patch; k < kPatchCorners * (patch + 1); ++k) {
        if (topology_.corners[k] == k) {
          topology_.for_joined(k, [&](std::size_t corner) {
            const std::uint32_t lowest = corner_groups_[corner];
            mesh_.corners[corner] =
                lowest == corner ? static_cast<std::uint32_t>(vertices++) : mesh_.corners[lowest];
            ++samples;
          });
        }
      }
      topology_.for_owned_edges(patch, [&](std::uint32_t edge) {
        vertices = number_edge(edge, vertices);
        samples += topology_.sides_of(edge).size() * (mesh_.segments[edge] - 1);
      });
      most_vertices = std::max<std::size_t>(most_vertices, vertices - first);
      most_samples = std::max(most_samples, samples);
      mesh_.inner[patch] = static_cast<std::uint32_t>(vertices);
      vertices += mesh_.inner_points(patch);
      triangles += triangles_of(topology_, mesh_, patch);
      mesh_.triangles[patch + 1] = triangles;
    }
    found_[share].most_boundary_vertices = most_vertices;
    found_[share].most_boundary_samples = most_samples;
    found_[share].end_vertex = vertices;
    found_[share].triangles = triangles;
  }
  /// The vertices of an edge's points, from `vertices` on; returns the next free one.
  std::uint64_t number_edge(std::uint32_t edge, std::uint64_t vertices) {
    const auto sides = topology_.sides_of(edge);
    const std::uint32_t points = mesh_.segments[edge] - 1;
    mesh_.edge_first[edge] = static_cast<std::uint32_t>(vertices);
    if (!mesh_.is_split(sides[0])) {
      return vertices + points;
    }
    for (std::uint32_t k = 0; k < points; ++k) {
      std::uint32_t groups = 0;
      for (const std::uint32_t side : sides) {
        std::uint32_t& vertex = mesh_.side_vertices[mesh_.side_first[side] + k];
        groups = std::max(groups, vertex + 1);
        vertex += static_cast<std::uint32_t>(vertices);
      }
      vertices += groups;
    }
    return vertices;
  }

  void shift_triangles(std::size_t share) {
    for (std::size_t patch = shares_.begin(share); patch < shares_.end(share); ++patch) {
      mesh_.triangles[patch + 1] += found_[share].first_triangle;
    }
  }

  const TopologyData& topology_;
  MeshData& mesh_;
  std::span<const std::uint32_t> corner_groups_;
  Shares shares_;
  std::vector<Share> found_;
};

} // namespace simdbezier::detail
