#include "src/mesh/bounds/cell_graph.hpp"

#include <algorithm>
#include <cmath>

namespace simdbezier::detail {
namespace {

constexpr double kSteepest = 2;
/// Of the diagonals' sine.
constexpr double kThinnest = 1e-7;

Point3 divided(const Point3& a, double by) { return {a.x[0] / by, a.x[1] / by, a.x[2] / by}; }

} // namespace

void GraphDistance::include(const GraphDistance& other) {
  above = std::max(above, other.above);
  below = std::max(below, other.below);
  outside = std::max(outside, other.outside);
  inside = std::max(inside, other.inside);
}

bool CellGraph::set(const std::array<const double*, 4>& corners, double doubt) {
  std::array<Point3, 4> p;
  for (std::size_t k = 0; k < 4; ++k) {
    p[k] = divided({{corners[k][0], corners[k][1], corners[k][2]}}, corners[k][3]);
  }
  doubt_ = doubt;
  origin_ = p[0];
  const Point3 diagonal = p[2] - p[0];
  const Point3 other = p[3] - p[1];
  const Point3 normal = cross(diagonal, other);
  const double length = std::sqrt(dot(diagonal, diagonal));
  const double area = std::sqrt(dot(normal, normal));
  if (!(area > kThinnest * length * std::sqrt(dot(other, other)))) {
    return false;
  }
  axis_[0] = divided(diagonal, length);
  axis_[2] = divided(normal, area);
  axis_[1] = cross(axis_[2], axis_[0]);
  std::array<Place, 4> at;
  for (std::size_t k = 0; k < 4; ++k) {
    const Point3 from = p[k] - origin_;
    at[k] = {dot(axis_[0], from), dot(axis_[1], from)};
  }
  // The other diagonal has to pass between the ends of this one.
  const double passes = at[1].x + (at[3].x - at[1].x) * (at[1].y / (at[1].y - at[3].y));
  if (!(passes >= -doubt && passes <= length + doubt)) {
    return false;
  }
  const double height = dot(axis_[2], p[1] - origin_);
  for (std::size_t k = 0; k < 2; ++k) {
    const double across = k == 0 ? -at[1].y : at[3].y;
    // A triangle two corners of which are one has no plane, and needs none.
    rise_[k] = across > doubt ? (k == 0 ? -height : height) / across : 0;
    if (!(across >= -doubt) || (!(across > doubt) && std::fabs(height) > doubt)) {
      return false;
    }
  }
  slope_ = std::max(std::fabs(rise_[0]), std::fabs(rise_[1]));
  is_ridge_ = height < 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Place& to = at[(k + 1) % 4];
    const double x = to.x - at[k].x;
    const double y = to.y - at[k].y;
    const double size = std::sqrt(x * x + y * y);
    side_[k] = size > doubt ? Side{at[k], {x / size, y / size}, size} : Side{at[k], {0, 0}, 0};
  }
  return slope_ <= kSteepest;
}

void CellGraph::turn(const double* from, double* to) const {
  const double w = from[3];
  const Point3 moved = {from[0] - origin_.x[0] * w, from[1] - origin_.x[1] * w,
                        from[2] - origin_.x[2] * w};
  for (std::size_t c = 0; c < 3; ++c) {
    to[c] = dot(axis_[c], moved);
  }
  to[3] = w;
}

double CellGraph::from_segment(const Side& side, double x, double y) {
  const double dx = x - side.from.x;
  const double dy = y - side.from.y;
  const double along = dx * side.along.x + dy * side.along.y;
  const double nearest = std::clamp(along, 0.0, side.length);
  const double a = dx - nearest * side.along.x;
  const double b = dy - nearest * side.along.y;
  return std::sqrt(a * a + b * b);
}

/// The distance of a place from the quadrangle, which is convex.
double CellGraph::outside(double x, double y) const {
  double most = 0;
  for (const Side& side : side_) {
    most = std::max(most, (x - side.from.x) * side.along.y - (y - side.from.y) * side.along.x);
  }
  if (most <= doubt_) {
    return 0;
  }
  double least = from_segment(side_[0], x, y);
  for (std::size_t k = 1; k < 4; ++k) {
    least = std::min(least, from_segment(side_[k], x, y));
  }
  return least;
}

GraphDistance CellGraph::of_hull(const double* points, std::size_t count,
                                 bool heights_alone) const {
  double high[2] = {0, 0}; // above either plane
  double low[2] = {0, 0};
  double out = 0;
  for (const double* point = points; point != points + count * kChannels; point += kChannels) {
    const double weight = 1 / point[3];
    const double x = point[0] * weight;
    const double y = point[1] * weight;
    const double z = point[2] * weight;
    for (std::size_t k = 0; k < 2; ++k) {
      const double above = z - rise_[k] * y;
      high[k] = std::max(high[k], above);
      low[k] = std::max(low[k], -above);
    }
    out = heights_alone ? 0 : std::max(out, outside(x, y));
  }
  // Above the lower of two planes is what is above either of them, below it what is below both.
  return is_ridge_ ? GraphDistance{std::max(high[0], high[1]), std::min(low[0], low[1]), out, 0}
                   : GraphDistance{std::min(high[0], high[1]), std::max(low[0], low[1]), out, 0};
}

GraphDistance CellGraph::from_side(std::size_t number, const double* points,
                                   std::size_t count) const {
  const Side& side = side_[number];
  GraphDistance most = of_hull(points, count, true);
  for (const double* point = points; point != points + count * kChannels; point += kChannels) {
    const double weight = 1 / point[3];
    const double above = (point[2] - rise_[number / 2] * point[1]) * weight;
    const double x = point[0] * weight - side.from.x;
    const double y = point[1] * weight - side.from.y;
    const double along = x * side.along.x + y * side.along.y;
    const double out = x * side.along.y - y * side.along.x;
    const double past = side.length > 0 ? std::max({-along, along - side.length, 0.0})
                                        : std::sqrt(x * x + y * y); // an end
    most.include({above, -above, std::max(out, 0.0) + past, std::max(-out, 0.0) + past});
  }
  return most;
}

} // namespace simdbezier::detail
