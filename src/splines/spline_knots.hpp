// The directions of splines: their knots, checked and cut into spans, and the spans of parameters.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <span>
#include <vector>

#include <simdbezier/splines.hpp>

#include "src/runtime/fp_environment.hpp"
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
  /// ok | bad_degree | bad_grid | size_overflow: what build() checks before it looks at knots.
  [[nodiscard]] static Status check_points(const SplineAxis& axis) noexcept;

  [[nodiscard]] const std::vector<SplineSpan>& spans() const noexcept { return spans_; }
  /// As they are given, but for those that count as equal.
  [[nodiscard]] const std::vector<double>& values() const noexcept { return knots_; }
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
  std::vector<double> knots_;
  std::vector<SplineSpan> spans_;
};

/// One direction of a spline; spans near the last one are found without a search.
class SpanFinder {
public:
  SpanFinder(const SplineKnots& knots, const SplineAxis& axis) noexcept
      : spans_(knots.spans()), begin_(spans_.front().interval.begin),
        end_(spans_.back().interval.end), repeats_(axis.periodic && axis.range.empty()) {}

  /// ok | bad_range | non_finite_input; finds the parameter's span. Remainders are exact, and odd:
  /// mirrored parameters are moved to mirrored places, from above to the end of the period and from
  /// below to its beginning where both would do.
  [[nodiscard]] Status find(double parameter) noexcept {
    if (!std::isfinite(parameter)) {
      return Status::non_finite_input;
    }
    parameter_ = parameter;
    if (repeats_ && !(begin_ <= parameter && parameter <= end_)) {
      const double length = end_ - begin_;
      const double near = parameter > end_ ? end_ : begin_;
      double step = std::remainder(parameter, length) - std::remainder(near, length);
      if (parameter > end_ ? step > 0 : step < 0) {
        step -= std::copysign(length, step);
      }
      parameter_ = std::min(std::max(near + step, begin_), end_); // it is off by a rounding
    }
    if (!(begin_ <= parameter_ && parameter_ <= end_)) {
      return Status::bad_range;
    }
    const Interval& last = spans_[span_].interval;
    if (!(last.begin <= parameter_ && parameter_ < last.end)) {
      const auto after = std::upper_bound(
          spans_.begin(), spans_.end(), parameter_,
          [](double at, const SplineSpan& span) { return at < span.interval.begin; });
      span_ = static_cast<std::size_t>(after - spans_.begin()) - 1;
    }
    return Status::ok;
  }

  [[nodiscard]] std::size_t span() const noexcept { return span_; }
  [[nodiscard]] double length() const noexcept { return spans_[span_].interval.length(); }
  /// The parameter in [0, 1] of the span.
  [[nodiscard]] double local() const noexcept {
    const Interval& interval = spans_[span_].interval;
    return (parameter_ - interval.begin) / interval.length();
  }
  /// In [-1, 1], such that mirrored parameters in exactly mirrored knots give mirrored values, bit
  /// for bit: 2 local() - 1 does not.
  [[nodiscard]] double centred() const noexcept {
    const Interval& interval = spans_[span_].interval;
    return ((parameter_ - interval.begin) - (interval.end - parameter_)) / interval.length();
  }

private:
  const std::vector<SplineSpan>& spans_;
  double begin_;
  double end_;
  bool repeats_;
  double parameter_ = 0;
  std::size_t span_ = 0;
};

/// 0: u, 1: v.
template <typename S>
SplineAxis axis_of(const SplineSurface<S>& surface, int direction) noexcept {
  return direction == 0 ? SplineAxis{surface.degree_u, surface.columns, surface.periodic_u,
                                     surface.knots_u,  surface.u_range, surface.knot_tolerance}
                        : SplineAxis{surface.degree_v, surface.rows,    surface.periodic_v,
                                     surface.knots_v,  surface.v_range, surface.knot_tolerance};
}

/// A curve as a surface of one row. Its direction v is none, and of degree 0.
template <typename S>
SplineSurface<S> as_surface(const SplineCurve<S>& curve) noexcept {
  SplineSurface<S> surface;
  surface.points = curve.points;
  surface.rows = 1;
  surface.columns = curve.count;
  surface.point_stride = curve.point_stride;
  surface.component_stride = curve.component_stride;
  surface.components = curve.components;
  surface.weights = curve.weights;
  surface.periodic_u = curve.periodic;
  surface.degree_u = curve.degree;
  surface.degree_v = 0;
  surface.knots_u = curve.knots;
  surface.u_range = curve.range;
  surface.knot_tolerance = curve.knot_tolerance;
  surface.memory = curve.memory;
  return surface;
}

/// What span_count() counts, of a curve as of a surface of degree 0 in v; may throw std::bad_alloc.
template <typename S>
[[nodiscard]] SpanCounts spans_of(const SplineSurface<S>& surface);

/// What a step of a call reports, in the default floating-point environment; out_of_memory where
/// it throws.
template <typename Step>
Report guarded(const Step& step) noexcept {
  const DefaultFpEnvironment environment;
  try {
    return step();
  } catch (const std::bad_alloc&) {
    return {Status::out_of_memory};
  }
}

} // namespace simdbezier::detail
