#include "src/mesh/topology/marks.hpp"
#include "src/runtime/both_types.hpp"

#include <utility>

namespace simdbezier::detail {
namespace {

/// The sides of every edge, as in TopologyData, without those of repeated patches.
class DistinctSides {
public:
  explicit DistinctSides(const TopologyData& topology) : topology_(topology) {
    if (topology.originals.empty()) {
      return; // as usual: all sides are
    }
    first_.push_back(0);
    for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
      for (const std::uint32_t side : topology.sides_of(edge)) {
        if (!topology.is_repeated(side / kPatchEdges)) {
          members_.push_back(side);
        }
      }
      first_.push_back(static_cast<std::uint32_t>(members_.size()));
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t edge) const {
    return first_.empty()
               ? topology_.sides_of(edge)
               : std::span(members_).subspan(first_[edge], first_[edge + 1] - first_[edge]);
  }

private:
  const TopologyData& topology_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> members_;
};

/// The two sides that meet in corner 4 * patch + corner, and which of their ends do.
struct CornerSides {
  std::size_t in_u;
  std::size_t in_v;
  std::size_t end_u;
  std::size_t end_v;

  explicit CornerSides(std::size_t k)
      : in_u(kPatchEdges * (k / kPatchCorners) + (k % kPatchCorners < 2 ? 0 : 1)),
        in_v(kPatchEdges * (k / kPatchCorners) + (k % 2 == 0 ? 2 : 3)), end_u(k % 2),
        end_v(k % kPatchCorners / 2) {}
};

/// Whether the corner's two sides are one edge, or two edges of another patch: two patches that cut
/// such a corner off have the same triangle. Repeated patches always do, and do not count.
bool is_pillow(const TopologyData& topology, const DistinctSides& distinct, std::size_t k) {
  const CornerSides at(k);
  const auto edge_end = [&](std::size_t side, std::size_t end) {
    const Side& own = topology.sides[side];
    return std::pair(own.edge(), own.reversed() ? 1 - end : end);
  };
  const auto u = edge_end(at.in_u, at.end_u);
  const auto v = edge_end(at.in_v, at.end_v);
  if (u == v) {
    return true;
  }
  // Patches with an edge besides this one, its neighbours being those that count.
  const std::size_t needed = topology.is_repeated(k / kPatchCorners) ? 2 : 1;
  const bool fewer_in_u = distinct.of(u.first).size() <= distinct.of(v.first).size();
  const auto& along = fewer_in_u ? u : v;
  const auto& across = fewer_in_u ? v : u;
  std::size_t found = 0;
  for (const std::uint32_t side : distinct.of(along.first)) {
    const std::size_t end = topology.sides[side].reversed() ? 1 - along.second : along.second;
    const std::uint32_t corner = corner_at(side, end);
    const CornerSides there(corner);
    const bool is_u = there.in_u == side;
    const std::size_t other = is_u ? there.in_v : there.in_u;
    if (corner != k && !topology.sides[other].collapsed() &&
        edge_end(other, is_u ? there.end_v : there.end_u) == across && ++found == needed) {
      return true;
    }
  }
  return false;
}

} // namespace

template <typename S>
void mark_corners(const NetCorners<S>& nets, std::span<const std::uint8_t> doubts,
                  std::span<const std::uint32_t> candidates, TopologyData& topology) {
  const auto mark = [&](std::size_t patch, std::size_t corner) {
    topology.flags[patch] |= static_cast<std::uint8_t>(kThroughCorner << corner);
  };
  const DistinctSides distinct(topology);
  for (const std::uint32_t patch : candidates) {
    for (std::size_t corner = 0; corner < kPatchCorners; ++corner) {
      const std::size_t k = kPatchCorners * patch + corner;
      const CornerSides at(k);
      const bool point_u = topology.sides[at.in_u].collapsed();
      const bool point_v = topology.sides[at.in_v].collapsed();
      const bool pillow = !point_u && !point_v && is_pillow(topology, distinct, k);
      if (pillow || point_u != point_v) {
        mark(patch, corner);
      }
    }
  }
  for (std::size_t patch = 0; patch < topology.patches(); ++patch) {
    for (std::size_t corner = 0; doubts[patch] != 0 && corner < kPatchCorners; ++corner) {
      if ((doubts[patch] & kMayLeaveTogether << corner) != 0 &&
          nets.sides_leave_together(patch, corner)) {
        mark(patch, corner);
      }
    }
  }
}

template <typename S>
void mark_loops(const NetCorners<S>& nets, std::span<const std::uint8_t> doubts,
                TopologyData& topology) {
  for (std::size_t patch = 0; patch < topology.patches(); ++patch) {
    for (std::size_t k = 0; doubts[patch] != 0 && k < kPatchEdges; ++k) {
      const std::size_t side = kPatchEdges * patch + k;
      if ((doubts[patch] & kEndsMayMeet << k) != 0 && topology.owns_edge(side) &&
          topology.corner_of(side, 0) != topology.corner_of(side, 1) && nets.ends_meet(side)) {
        topology.loops.push_back(static_cast<std::uint32_t>(side));
      }
    }
  }
}

SIMDBEZIER_OF_BOTH_TYPES(mark_corners);
SIMDBEZIER_OF_BOTH_TYPES(mark_loops);

} // namespace simdbezier::detail
