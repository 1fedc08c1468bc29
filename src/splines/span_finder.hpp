// Finds the spans of parameters.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "src/splines/spline_knots.hpp"

namespace simdbezier::detail {

/// One direction of a spline; spans near the last one are found without a search.
class SpanFinder {
public:
  SpanFinder(const SplineKnots& knots, const SplineAxis& axis) noexcept
      : spans_(knots.spans()), begin_(spans_.front().interval.begin),
        end_(spans_.back().interval.end), repeats_(axis.periodic && axis.range.empty()) {}

  /// ok | bad_range | non_finite_input; finds the parameter's span.
  [[nodiscard]] Status find(double parameter) noexcept {
    if (!std::isfinite(parameter)) {
      return Status::non_finite_input;
    }
    parameter_ = parameter;
    if (repeats_ && !(begin_ <= parameter && parameter <= end_)) {
      const double length = end_ - begin_;
      parameter_ -= length * std::floor((parameter - begin_) / length);
      parameter_ = std::min(std::max(parameter_, begin_), end_); // it is off by a rounding
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

} // namespace simdbezier::detail
