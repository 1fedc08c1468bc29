#include "src/mesh/topology/snapping.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/runtime/both_types.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier::detail {
namespace {

/// A curve with its degree raised by one: the same points at the same parameters.
void raise(SideNet& curve) {
  const std::size_t degree = curve.points.size();
  SideNet raised;
  for (std::size_t k = 0; k <= degree; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(degree);
    const std::size_t before = k == 0 ? 0 : k - 1;
    const std::size_t own = std::min(k, degree - 1);
    const double of_before = k == 0 ? 0 : share * curve.weights[before];
    const double of_own = k == degree ? 0 : (1 - share) * curve.weights[own];
    const double weight = of_before + of_own;
    Point3 point;
    for (std::size_t c = 0; c < 3; ++c) {
      point.x[c] =
          (of_before * curve.points[before].x[c] + of_own * curve.points[own].x[c]) / weight;
    }
    // Ends stay what they are.
    raised.points.push_back(k == 0        ? curve.points.front()
                            : k == degree ? curve.points.back()
                                          : point);
    raised.weights.push_back(weight);
  }
  curve = raised;
}

/// Divides by the largest weight, which does not change the curve.
void scale_weights(SideNet& curve) {
  const double largest = *std::max_element(curve.weights.begin(), curve.weights.end());
  for (double& weight : curve.weights) {
    weight /= largest;
  }
}

bool same_weights(const SideNet& a, const SideNet& b, bool reversed) {
  bool same = a.weights.size() == b.weights.size();
  for (std::size_t k = 0; same && k < a.weights.size(); ++k) {
    same = a.weights[k] == b.weights[reversed ? b.weights.size() - 1 - k : k];
  }
  return same;
}

/// The largest distance between control points of two curves of one degree; infinite where one is
/// no number.
double control_distance(const SideNet& a, const SideNet& b, bool reversed) {
  double most = 0;
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    const double distance = length(a.points[k] - b.points[reversed ? a.points.size() - 1 - k : k]);
    most = distance <= most ? most : distance < HUGE_VAL ? distance : HUGE_VAL;
  }
  return most;
}

/// A side by the cell that the middle between its ends is in: whichever way it runs, a side that
/// matches is in the same cell or in one next to it.
struct PlacedSide {
  std::array<double, 3> cell;
  std::uint32_t side;

  friend bool operator<(const PlacedSide& a, const PlacedSide& b) { return a.cell < b.cell; }
};

struct Match {
  double distance;
  std::uint32_t a; ///< an open side
  std::uint32_t b; ///< another one, or a point
  bool to_point;
  bool reversed;

  friend bool operator<(const Match& x, const Match& y) {
    return x.distance != y.distance ? x.distance < y.distance : x.a != y.a ? x.a < y.a : x.b < y.b;
  }
};

/// Finds which open sides match each other, or a point.
template <typename S>
class SideMatcher {
public:
  SideMatcher(const NetCorners<S>& nets, double distance, const EdgeRings& rings)
      : nets_(nets), distance_(distance), rings_(rings) {
    SideNet net;
    for (std::uint32_t side = 0; side < rings.next.size(); ++side) {
      if (!rings.is_alone(side) && !rings.is_point(side)) {
        continue;
      }
      nets.read_side(side, net);
      PlacedSide placed{{}, side};
      bool finite = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const double middle = (net.points.front().x[c] + net.points.back().x[c]) / 2;
        placed.cell[c] = std::floor(place_of(middle));
        finite = finite && std::isfinite(placed.cell[c]);
      }
      if (finite) {
        sides_.push_back(placed);
      }
    }
    sort_range(sides_.begin(), sides_.end(), [](const PlacedSide& a, const PlacedSide& b) {
      return a.cell != b.cell ? a.cell < b.cell : a.side < b.side;
    });
  }

  /// All pairs that match, the closest first.
  [[nodiscard]] std::vector<Match> find() {
    std::vector<Match> matches;
    for (const PlacedSide& open : sides_) {
      if (!rings_.is_alone(open.side)) {
        continue;
      }
      nets_.read_side(open.side, own_);
      for (int k = 0; k < 27; ++k) {
        PlacedSide next = open;
        const double steps[3] = {k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
        for (std::size_t c = 0; c < 3; ++c) {
          next.cell[c] += steps[c];
        }
        const auto range = std::equal_range(sides_.begin(), sides_.end(), next);
        for (auto at = range.first; at != range.second; ++at) {
          if (at->side > open.side || rings_.is_point(at->side)) {
            compare(open.side, at->side, matches);
          }
        }
      }
    }
    sort_range(matches.begin(), matches.end());
    return matches;
  }

private:
  /// A coordinate on a scale whose steps are the distance plus 2^-40 of the coordinate, which is
  /// more than all roundings: of middles, of distances, and of this.
  [[nodiscard]] double place_of(double middle) const {
    const double steps = std::log1p(std::fabs(middle) / distance_ * 0x1p-40) * 0x1p40;
    return std::copysign(steps, middle);
  }
  void compare(std::uint32_t a, std::uint32_t b, std::vector<Match>& matches) {
    nets_.read_side(b, other_);
    const double same = distance_of(own_, other_, false);
    const double opposite = distance_of(own_, other_, true);
    const double least = std::min(same, opposite);
    if (least <= distance_) {
      matches.push_back({least, a, b, rings_.is_point(b), opposite < same});
    }
  }

  const NetCorners<S>& nets_;
  double distance_;
  const EdgeRings& rings_;
  std::vector<PlacedSide> sides_;
  SideNet own_;
  SideNet other_;
};

} // namespace

