// A Bézier patch by de Casteljau's algorithm: point, tangents and normal of any degrees.
#pragma once

#include <cstddef>
#include <vector>

#include "curve.hpp"
#include "point.hpp"

namespace seed {

/// Control point P[j][i] is points[j * (degree_u + 1) + i]: row j runs in v, column i in u.
struct Net {
  std::size_t degree_u = 3;
  std::size_t degree_v = 3;
  std::vector<Point> points;

  [[nodiscard]] std::vector<Point> row(std::size_t j) const {
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(j * (degree_u + 1));
    return {first, first + static_cast<std::ptrdiff_t>(degree_u + 1)};
  }
};

struct PatchPoint {
  Point position;
  Point du;
  Point dv;
  Point normal; ///< du x dv, unit length; the zero vector where the two are parallel
};

/// The rows are curves in u. Their points at u are the control points of a curve in v that lies on
/// the patch, and so are their derivatives those of the curve of u-tangents.
inline PatchPoint patch_point(const Net& net, double u, double v) {
  std::vector<Point> across;
  std::vector<Point> tangents;
  for (std::size_t j = 0; j <= net.degree_v; ++j) {
    const CurvePoint on_row = de_casteljau(net.row(j), u);
    across.push_back(on_row.position);
    tangents.push_back(on_row.derivative);
  }
  const CurvePoint on_patch = de_casteljau(across, v);
  PatchPoint result{on_patch.position, de_casteljau(tangents, v).position, on_patch.derivative, {}};
  const Point n = cross(result.du, result.dv);
  if (length(n) > 0) {
    result.normal = (1 / length(n)) * n;
  }
  return result;
}

} // namespace seed
