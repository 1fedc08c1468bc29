// The bound on the distance between a patch and the triangles of its cells; proofs are in
// docs/tessellation.md.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "src/tables/rate_task.hpp"

namespace simdbezier::detail {

/// The larger of two bounds; infinity where one of them is no number, because comparisons with nan
/// would pass it over.
inline double larger_bound(double a, double b) {
  return b <= a ? a : b > a ? b : std::numeric_limits<double>::infinity();
}

/// Largest value of (l0 l1 a + l0 l2 b + l1 l2 c) / 2 over the triangle, a, b, c >= 0: s/8 with s
/// the largest of them where that one is at least half of the sum, else half of the square of a
/// circumradius.
///
/// Where one of them is far smaller than the rest, differences of their products would have few
/// correct digits; differences of sorted neighbours keep theirs.
inline double triangle_bound(double a, double b, double c) {
  const double least = std::min({a, b, c});
  const double largest = std::max({a, b, c});
  const double middle = std::max(std::min(a, b), std::min(std::max(a, b), c));
  const double excess = (largest - middle) - least;
  if (excess >= 0) {
    return largest / 8;
  }
  return least * middle * largest / (2 * (4 * least * middle - excess * excess));
}

/// Parameters of samples are rounded: one of n steps may be longer than 1/n by this factor.
inline double step_slack(double n) { return 1 + kStepRounding * n; }

/// What vertices that are off by `error` leave of a tolerance: less one rounding, so that bound and
/// error together stay below what was wanted.
inline double tolerance_less(double wanted, double error) { return wanted * (1 - 0x1p-51) - error; }

/// Bounds on second derivatives over a part of a patch, by parameters of the whole patch.
struct SecondBounds {
  double uu;
  double uv;
  double vv;
};

/// Segments in u and v.
struct CellCounts {
  std::uint32_t nu;
  std::uint32_t nv;

  [[nodiscard]] double product() const { return static_cast<double>(nu) * nv; }
};

} // namespace simdbezier::detail
