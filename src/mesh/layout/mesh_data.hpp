// What a mesh layout consists of.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/layout/edge_union.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/runtime/fresh_vector.hpp"

namespace simdbezier::detail {

struct MeshData {
  Topology topology;
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  std::vector<std::uint16_t> diagonals;  ///< of each patch, see PatchRates
  FreshVector<std::uint32_t> corners;    ///< vertex of [4 * patch + corner]
  FreshVector<std::uint32_t> edge_first; ///< vertex of each edge's first inner point
  FreshVector<std::uint32_t> segments;   ///< of each edge
  FreshVector<std::uint32_t> inner;      ///< vertex of each patch's first inner point
  FreshVector<std::uint64_t> triangles;  ///< before each patch, and of all
  /// The place in side_vertices, for each side, where its vertices from its edge's second point to
  /// the last but one begin, or kWhole, where edges have more than one vertex a point
  /// (split_creases()). It is empty where no edge is split.
  std::vector<std::size_t> side_first;
  std::vector<std::uint32_t> side_vertices;
  /// The layout whose vertices this one splits without splitting their normals
  /// (split_parameters()); empty where there is none.
  MeshLayout merged;
  std::uint32_t most_segments = 0; ///< of one edge
  bool has_unions = true;          ///< whether an edge has points that one of its sides has not
  /// The rates of edges with many sides, each of which would otherwise look at all the others.
  struct CrowdedEdge {
    std::size_t edge;
    EdgeRates rates;
  };
  std::vector<CrowdedEdge> crowded_edges; ///< ascending
  // What scratch has to have room for, over the corners and edges of one patch's own:
  std::size_t most_boundary_vertices = 0;
  std::size_t most_boundary_samples = 0; ///< a vertex counts once for every patch that has it
  std::size_t most_sides = 1;            ///< of one edge
  std::uint32_t least_nu = 1;            ///< of one patch
  std::uint32_t most_nu = 1;
  std::uint32_t most_nv = 1;
  std::uint32_t vertices = 0;

  static constexpr std::size_t kWhole = ~std::size_t(0);

  [[nodiscard]] std::uint32_t rate(std::size_t side) const noexcept {
    return (runs_in_u(side) ? nu : nv)[side / kPatchEdges];
  }
  [[nodiscard]] std::size_t patches() const noexcept { return nu.size(); }
  [[nodiscard]] std::uint32_t most_rate() const noexcept { return std::max(most_nu, most_nv); }
  [[nodiscard]] std::uint32_t inner_points(std::size_t patch) const noexcept {
    return (nu[patch] - 1) * (nv[patch] - 1);
  }
  /// The vertices that are a patch's own: corners, edges and inner points; all vertices for the
  /// patch behind the last one.
  [[nodiscard]] std::uint32_t first_vertex(std::size_t patch) const noexcept {
    return patch == 0 ? 0 : inner[patch - 1] + inner_points(patch - 1);
  }
  /// The layout whose vertices have a normal each: this one, or the one that it splits.
  [[nodiscard]] const MeshData& normals() const noexcept {
    return merged.data() == nullptr ? *this : *merged.data();
  }
  [[nodiscard]] bool is_split(std::size_t side) const noexcept {
    return !side_first.empty() && side_first[side] != kWhole;
  }
  /// The vertex of a side at the edge's point k, 0 < k < segments, in the edge's own direction.
  [[nodiscard]] std::uint32_t edge_vertex(std::size_t side, std::uint32_t k) const noexcept {
    return is_split(side) ? side_vertices[side_first[side] + k - 1]
                          : edge_first[topology.data()->sides[side].edge()] + k - 1;
  }
  /// The different rates of an edge's sides.
  void rates_of(std::size_t edge, EdgeRates& rates) const {
    const auto crowded = std::lower_bound(
        crowded_edges.begin(), crowded_edges.end(), edge,
        [](const CrowdedEdge& known, std::size_t wanted) { return known.edge < wanted; });
    if (crowded != crowded_edges.end() && crowded->edge == edge) {
      rates = crowded->rates;
      return;
    }
    rates.clear();
    for (const std::uint32_t side : topology.data()->sides_of(edge)) {
      include_rate(rates, rate(side));
    }
  }
};

} // namespace simdbezier::detail
