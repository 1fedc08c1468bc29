#include "src/splines/spline_knots.hpp"

#include <algorithm>
#include <cmath>

namespace simdbezier::detail {
namespace {

constexpr std::size_t kMostPoints = std::size_t{1} << 31;

} // namespace

Status SplineKnots::check_points(const SplineAxis& axis) noexcept {
  if (axis.degree < 1 || axis.degree > kMostDegree) {
    return Status::bad_degree;
  }
  const auto degree = static_cast<std::size_t>(axis.degree);
  if (axis.points < degree + (axis.periodic ? 0 : 1)) {
    return Status::bad_grid;
  }
  return axis.points > kMostPoints ? Status::size_overflow : Status::ok;
}

Status SplineKnots::take_knots(const SplineAxis& axis, std::size_t& knot) {
  const std::size_t count = axis.points + 1 + (periodic_ ? 0 : static_cast<std::size_t>(degree_));
  knot = 0;
  if (axis.knots.empty()) {
    knots_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      knots_[k] = static_cast<double>(k) - (periodic_ ? 0 : degree_);
    }
    return Status::ok;
  }
  if (axis.knots.data() == nullptr) {
    return Status::null_input;
  }
  if (axis.knots.size() != count) {
    knot = std::min(axis.knots.size(), count);
    return Status::bad_knots;
  }
  knots_.assign(axis.knots.begin(), axis.knots.end());
  double begin = knots_.front(); // of knots that count as equal
  for (std::size_t k = 0; k < count; ++k) {
    const double previous = axis.knots[k == 0 ? 0 : k - 1];
    knot = k;
    // Differences of knots must not overflow.
    if (!(std::abs(knots_[k]) <= 0x1p1000) || knots_[k] < previous) {
      return Status::bad_knots;
    }
    const bool same = knots_[k] - begin <= axis.tolerance && knots_[k] - previous <= axis.tolerance;
    begin = same ? begin : knots_[k];
    knots_[k] = begin;
  }
  // Those at the end of the domain become the last of them, so that it ends where it is given to.
  const double end = knots_[points_];
  const auto behind = std::upper_bound(knots_.begin(), knots_.end(), end);
  const auto last = static_cast<std::size_t>(behind - knots_.begin()) - 1;
  std::replace(knots_.begin(), behind, end, axis.knots[last]);
  return Status::ok;
}

Status SplineKnots::check_multiplicity(std::size_t& knot) const noexcept {
  const auto most = static_cast<std::size_t>(degree_) + 1;
  std::size_t equal = 0;
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    equal = k > 0 && knots_[k] == knots_[k - 1] ? equal + 1 : 1;
    knot = k;
    if (equal > most) {
      return Status::bad_knots;
    }
  }
  if (periodic_) { // the last knot is the first one again
    const auto at_begin = std::ranges::count(knots_, knots_.front());
    const auto at_end = std::ranges::count(knots_, knots_.back());
    if (static_cast<std::size_t>(at_begin + at_end) - 1 > most) {
      return Status::bad_knots;
    }
  }
  return Status::ok;
}

Interval SplineKnots::with_knots(Interval range, double tolerance) const noexcept {
  const bool empty = range.empty();
  for (const double knot : knots_) {
    range.begin = std::abs(range.begin - knot) <= tolerance ? knot : range.begin;
    range.end = std::abs(range.end - knot) <= tolerance ? knot : range.end;
  }
  return empty ? Interval{} : range;
}

void SplineKnots::find_spans(const Interval& range) {
  const std::size_t before = periodic_ ? 0 : static_cast<std::size_t>(degree_);
  for (std::size_t i = 0; i < points_ - before; ++i) {
    double begin = knots_[before + i];
    double end = knots_[before + i + 1];
    if (!range.empty()) {
      begin = std::max(begin, range.begin);
      end = std::min(end, range.end);
    }
    if (begin < end) {
      spans_.push_back({{begin, end}, i});
    }
  }
}

Status SplineKnots::build(const SplineAxis& axis, std::size_t& knot) {
  knot = 0;
  if (const Status status = check_points(axis); !status) {
    return status;
  }
  if (!(axis.tolerance >= 0)) {
    return Status::bad_tolerance;
  }
  degree_ = axis.degree;
  periodic_ = axis.periodic;
  points_ = axis.points;
  period_ = periodic_ ? points_ : ~std::size_t{0};
  if (const Status status = take_knots(axis, knot); !status) {
    return status;
  }
  if (const Status status = check_multiplicity(knot); !status) {
    return status;
  }
  const auto degree = static_cast<std::size_t>(degree_);
  const double begin = knots_[periodic_ ? 0 : degree];
  const double end = knots_[points_];
  if (!(begin < end)) {
    knot = points_;
    return Status::bad_knots;
  }
  knot = 0;
  const Interval& range = axis.range;
  const bool inside = range.begin >= begin - axis.tolerance && range.end <= end + axis.tolerance;
  if (!range.empty() && !(inside && range.begin < range.end)) { // false for nan
    return Status::bad_range;
  }
  const Interval snapped = with_knots(range, axis.tolerance);
  if (snapped.empty() && !range.empty()) { // both ends are one knot
    return Status::bad_range;
  }
  find_spans(snapped);
  return spans_.empty() ? Status::bad_range : Status::ok;
}

TwoDoubles SplineKnots::knot(std::size_t k) const noexcept {
  const auto count = static_cast<std::ptrdiff_t>(points_);
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(k) - (periodic_ ? degree_ : 0);
  if (!periodic_ || (at >= 0 && at <= count)) {
    return {knots_[static_cast<std::size_t>(at)], 0};
  }
  // It is one turn away, since there are at least as many points as the degree. No product is
  // needed, which could leave the range of doubles. What equals either end of the period has to be
  // equal to it also after a turn.
  const double first = knots_.front();
  const double last = knots_.back();
  const TwoDoubles period = exact_sum(last, -first);
  if (at < 0) {
    const double knot = knots_[static_cast<std::size_t>(at + count)];
    return knot == last ? TwoDoubles{first, 0} : TwoDoubles{knot, 0} - period;
  }
  const double knot = knots_[static_cast<std::size_t>(at - count)];
  return knot == first ? TwoDoubles{last, 0} : TwoDoubles{knot, 0} + period;
}

bool SplineKnots::joins_previous(std::size_t span) const noexcept {
  const SplineSpan& here = spans_[span];
  const SplineSpan& previous = spans_[span == 0 ? spans_.size() - 1 : span - 1];
  const bool closed = span == 0;
  if (closed ? !(periodic_ && here.interval.begin == knots_.front() &&
                 previous.interval.end == knots_.back())
             : previous.interval.end != here.interval.begin) {
    return false;
  }
  const std::size_t steps = here.first + (closed ? points_ : 0) - previous.first;
  return steps <= static_cast<std::size_t>(degree_);
}

} // namespace simdbezier::detail
