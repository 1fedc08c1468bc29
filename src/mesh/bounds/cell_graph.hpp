// The two triangles of a cell as a graph over a plane, and how far a piece of the surface is above,
// below and beside it: docs/tessellation.md has the proof.
#pragma once

#include <array>
#include <cstddef>

#include "src/mesh/net_points.hpp"

namespace simdbezier::detail {

/// Channels of a homogeneous point: x, y, z and the weight.
inline constexpr std::size_t kChannels = 4;

/// How far points are from a graph: above and below it along its axis, and outside of it, across
/// the axis, or, of points of a side, on the inside of that. All are 0 or more.
struct GraphDistance {
  double above = 0;
  double below = 0;
  double outside = 0;
  double inside = 0;

  void include(const GraphDistance& other);
};

/// The corners of a cell are A, B, C, D in turns, and A and C are the ends of its diagonal. The
/// axis is perpendicular to both diagonals, so that A and C have one height, which is 0, and B and
/// D another one. Along the axis, the plane of ABC is k0 y high and that of ACD k1 y, y being the
/// coordinate across AC.
class CellGraph {
public:
  /// Homogeneous corners; false where the quadrangle that is seen along the axis is not convex, or
  /// too thin, or triangles are too steep. doubt: no more than roundings of points.
  [[nodiscard]] bool set(const std::array<const double*, 4>& corners, double doubt);
  /// Writes a homogeneous point in the graph's own axes.
  void turn(const double* from, double* to) const;

  /// A bound on the distances of all points of the hull of `count` turned homogeneous points, or on
  /// heights alone.
  [[nodiscard]] GraphDistance of_hull(const double* points, std::size_t count,
                                      bool heights_alone = false) const;
  /// The same for points near one side, from that side: 0 is AB, 1 BC, 2 CD, 3 DA. Heights are
  /// those over the graph and over the plane of the side's triangle, whichever are larger.
  [[nodiscard]] GraphDistance from_side(std::size_t side, const double* points,
                                        std::size_t count) const;
  /// The largest slope.
  [[nodiscard]] double slope() const { return slope_; }

private:
  struct Place {
    double x;
    double y;
  };
  /// From `from` to the next corner, with its direction of length 1, or 0 where they are one.
  struct Side {
    Place from;
    Place along;
    double length;
  };
  [[nodiscard]] static double from_segment(const Side& side, double x, double y);
  [[nodiscard]] double outside(double x, double y) const;

  Point3 origin_;
  std::array<Point3, 3> axis_;
  std::array<Side, 4> side_;
  double rise_[2]; ///< k0 and k1
  double slope_;
  double doubt_;
  bool is_ridge_; ///< the lower one of both planes is the graph
};

} // namespace simdbezier::detail
