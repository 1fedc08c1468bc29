// Which open sides run along a part of another one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "src/mesh/net_points.hpp"
#include "src/mesh/topology/net_corners.hpp"
#include "src/mesh/topology/side_curve.hpp"
#include "src/mesh/topology/snapping.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier::detail {

/// Parameters are multiples of u, so that those counted from the other end are exact as well.
template <typename S>
constexpr double kRoundoff = double{std::numeric_limits<S>::epsilon()} / 2;

/// An open side that runs along the part from t0 to t1 of another one.
struct Along {
  std::uint32_t side; ///< the longer one
  double t0;
  double t1;
  double distance; ///< of the two, at most
};

/// Finds open sides along parts of others.
template <typename S>
class AlongFinder {
public:
  AlongFinder(const NetCorners<S>& nets, const TopologyData& topology, double snap) : snap_(snap) {
    PointBox box;
    for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
      const auto sides = topology.sides_of(edge);
      if (sides.size() == 1) {
        OpenSide open{sides[0], {}, 0};
        nets.read_side(open.side, open.net);
        const double size = open.net.reach(open.net.points.front());
        if (std::isfinite(size)) { // others have no place among the rest
          open.near = std::max(snap, size / 32);
          box.include(open.net.points.front());
          open_.push_back(open);
        }
      }
    }
    for (std::size_t c = 1; c < 3; ++c) {
      axis_ = box.high(c) - box.low(c) > box.high(axis_) - box.low(axis_) ? c : axis_;
    }
    sort_range(open_.begin(), open_.end(), [&](const OpenSide& a, const OpenSide& b) {
      return a.place(axis_) != b.place(axis_) ? a.place(axis_) < b.place(axis_) : a.side < b.side;
    });
  }

  [[nodiscard]] std::vector<Along> find() const {
    std::vector<Along> found;
    for (const OpenSide& longer : open_) {
      PointBox box;
      for (const Point3& point : longer.net.points) {
        box.include(point);
      }
      const SideCurve curve(longer.net);
      const double margin = std::max(snap_, box.diagonal() / 32);
      auto at = std::lower_bound(
          open_.begin(), open_.end(), box.low(axis_) - margin,
          [&](const OpenSide& open, double low) { return open.place(axis_) < low; });
      for (; at != open_.end() && at->place(axis_) <= box.high(axis_) + margin; ++at) {
        if (at->side != longer.side && box.reaches(at->net.points.front(), at->near) &&
            box.reaches(at->net.points.back(), at->near)) {
          compare(longer.side, curve, *at, found);
        }
      }
    }
    return found;
  }

private:
  struct OpenSide {
    std::uint32_t side;
    SideNet net;
    double near; ///< what is farther away is something else
    [[nodiscard]] double place(std::size_t axis) const { return net.points.front().x[axis]; }
  };

  /// A nearby fraction of a small denominator instead, where it is as close to the point: the part
  /// of a half then has the control points of the half.
  [[nodiscard]] double rounded(const SideCurve& curve, const Point3& point, double t) const {
    const double distance = std::max(snap_, length(curve.at(t) - point));
    for (int q = 1; q <= 16; ++q) {
      const double fraction = std::round(t * q) / q;
      if (std::fabs(fraction - t) <= 1e-5 && length(curve.at(fraction) - point) <= distance) {
        t = fraction;
        break;
      }
    }
    return std::round(t / kRoundoff<S>) * kRoundoff<S>;
  }
  [[nodiscard]] std::vector<double> parameters(const SideCurve& curve, const Point3& point,
                                               double near) const {
    std::vector<double> found;
    curve.for_nearest(point, [&](double t) {
      if (length(curve.at(t) - point) <= near) {
        found.push_back(rounded(curve, point, t));
      }
    });
    return found;
  }
  void compare(std::uint32_t side, const SideCurve& curve, const OpenSide& other,
               std::vector<Along>& found) const {
    Along best{side, 0, 0, HUGE_VAL};
    const std::vector<double> begins = parameters(curve, other.net.points.front(), other.near);
    if (begins.empty()) {
      return; // as usual
    }
    const std::vector<double> ends = parameters(curve, other.net.points.back(), other.near);
    for (const double t0 : begins) {
      for (const double t1 : ends) {
        const bool is_part = std::fabs(t1 - t0) > 64 * kRoundoff<S> && std::fabs(t1 - t0) < 1;
        const double distance =
            is_part ? distance_of(curve.part(t0, t1), other.net, false) : HUGE_VAL;
        best = distance < best.distance ? Along{side, t0, t1, distance} : best;
      }
    }
    if (best.distance <= other.near) {
      found.push_back(best);
    }
  }

  double snap_;
  std::vector<OpenSide> open_; ///< by where they begin on the axis along which they are spread most
  std::size_t axis_ = 0;
};

} // namespace simdbezier::detail
