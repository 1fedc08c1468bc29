// See orientation.hpp.
#include "src/mesh/topology/orientation.hpp"

#include <algorithm>

namespace simdbezier::detail {
namespace {

/// Finds which patches to turn so that each agrees with the earlier ones of its connected part;
/// false where some edge then still disagrees.
bool turn_all(const TopologyData& topology, std::vector<bool>& turned) {
  std::vector<bool> known(topology.patches());
  std::vector<std::uint32_t> open;
  bool orientable = true;
  for (std::uint32_t seed = 0; seed < topology.patches(); ++seed) {
    if (known[seed]) {
      continue;
    }
    known[seed] = true;
    for (open.push_back(seed); !open.empty();) {
      const std::uint32_t patch = open.back();
      open.pop_back();
      for (std::uint32_t side = 4 * patch; side < 4 * patch + 4; ++side) {
        if (topology.sides[side].collapsed()) {
          continue;
        }
        const auto sides = topology.sides_of(topology.sides[side].edge());
        if (sides.size() != 2) {
          continue;
        }
        const std::uint32_t other = sides[sides[0] == side ? 1 : 0];
        const bool wanted = turned[patch] != topology.disagree(side, other);
        if (!known[other / 4]) {
          known[other / 4] = true;
          turned[other / 4] = wanted;
          open.push_back(other / 4);
        } else if (turned[other / 4] != wanted) {
          orientable = false;
        }
      }
    }
  }
  return orientable;
}

/// Calls visit(a, b) for the edges of two sides, a < b, whose normals disagree.
template <typename Visit>
void for_disagreeing(const TopologyData& topology, const Visit& visit) {
  for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
    const auto sides = topology.sides_of(edge);
    if (sides.size() == 2 && topology.disagree(sides[0], sides[1])) {
      visit(sides[0], sides[1]);
    }
  }
}

/// Marks those of joined corners to which no row of agreeing edges leads from the lowest one.
void mark_corners_apart(std::uint32_t lowest, TopologyData& topology) {
  std::vector<std::uint32_t> reached = {lowest};
  for (std::size_t k = 0; k < reached.size(); ++k) {
    topology.for_neighbours(reached[k], [&](std::size_t side, std::size_t other, std::uint32_t to) {
      const bool two = !topology.sides[side].collapsed() &&
                       topology.sides_of(topology.sides[side].edge()).size() == 2;
      if (!(two && topology.disagree(side, other)) &&
          std::find(reached.begin(), reached.end(), to) == reached.end()) {
        reached.push_back(to);
      }
    });
  }
  topology.for_joined(lowest, [&](std::size_t k) {
    if (std::find(reached.begin(), reached.end(), k) == reached.end()) {
      topology.apart[k / kPatchCorners] |=
          static_cast<std::uint8_t>(kApartCorner << k % kPatchCorners);
    }
  });
}

} // namespace

Status orient(const TopologyOptions& options, TopologyData& topology) {
  for_disagreeing(topology, [&](auto, auto) { ++topology.counts.turned_edges; });
  std::vector<bool> turned(topology.patches());
  if (topology.counts.turned_edges > 0) {
    topology.counts.orientable = turn_all(topology, turned);
    if (options.orient && !topology.counts.orientable) {
      return Status::not_orientable;
    }
  }
  for (std::size_t patch = 0; patch < topology.patches(); ++patch) {
    if ((options.orient && turned[patch]) != options.flip) {
      topology.flags[patch] |= kTurned;
    }
  }
  return Status::ok;
}

void mark_apart(TopologyData& topology) {
  std::vector<std::uint32_t> corners;
  for_disagreeing(topology, [&](std::uint32_t a, std::uint32_t b) {
    topology.apart.resize(topology.patches());
    topology.apart[b / kPatchEdges] |= static_cast<std::uint8_t>(kApartSide << b % kPatchEdges);
    corners.insert(corners.end(), {topology.corner_of(a, 0), topology.corner_of(a, 1)});
  });
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const std::uint32_t corner : corners) {
    mark_corners_apart(corner, topology);
  }
}

} // namespace simdbezier::detail
