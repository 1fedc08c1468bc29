// The knots of one direction of a spline: checked, and cut into spans.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <simdbezier/splines.hpp>

#include "src/splines/two_doubles.hpp"

namespace simdbezier::detail {

/// One direction of a spline as it is given.
struct SplineAxis {
  int degree = 0;
  std::size_t points = 0;
  bool periodic = false;
  std::span<const double> knots;
  Interval range;
  double tolerance = 0;
};

/// A span: pieces are means of points first to first + degree, modulo the number of points.
struct SplineSpan {
  Interval interval;
  std::size_t first;
};

class SplineKnots {
public:
  /// Checks the axis and finds its spans. Returns ok | bad_degree | bad_grid | size_overflow |
  /// bad_knots, with the number of the knot, | bad_range; may throw std::bad_alloc.
  [[nodiscard]] Status build(const SplineAxis& axis, std::size_t& knot);

  [[nodiscard]] const std::vector<SplineSpan>& spans() const noexcept { return spans_; }
  [[nodiscard]] int degree() const noexcept { return degree_; }
  /// Points after which they begin again; more than there are where they do not.
  [[nodiscard]] std::size_t period() const noexcept { return period_; }

  /// The knots around a span, as if the spline were not periodic: T_k in the terms of splines.hpp,
  /// for k from span.first + 1 to span.first + 2 degree.
  [[nodiscard]] TwoDoubles knot(std::size_t k) const noexcept;
  /// Whether the piece that ends where this span begins (the last one, where the spline is closed)
  /// has its end point here as well.
  [[nodiscard]] bool joins_previous(std::size_t span) const noexcept;

private:
  [[nodiscard]] Status take_knots(const SplineAxis& axis, std::size_t& knot);
  [[nodiscard]] Status check_multiplicity(std::size_t& knot) const noexcept;
  /// Ends of a range that are no further from a knot than knots that count as equal are that knot.
  [[nodiscard]] Interval with_knots(Interval range, double tolerance) const noexcept;
  void find_spans(const Interval& range);

  int degree_ = 0;
  bool periodic_ = false;
  std::size_t points_ = 0;
  std::size_t period_ = 0;
  std::vector<double> knots_; ///< scaled, where they are near the end of the range of doubles
  std::vector<SplineSpan> spans_;
};

} // namespace simdbezier::detail
