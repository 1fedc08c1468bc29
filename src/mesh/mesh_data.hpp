// What a mesh layout consists of.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/edge_union.hpp"
#include "src/mesh/topology_data.hpp"

namespace simdbezier::detail {

struct MeshData {
  Topology topology;
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  std::vector<std::uint16_t> diagonals;  ///< of each patch, see PatchRates
  std::vector<std::uint32_t> corners;    ///< vertex of [4 * patch + corner]
  std::vector<std::uint32_t> edge_first; ///< vertex of each edge's first inner point
  std::vector<std::uint32_t> segments;   ///< of each edge
  std::vector<std::uint32_t> inner;      ///< vertex of each patch's first inner point
  std::vector<std::uint64_t> triangles;  ///< before each patch, and of all
  std::uint32_t most_segments = 0;       ///< of one edge
  std::uint32_t vertices = 0;

  [[nodiscard]] std::uint32_t rate(std::size_t side) const noexcept {
    return (runs_in_u(side) ? nu : nv)[side / kPatchEdges];
  }
  /// The different rates of an edge's sides.
  void rates_of(std::size_t edge, EdgeRates& rates) const {
    rates.clear();
    for (const std::uint32_t side : topology.data()->sides_of(edge)) {
      include_rate(rates, rate(side));
    }
  }
};

} // namespace simdbezier::detail
