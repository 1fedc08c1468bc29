// Boundaries of surfaces in the plane of their parameters, and the part that they leave.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <tools/formats/surfaces/file_spline.hpp>

namespace simdbezier::tools {

/// The control points of curves, one after the other, which close.
class ParameterBoundary {
public:
  using Point = std::array<double, 2>;

  /// Appends a line of several pieces, or a curve that ends in the first and the last point.
  void append(std::span<const Point> points, bool is_curved);
  /// Returns the rectangle around which they run once, along u and along v; nothing where they run
  /// otherwise. They may miss it by a millionth of its side, because files have approximations.
  [[nodiscard]] std::optional<PatchInterval> rectangle() const;

private:
  struct Curve {
    std::size_t first;
    std::size_t count;
  };
  std::vector<Point> points_;
  std::vector<Curve> curved_;
};

/// Returns the range of a direction, which is its whole domain where it has none.
[[nodiscard]] Interval range_of(const SplineDirection& direction);
/// Returns the part of a domain that a file asks for, which may reach beyond the domain by what
/// digits that are cut off make of it; nothing where it is no part.
[[nodiscard]] std::optional<Interval> part_of_domain(const Interval& domain, const Interval& range);
/// Leaves a rectangle of a surface. Sides that are within a millionth of the surface's stay.
/// Returns whether it is a part; otherwise nothing changes.
[[nodiscard]] bool narrow(Interval& u, Interval& v, const PatchInterval& rectangle);

} // namespace simdbezier::tools
