// See orientation.hpp.
#include "src/mesh/orientation.hpp"

namespace simdbezier::detail {
namespace {

/// Whether the normals of the two sides' patches disagree along their edge: they agree where the
/// boundaries, passed counter-clockwise, run against each other.
bool disagree(const TopologyData& topology, std::uint32_t a, std::uint32_t b) {
  const bool along = topology.sides[a].reversed() == topology.sides[b].reversed();
  return along == (counter_clockwise_along(a) == counter_clockwise_along(b));
}

/// Every patch that hangs together with an earlier one agrees with it if both are turned as
/// `turned` says; false where some edge then still disagrees.
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
        const bool wanted = turned[patch] != disagree(topology, side, other);
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

} // namespace

Status orient(bool turn, TopologyData& topology) {
  for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
    const auto sides = topology.sides_of(edge);
    topology.counts.turned_edges +=
        sides.size() == 2 && disagree(topology, sides[0], sides[1]) ? 1 : 0;
  }
  if (topology.counts.turned_edges == 0) {
    return Status::ok;
  }
  std::vector<bool> turned(topology.patches());
  topology.counts.orientable = turn_all(topology, turned);
  if (!turn) {
    return Status::ok;
  }
  if (!topology.counts.orientable) {
    return Status::not_orientable;
  }
  for (std::size_t patch = 0; patch < topology.patches(); ++patch) {
    if (turned[patch]) {
      topology.flags[patch] |= kTurned;
    }
  }
  return Status::ok;
}

} // namespace simdbezier::detail
