// See snapping.hpp.
#include "src/mesh/topology/snapping.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace simdbezier::detail {
namespace {

/// The largest distance between points of two sides, one by one; infinite where they cannot be
/// compared.
double distance_of(const SideNet& a, const SideNet& b, bool reversed) {
  if (a.points.size() != b.points.size()) {
    return HUGE_VAL;
  }
  double most = 0;
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    const std::size_t l = reversed ? a.points.size() - 1 - k : k;
    const double distance = length(a.points[k] - b.points[l]);
    if (a.weights[k] != b.weights[l] || !(distance < HUGE_VAL)) {
      return HUGE_VAL;
    }
    most = std::max(most, distance);
  }
  return most;
}

/// An open side by the cell that the middle between its ends is in: whichever way it runs, a side
/// that matches is in the same cell or in one next to it.
struct OpenSide {
  std::array<double, 3> cell;
  std::uint32_t side;

  friend bool operator<(const OpenSide& a, const OpenSide& b) { return a.cell < b.cell; }
};

struct Match {
  double distance;
  std::uint32_t a;
  std::uint32_t b;
  bool reversed;

  friend bool operator<(const Match& x, const Match& y) {
    return x.distance != y.distance ? x.distance < y.distance : x.a != y.a ? x.a < y.a : x.b < y.b;
  }
};

template <typename S>
class SideMatcher {
public:
  SideMatcher(const NetCorners<S>& nets, double distance, const EdgeRings<std::uint32_t>& rings)
      : nets_(nets), distance_(distance) {
    SideNet net;
    for (std::uint32_t side = 0; side < rings.next.size(); ++side) {
      if (!rings.is_alone(side)) {
        continue;
      }
      nets.read_side(side, net);
      OpenSide open{{}, side};
      bool finite = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const double middle = (net.points.front().x[c] + net.points.back().x[c]) / 2;
        open.cell[c] = std::floor(middle / distance);
        finite = finite && std::isfinite(open.cell[c]);
      }
      if (finite) {
        open_.push_back(open);
      }
    }
    std::sort(open_.begin(), open_.end(), [](const OpenSide& a, const OpenSide& b) {
      return a.cell != b.cell ? a.cell < b.cell : a.side < b.side;
    });
  }

  /// All pairs that match, the closest first.
  [[nodiscard]] std::vector<Match> find() {
    std::vector<Match> matches;
    for (const OpenSide& open : open_) {
      nets_.read_side(open.side, own_);
      for (int k = 0; k < 27; ++k) {
        OpenSide next = open;
        const double steps[3] = {k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
        for (std::size_t c = 0; c < 3; ++c) {
          next.cell[c] += steps[c];
        }
        const auto range = std::equal_range(open_.begin(), open_.end(), next);
        for (auto at = range.first; at != range.second; ++at) {
          if (at->side > open.side) {
            compare(open.side, at->side, matches);
          }
        }
      }
    }
    std::sort(matches.begin(), matches.end());
    return matches;
  }

private:
  void compare(std::uint32_t a, std::uint32_t b, std::vector<Match>& matches) {
    nets_.read_side(b, other_);
    const double same = distance_of(own_, other_, false);
    const double opposite = distance_of(own_, other_, true);
    const double least = std::min(same, opposite);
    if (least <= distance_) {
      matches.push_back({least, a, b, opposite < same});
    }
  }

  const NetCorners<S>& nets_;
  double distance_;
  std::vector<OpenSide> open_;
  SideNet own_;
  SideNet other_;
};

} // namespace

template <typename S>
std::size_t snap_sides(const NetCorners<S>& nets, double distance,
                       EdgeRings<std::uint32_t>& rings) {
  std::size_t snapped = 0;
  for (const Match& match : SideMatcher<S>(nets, distance, rings).find()) {
    if (rings.is_alone(match.a) && rings.is_alone(match.b)) {
      rings.next[match.a] = match.b;
      rings.next[match.b] = match.a;
      rings.turned[match.b] = rings.turned[match.a] ^ (match.reversed ? 1 : 0);
      snapped += 2;
    }
  }
  return snapped;
}

template <typename S>
void find_displacements(const NetCorners<S>& nets, TopologyData& topology) {
  topology.displacement.assign(topology.patches(), 0);
  SideNet own;
  SideNet first;
  for (std::size_t side = 0; side < topology.sides.size(); ++side) {
    double& displacement = topology.displacement[side / kPatchEdges];
    nets.read_side(side, own);
    for (std::size_t end = 0; end < 2; ++end) {
      const Point3 vertex = nets.corner_point(topology.corner_of(side, end));
      const Point3 d = (end == 0 ? own.points.front() : own.points.back()) - vertex;
      displacement = std::max(displacement, length(d));
      if (topology.sides[side].collapsed()) {
        displacement = std::max(displacement, own.reach(vertex));
      }
    }
    if (!topology.sides[side].collapsed()) {
      nets.read_side(topology.sides_of(topology.sides[side].edge())[0], first);
      const double moved = distance_of(own, first, topology.sides[side].reversed());
      displacement = std::max(displacement, moved);
    }
  }
}

template std::size_t snap_sides(const NetCorners<float>&, double, EdgeRings<std::uint32_t>&);
template std::size_t snap_sides(const NetCorners<double>&, double, EdgeRings<std::uint32_t>&);
template void find_displacements(const NetCorners<float>&, TopologyData&);
template void find_displacements(const NetCorners<double>&, TopologyData&);

} // namespace simdbezier::detail
