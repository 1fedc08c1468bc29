// Where parameters of splines lie, and how many spans there are: what knots alone decide.
#include <simdbezier/splines.hpp>

#include <algorithm>
#include <cmath>

#include "src/runtime/fp_environment.hpp"
#include "src/splines/spline_axes.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Finds spans, those near the last one without a search.
class SpanFinder {
public:
  explicit SpanFinder(const SplineKnots& knots, const SplineAxis& axis)
      : spans_(knots.spans()), begin_(spans_.front().interval.begin),
        end_(spans_.back().interval.end), period_(axis.periodic && axis.range.empty()) {}

  /// Returns whether a parameter is in the domain, and finds its span then.
  [[nodiscard]] bool find(double parameter) noexcept {
    parameter_ = parameter;
    if (period_ && !(begin_ <= parameter && parameter <= end_)) {
      const double length = end_ - begin_;
      parameter_ -= length * std::floor((parameter - begin_) / length);
      parameter_ = std::min(std::max(parameter_, begin_), end_); // it is off by a rounding
    }
    if (!(begin_ <= parameter_ && parameter_ <= end_)) {
      return false;
    }
    const auto holds = [&](std::size_t span) {
      return spans_[span].interval.begin <= parameter_ && parameter_ < spans_[span].interval.end;
    };
    if (!holds(span_)) {
      const auto after = std::upper_bound(
          spans_.begin(), spans_.end(), parameter_,
          [](double at, const SplineSpan& span) { return at < span.interval.begin; });
      span_ = static_cast<std::size_t>(after - spans_.begin()) - 1;
    }
    return true;
  }

  [[nodiscard]] std::size_t span() const noexcept { return span_; }
  [[nodiscard]] double length() const noexcept { return spans_[span_].interval.length(); }
  [[nodiscard]] double local() const noexcept {
    const Interval& interval = spans_[span_].interval;
    return (parameter_ - interval.begin) / interval.length();
  }

private:
  const std::vector<SplineSpan>& spans_;
  double begin_;
  double end_;
  bool period_;
  double parameter_ = 0;
  std::size_t span_ = 0;
};

template <typename V>
void put(V* array, std::size_t k, V value) noexcept {
  if (array != nullptr) {
    array[k] = value;
  }
}

/// Calls visit(k, finder) for every parameter of one direction.
template <typename Visit>
SplineReport for_places(const SplineKnots& knots, const SplineAxis& axis, std::size_t count,
                        const double* parameters, int direction, const Visit& visit) {
  if (parameters == nullptr && count > 0) {
    return {Status::null_input};
  }
  SpanFinder finder(knots, axis);
  for (std::size_t k = 0; k < count; ++k) {
    if (!std::isfinite(parameters[k]) || !finder.find(parameters[k])) {
      const Status status =
          std::isfinite(parameters[k]) ? Status::bad_range : Status::non_finite_input;
      return {status, 0, k, direction};
    }
    visit(k, finder);
  }
  return {};
}

template <typename S>
SplineReport find_places(const SplineSurface<S>& surface, std::size_t count,
                         const double* const* at, const SplinePlaces& places) {
  const int directions = surface.degree_v == 0 ? 1 : 2; // 1: a curve
  SplineKnots knots[2];
  for (int d = 0; d < directions; ++d) {
    std::size_t knot = 0;
    if (const Status status = knots[d].build(axis_of(surface, d), knot); !status) {
      return {status, 0, knot, d};
    }
    // Nothing is written where one of them is at fault.
    const SplineReport report = for_places(knots[d], axis_of(surface, d), count, at[d], d,
                                           [](std::size_t, const SpanFinder&) {});
    if (!report) {
      return report;
    }
  }
  const auto patches_u = static_cast<std::uint32_t>(knots[0].spans().size());
  double* const local[2] = {places.u, places.v};
  double* const length[2] = {places.length_u, places.length_v};
  for (int d = 0; d < directions; ++d) {
    static_cast<void>(for_places(knots[d], axis_of(surface, d), count, at[d], d,
                                 [&](std::size_t k, const SpanFinder& finder) {
                                   const auto span = static_cast<std::uint32_t>(finder.span());
                                   if (places.patch != nullptr) {
                                     places.patch[k] =
                                         d == 0 ? span : places.patch[k] + span * patches_u;
                                   }
                                   put(local[d], k, finder.local());
                                   put(length[d], k, finder.length());
                                 }));
  }
  return {};
}

template <typename S>
SpanCounts count_spans(const SplineSurface<S>& surface) {
  SpanCounts counts{0, 1};
  for (int d = 0; d < (surface.degree_v == 0 ? 1 : 2); ++d) {
    SplineKnots knots;
    std::size_t knot = 0;
    if (!knots.build(axis_of(surface, d), knot)) {
      return {};
    }
    (d == 0 ? counts.u : counts.v) = knots.spans().size();
  }
  return counts;
}

} // namespace
} // namespace detail

template <typename S>
SpanCounts span_count(const SplineSurface<S>& surface) noexcept {
  SpanCounts counts;
  const detail::DefaultFpEnvironment environment;
  static_cast<void>(detail::guarded([&] {
    counts = surface.degree_v == 0 ? SpanCounts() : detail::count_spans(surface);
    return SplineReport();
  }));
  return counts;
}

template <typename S>
SpanCounts span_count(const SplineCurve<S>& curve) noexcept {
  SpanCounts counts;
  const detail::DefaultFpEnvironment environment;
  static_cast<void>(detail::guarded([&] {
    counts = detail::count_spans(detail::as_surface(curve));
    return SplineReport();
  }));
  return counts;
}

template <typename S>
SplineReport locate(const SplineSurface<S>& surface, std::size_t count, const double* U,
                    const double* V, const SplinePlaces& places) noexcept {
  const detail::DefaultFpEnvironment environment;
  const double* const at[2] = {U, V};
  return detail::guarded([&]() -> SplineReport {
    return surface.degree_v == 0 ? SplineReport{Status::bad_degree, 0, 0, 1}
                                 : detail::find_places(surface, count, at, places);
  });
}

template <typename S>
SplineReport locate(const SplineCurve<S>& curve, std::size_t count, const double* U,
                    const SplinePlaces& places) noexcept {
  const detail::DefaultFpEnvironment environment;
  const double* const at[2] = {U, nullptr};
  return detail::guarded(
      [&] { return detail::find_places(detail::as_surface(curve), count, at, places); });
}

#define SIMDBEZIER_INSTANTIATE(S)                                                                  \
  template SIMDBEZIER_API SpanCounts span_count(const SplineSurface<S>&) noexcept;                 \
  template SIMDBEZIER_API SpanCounts span_count(const SplineCurve<S>&) noexcept;                   \
  template SIMDBEZIER_API SplineReport locate(const SplineSurface<S>&, std::size_t, const double*, \
                                              const double*, const SplinePlaces&) noexcept;        \
  template SIMDBEZIER_API SplineReport locate(const SplineCurve<S>&, std::size_t, const double*,   \
                                              const SplinePlaces&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
