#include "tests/mesh/support/mesh_oracle.hpp"

#include <algorithm>
#include <limits>

namespace simdbezier::tests {

double squared_distance(const Point& point, const std::array<Point, 3>& triangle) {
  const Point e = triangle[1] - triangle[0];
  const Point f = triangle[2] - triangle[0];
  const Point d = point - triangle[0];
  const double ee = dot(e, e);
  const double ef = dot(e, f);
  const double ff = dot(f, f);
  const double determinant = ee * ff - ef * ef;
  const double s = (dot(d, e) * ff - dot(d, f) * ef) / determinant;
  const double r = (dot(d, f) * ee - dot(d, e) * ef) / determinant;
  if (determinant > 0 && s >= 0 && r >= 0 && s + r <= 1) {
    const Point foot = d - (s * e + r * f);
    return dot(foot, foot);
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Point side = triangle[(k + 1) % 3] - triangle[k];
    const Point from = point - triangle[k];
    const double square = dot(side, side);
    const double along = square > 0 ? std::clamp(dot(from, side) / square, 0.0, 1.0) : 0;
    const Point rest = from - along * side;
    least = std::min(least, dot(rest, rest));
  }
  return least;
}

} // namespace simdbezier::tests
