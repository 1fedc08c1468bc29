// Counts the segments of all edges of a mesh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/mesh/layout/edge_union.hpp"
#include "src/mesh/layout/mesh_data.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier::detail {

/// Counts the segments of all edges. Those of more sides than two are few, as a rule, and have
/// lists of rates: one thread counts them, after all others.
class SegmentCounts {
public:
  SegmentCounts(const TopologyData& topology, MeshData& mesh, int threads)
      : topology_(topology), mesh_(mesh), shares_(topology.edges(), kNanoseconds, threads),
        found_(shares_.count()) {}

  void run() {
    mesh_.segments.resize(topology_.edges());
    shares_.run([this](std::size_t share) { count(share); });
    Share all;
    for (const Share& share : found_) {
      all.most = std::max(all.most, share.most);
      all.unions |= share.unions;
      all.sides = std::max(all.sides, share.sides);
    }
    if (all.sides > 2) {
      count_crowds(all);
    }
    mesh_.most_sides = all.sides;
    mesh_.most_segments = all.most;
    mesh_.has_unions = all.unions;
  }

private:
  static constexpr std::size_t kNanoseconds = 8; ///< an edge
  static constexpr std::size_t kManySides = 8;

  struct Share {
    std::uint32_t most = 0; ///< segments
    bool unions = false;    ///< whether an edge has points that one of its sides has not
    std::size_t sides = 1;  ///< of the edge that has the most
  };

  void count(std::size_t share) {
    Share found;
    for (std::size_t edge = shares_.begin(share); edge < shares_.end(share); ++edge) {
      const auto sides = topology_.sides_of(edge);
      found.sides = std::max(found.sides, sides.size());
      if (sides.size() <= 2) {
        put(edge, segments_of(mesh_.rate(sides.front()), mesh_.rate(sides.back())), found);
      }
    }
    found_[share] = found;
  }
  void count_crowds(Share& found) {
    EdgeRates rates;
    std::vector<std::uint32_t> scratch;
    for (std::size_t edge = 0; edge < topology_.edges(); ++edge) {
      const std::size_t sides = topology_.sides_of(edge).size();
      if (sides > 2) {
        mesh_.rates_of(edge, rates);
        if (sides > kManySides) {
          mesh_.crowded_edges.push_back({edge, rates});
        }
        put(edge, union_segments(rates, scratch), found);
      }
    }
  }
  void put(std::size_t edge, std::uint32_t segments, Share& found) {
    const auto sides = topology_.sides_of(edge);
    mesh_.segments[edge] = segments;
    found.most = std::max(found.most, segments);
    found.unions |= segments != mesh_.rate(sides.front()) || segments != mesh_.rate(sides.back());
  }

  const TopologyData& topology_;
  MeshData& mesh_;
  Shares shares_;
  std::vector<Share> found_;
};

} // namespace simdbezier::detail
