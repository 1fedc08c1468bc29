// The factors that make Bézier control points of a spline's, in one direction.
#pragma once

#include <cstddef>
#include <vector>

#include "src/splines/spline_knots.hpp"
#include "src/tables/mean_task.hpp"

namespace simdbezier::detail {

class SplineFactors {
public:
  /// Finds the spans, and the means of each. Statuses are those of SplineKnots::build(); may throw
  /// std::bad_alloc.
  [[nodiscard]] Status build(const SplineAxis& axis, std::size_t& knot);
  /// A direction that there is not: one span of one point, which is a copy.
  void build_point();

  [[nodiscard]] std::size_t spans() const noexcept { return intervals_.size(); }
  /// Points of a piece: the degree and 1.
  [[nodiscard]] std::size_t order() const noexcept { return order_; }
  [[nodiscard]] const Interval& interval(std::size_t span) const noexcept {
    return intervals_[span];
  }
  /// All means in order: where spans join, they share one.
  [[nodiscard]] const std::vector<SplineMean>& means() const noexcept { return means_; }
  /// The number of a span's first mean.
  [[nodiscard]] std::size_t begin(std::size_t span) const noexcept { return begins_[span]; }
  [[nodiscard]] const SplineMean& mean(std::size_t span, std::size_t k) const noexcept {
    return means_[begins_[span] + k];
  }
  /// All factors; those of a mean begin at SplineMean::factor.
  [[nodiscard]] const double* factors() const noexcept { return factors_.data(); }
  /// Points after which they begin again.
  [[nodiscard]] std::size_t period() const noexcept { return period_; }

private:
  void add_span(const SplineKnots& knots, std::size_t span);
  void add_mean(const TwoDoubles* factors, std::size_t first);

  std::size_t order_ = 1;
  std::size_t period_ = ~std::size_t{0};
  std::vector<Interval> intervals_;
  std::vector<SplineMean> means_;
  std::vector<std::size_t> begins_; ///< of the means of each span
  std::vector<double> factors_;
};

} // namespace simdbezier::detail
