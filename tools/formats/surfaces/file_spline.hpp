// Splines with knots as files have them, on their way to patches.
#pragma once

#include <cstddef>
#include <vector>

#include <simdbezier/splines.hpp>

namespace simdbezier::tools {

/// One direction of a spline surface of a file; see splines.hpp for what the members mean.
struct SplineDirection {
  int degree = 3;
  std::size_t points = 0;
  std::vector<double> knots; ///< points + degree + 1 of them; periodic: points + 1
  Interval range = {};       ///< empty: the whole domain
  bool periodic = false;
};

/// A spline surface of a file. Readers have checked that points are finite and weights above 0.
struct FileSpline {
  std::size_t line = 0; ///< where it begins
  SplineDirection u;
  SplineDirection v;
  Weights weights = Weights::none;
  std::vector<double> points; ///< x y z or x y z w, u fastest, u.points * v.points of them
  bool merges_knots = true; ///< false for ends of pieces that stand apart, each as often as it must
};

/// What is left of it when its patches have been added. Knots that count as equal are equal.
struct SplineRecord {
  std::size_t line = 0;
  SplineDirection u;
  SplineDirection v;
  bool rational = false;
  std::size_t first_patch = 0;
  SpanCounts spans;
};

} // namespace simdbezier::tools
