#include "src/mesh/topology/marks.hpp"

#include <algorithm>
#include <atomic>

#include "src/runtime/batch.hpp"
#include "src/runtime/sort.hpp"

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

/// Whether an edge has two sides whose normals disagree.
bool is_turned_edge(const TopologyData& topology, std::size_t edge) {
  const auto sides = topology.sides_of(edge);
  return sides.size() == 2 && topology.disagree(sides[0], sides[1]);
}

std::size_t count_turned_edges(const TopologyData& topology, int threads) {
  std::atomic<std::size_t> all = 0;
  auto body = [&](int, std::size_t begin, std::size_t end) {
    std::size_t turned = 0;
    for (std::size_t edge = begin; edge < end; ++edge) {
      turned += is_turned_edge(topology, edge) ? 1 : 0;
    }
    all += turned;
  };
  divide_work(topology.edges(), 3, threads, body);
  return all;
}

/// Marks those of joined corners to which no row of agreeing edges leads from the lowest one.
class ApartCorners {
public:
  explicit ApartCorners(TopologyData& topology)
      : topology_(topology), reached_(topology.corners.size()), passed_(topology.edges()) {}

  void mark(std::uint32_t lowest) {
    reach(lowest);
    while (!open_.empty()) {
      const std::uint32_t corner = open_.back();
      open_.pop_back();
      const std::size_t patch = corner / kPatchCorners;
      for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
        for (std::size_t end = 0; end < 2; ++end) {
          if (corner_at(side, end) == corner) {
            pass(side, end);
          }
        }
      }
    }
    topology_.for_joined(lowest, [&](std::size_t k) {
      topology_.apart[k / kPatchCorners] |=
          static_cast<std::uint8_t>(reached_[k] ? 0 : kApartCorner << k % kPatchCorners);
    });
  }

private:
  void reach(std::uint32_t corner) {
    if (!reached_[corner]) {
      reached_[corner] = true;
      open_.push_back(corner);
    }
  }
  /// Reaches what an end of a side leads to. All sides of an edge lead to the same corners, so that
  /// each of its ends is passed once, however many sides there are.
  void pass(std::size_t side, std::size_t end) {
    const Side own = topology_.sides[side];
    if (own.collapsed()) {
      reach(corner_at(side, 1 - end));
      return;
    }
    const std::size_t edge_end = own.reversed() ? 1 - end : end;
    if ((passed_[own.edge()] >> edge_end & 1) != 0 || is_turned_edge(topology_, own.edge())) {
      return;
    }
    passed_[own.edge()] |= static_cast<std::uint8_t>(1U << edge_end);
    for (const std::uint32_t other : topology_.sides_of(own.edge())) {
      reach(corner_at(other, topology_.sides[other].reversed() ? 1 - edge_end : edge_end));
    }
  }

  TopologyData& topology_;
  std::vector<bool> reached_;        ///< corners
  std::vector<std::uint8_t> passed_; ///< of each edge: 1 << end
  std::vector<std::uint32_t> open_;  ///< corners that have been reached, but not left
};

} // namespace

Status orient(const TopologyOptions& options, int threads, TopologyData& topology) {
  topology.counts.turned_edges = count_turned_edges(topology, threads);
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
  for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
    if (is_turned_edge(topology, edge)) {
      const std::uint32_t a = topology.sides_of(edge)[0];
      const std::uint32_t b = topology.sides_of(edge)[1];
      topology.apart.resize(topology.patches());
      topology.apart[b / kPatchEdges] |= static_cast<std::uint8_t>(kApartSide << b % kPatchEdges);
      corners.insert(corners.end(), {topology.corner_of(a, 0), topology.corner_of(a, 1)});
    }
  }
  sort_range(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  ApartCorners apart(topology);
  for (const std::uint32_t corner : corners) {
    apart.mark(corner);
  }
}

} // namespace simdbezier::detail