double distance_of(const SideNet& a, const SideNet& b, bool reversed) {
  if (same_weights(a, b, reversed)) {
    return control_distance(a, b, reversed);
  }
  SideNet p = a;
  SideNet q = b;
  const auto degrees = static_cast<double>(std::max(a.points.size(), b.points.size()) -
                                           std::min(a.points.size(), b.points.size()));
  while (p.points.size() < q.points.size()) {
    raise(p);
  }
  while (q.points.size() < p.points.size()) {
    raise(q);
  }
  scale_weights(p);
  scale_weights(q);
  PointBox box;
  double size = 0;
  double unlike = 0;
  for (std::size_t k = 0; k < p.points.size(); ++k) {
    const double weight = p.weights[k];
    const double other = q.weights[reversed ? p.points.size() - 1 - k : k];
    const double lower = std::min(weight, other);
    unlike = lower > 0 ? std::max(unlike, std::fabs(weight - other) / lower) : HUGE_VAL;
    for (const Point3& point : {p.points[k], q.points[k]}) {
      box.include(point);
      size = std::max(size, length(point));
    }
  }
  // Scaling weights errs by a rounding of each, and raising a degree by 8 of points and 3 of
  // weights.
  const double rounding = 0x1p-53 * (8 + 32 * degrees) * size;
  const double distance = control_distance(p, q, reversed) + unlike * box.diagonal() + rounding;
  return distance < HUGE_VAL ? distance : HUGE_VAL;
}

template <typename S>
std::size_t snap_sides(const NetCorners<S>& nets, double distance, EdgeRings& rings) {
  std::size_t snapped = 0;
  for (const Match& match : SideMatcher<S>(nets, distance, rings).find()) {
    if (!rings.is_alone(match.a)) {
      continue;
    }
    if (match.to_point) {
      rings.make_point(match.a);
    } else if (rings.is_alone(match.b)) {
      rings.link(match.a, match.b);
      rings.turned[match.b] = rings.turned[match.a] ^ (match.reversed ? 1 : 0);
      snapped += 2;
    }
  }
  return snapped;
}

template <typename S>
double distance_from_joint(const NetCorners<S>& nets, const TopologyData& topology,
                           std::size_t side) {
  SideNet own;
  nets.read_side(side, own);
  const Side& at = topology.sides[side];
  if (at.collapsed()) {
    return std::max(own.reach(nets.corner_point(topology.corner_of(side, 0))),
                    own.reach(nets.corner_point(topology.corner_of(side, 1))));
  }
  SideNet first;
  nets.read_side(topology.sides_of(at.edge())[0], first);
  return distance_of(own, first, at.reversed());
}

template <typename S>
std::vector<double> find_displacements(const NetCorners<S>& nets, const TopologyData& topology) {
  std::vector<double> displacements(topology.patches());
  for (std::size_t k = 0; k < kPatchEdges * displacements.size(); ++k) { // sides, and corners
    const Point3 way = nets.corner_point(k) - nets.corner_point(topology.corners[k]);
    double& own = displacements[k / kPatchEdges];
    own = std::max({own, distance_from_joint(nets, topology, k), length(way)});
  }
  return displacements;
}

SIMDBEZIER_OF_BOTH_TYPES(snap_sides);
SIMDBEZIER_OF_BOTH_TYPES(distance_from_joint);
SIMDBEZIER_OF_BOTH_TYPES(find_displacements);

} // namespace simdbezier::detail
