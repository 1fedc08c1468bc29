// A Bézier curve by de Casteljau's algorithm: point and derivative of any degree.
// Source: G. Farin, Curves and Surfaces for CAGD, chapter 4.
#pragma once

#include <cstddef>
#include <vector>

#include "point.hpp"

namespace seed {

struct CurvePoint {
  Point position;
  Point derivative; ///< with respect to t
};

/// C(t) and C'(t) of the curve with these control points, two or more (degree + 1 of them).
///
///     b0   b1   b2   b3       every round mixes neighbours, and so has one point less.
///       b01  b12  b23         When two are left, they span the tangent: C' = degree (b - a),
///         b012 b123           and their mix is the point.
///            C(t)
inline CurvePoint de_casteljau(std::vector<Point> b, double t) {
  const auto degree = static_cast<double>(b.size() - 1);
  for (std::size_t left = b.size() - 1; left > 1; --left) {
    for (std::size_t i = 0; i < left; ++i) {
      b[i] = mix(b[i], b[i + 1], t);
    }
  }
  return {mix(b[0], b[1], t), degree * (b[1] - b[0])};
}

} // namespace seed
