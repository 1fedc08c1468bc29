#include <tools/formats/surfaces/parameter_boundary.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace simdbezier::tools {

namespace {

constexpr double kTolerance = 1e-6; // of a side

using Point = ParameterBoundary::Point;

struct Box {
  Point low;
  Point high;

  /// Whether all points are on the same side.
  [[nodiscard]] bool has_on_one_side(std::span<const Point> points) const {
    for (std::size_t c = 0; c < 2; ++c) {
      for (const double side : {low[c], high[c]}) {
        if (std::ranges::all_of(points, [&](const Point& p) {
              return std::abs(p[c] - side) <= kTolerance * (high[c] - low[c]);
            })) {
          return true;
        }
      }
    }
    return false;
  }
};

std::optional<Interval> narrowed(const Interval& range, const Interval& to) {
  const double margin = kTolerance * range.length();
  const Interval part = {to.begin > range.begin + margin ? to.begin : range.begin,
                         to.end < range.end - margin ? to.end : range.end};
  const bool fits = to.begin >= range.begin - margin && to.end <= range.end + margin;
  return fits && part.begin < part.end ? std::optional(part) : std::nullopt;
}

} // namespace

void ParameterBoundary::append(std::span<const Point> points, bool is_curved) {
  if (is_curved) {
    curved_.push_back({points_.size(), points.size()});
  }
  points_.insert(points_.end(), points.begin(), points.end());
}

// Each pair of points, and each curve, lies on one side; then the area says whether they go round
// once.
std::optional<PatchInterval> ParameterBoundary::rectangle() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box = {{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (const Point& p : points_) {
    for (std::size_t c = 0; c < 2; ++c) {
      box.low[c] = std::min(box.low[c], p[c]);
      box.high[c] = std::max(box.high[c], p[c]);
    }
  }
  const double width = box.high[0] - box.low[0];
  const double height = box.high[1] - box.low[1];
  double area = 0; // of the unit square
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point side[2] = {points_[k], points_[(k + 1) % points_.size()]};
    if (!box.has_on_one_side(side)) {
      return std::nullopt;
    }
    const auto along = [&](const Point& p) { return (p[0] - box.low[0]) / width; };
    const auto across = [&](const Point& p) { return (p[1] - box.low[1]) / height; };
    area += (along(side[0]) * across(side[1]) - along(side[1]) * across(side[0])) / 2;
  }
  const bool is_once = std::abs(std::abs(area) - 1) <= 8 * kTolerance; // not where it is nan
  const bool is_along_sides = std::ranges::all_of(curved_, [&](const Curve& curve) {
    return box.has_on_one_side(std::span(points_).subspan(curve.first, curve.count));
  });
  if (!is_once || !is_along_sides) {
    return std::nullopt;
  }
  return PatchInterval{{box.low[0], box.high[0]}, {box.low[1], box.high[1]}};
}

Interval range_of(const SplineDirection& direction) {
  return direction.range.empty()
             ? Interval{direction.knots[static_cast<std::size_t>(direction.degree)],
                        direction.knots[direction.points]}
             : direction.range;
}

std::optional<Interval> part_of_domain(const Interval& domain, const Interval& range) {
  constexpr double kCutOff = 1e-9; // of the domain
  const double margin = kCutOff * domain.length();
  const Interval part = {std::max(range.begin, domain.begin), std::min(range.end, domain.end)};
  const bool fits = range.begin >= domain.begin - margin && range.end <= domain.end + margin;
  return fits && part.begin < part.end ? std::optional(part) : std::nullopt;
}

bool narrow(Interval& u, Interval& v, const PatchInterval& rectangle) {
  const auto new_u = narrowed(u, rectangle.u);
  const auto new_v = narrowed(v, rectangle.v);
  if (!new_u || !new_v) {
    return false;
  }
  u = *new_u;
  v = *new_v;
  return true;
}

} // namespace simdbezier::tools
