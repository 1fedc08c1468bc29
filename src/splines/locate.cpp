// Where parameters of splines lie, and how many spans there are: what knots alone decide.
#include <simdbezier/splines.hpp>

#include <algorithm>
#include <span>

#include "src/runtime/fp_environment.hpp"
#include "src/splines/spline_knots.hpp"

namespace simdbezier {
namespace detail {
namespace {

template <typename V>
void put(V* array, std::size_t k, V value) noexcept {
  if (array != nullptr) {
    array[k] = value;
  }
}

/// Calls visit(k, finder) for every parameter of one direction, up to the first at fault.
template <typename Visit>
Report for_places(const SplineKnots& knots, const SplineAxis& axis, std::size_t count,
                  const double* parameters, int direction, const Visit& visit) {
  if (parameters == nullptr && count > 0) {
    return {Status::null_input};
  }
  SpanFinder finder(knots, axis);
  for (std::size_t k = 0; k < count; ++k) {
    if (const Status status = finder.find(parameters[k]); !status) {
      return {status, 0, static_cast<std::ptrdiff_t>(k), direction};
    }
    visit(k, finder);
  }
  return {};
}

template <typename S>
Report write_knots(const SplineSurface<S>& surface, std::span<double> u, std::span<double> v) {
  const std::span<double> out[2] = {u, v};
  SplineKnots knots[2];
  for (int d = 0; d < 2; ++d) {
    std::size_t knot = 0;
    if (const Status status = knots[d].build(axis_of(surface, d), knot); !status) {
      return {status, 0, static_cast<std::ptrdiff_t>(knot), d};
    }
    if (out[d].size() < knots[d].values().size()) {
      return {Status::output_too_small, 0, 0, d};
    }
  }
  for (int d = 0; d < 2; ++d) {
    std::ranges::copy(knots[d].values(), out[d].begin());
  }
  return {};
}

template <typename S>
Report find_places(const SplineSurface<S>& surface, std::size_t count, const double* const* at,
                   const SplinePlaces& places) {
  const int directions = surface.degree_v == 0 ? 1 : 2; // 1: a curve
  SplineKnots knots[2];
  for (int d = 0; d < directions; ++d) {
    std::size_t knot = 0;
    if (const Status status = knots[d].build(axis_of(surface, d), knot); !status) {
      return {status, 0, static_cast<std::ptrdiff_t>(knot), d};
    }
    // Nothing is written where one of them is at fault.
    const Report report = for_places(knots[d], axis_of(surface, d), count, at[d], d,
                                     [](std::size_t, const SpanFinder&) {});
    if (!report) {
      return report;
    }
  }
  const std::uint64_t patches =
      std::uint64_t{knots[0].spans().size()} * (directions == 1 ? 1 : knots[1].spans().size());
  if (places.patch != nullptr && patches > std::uint64_t{1} << 32) {
    return {Status::size_overflow}; // numbers of patches would wrap
  }
  const auto patches_u = static_cast<std::uint32_t>(knots[0].spans().size());
  double* const local[2] = {places.u, places.v};
  double* const length[2] = {places.length_u, places.length_v};
  double* const centred[2] = {places.centred_u, places.centred_v};
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
                                   put(centred[d], k, finder.centred());
                                 }));
  }
  return {};
}

template <typename S>
SpanCounts spans_or_none(const SplineSurface<S>& surface) noexcept {
  SpanCounts counts; // stay zero where memory is lacking
  static_cast<void>(guarded([&] {
    counts = spans_of(surface);
    return Report{};
  }));
  return counts;
}

} // namespace

template <typename S>
SpanCounts spans_of(const SplineSurface<S>& surface) {
  const DefaultFpEnvironment environment;
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

template SpanCounts spans_of(const SplineSurface<float>&);
template SpanCounts spans_of(const SplineSurface<double>&);

} // namespace detail

template <typename S>
SpanCounts span_count(const SplineSurface<S>& surface) noexcept {
  return surface.degree_v == 0 ? SpanCounts() : detail::spans_or_none(surface);
}

template <typename S>
SpanCounts span_count(const SplineCurve<S>& curve) noexcept {
  return detail::spans_or_none(detail::as_surface(curve));
}

template <typename S>
Report merged_knots(const SplineSurface<S>& surface, std::span<double> u,
                    std::span<double> v) noexcept {
  return detail::guarded([&] { return detail::write_knots(surface, u, v); });
}

template <typename S>
Report locate(const SplineSurface<S>& surface, std::size_t count, const double* U, const double* V,
              const SplinePlaces& places) noexcept {
  const double* const at[2] = {U, V};
  return detail::guarded([&]() -> Report {
    return surface.degree_v == 0 ? Report{Status::bad_degree, 0, 0, 1}
                                 : detail::find_places(surface, count, at, places);
  });
}

template <typename S>
Report locate(const SplineCurve<S>& curve, std::size_t count, const double* U,
              const SplinePlaces& places) noexcept {
  const double* const at[2] = {U, nullptr};
  return detail::guarded(
      [&] { return detail::find_places(detail::as_surface(curve), count, at, places); });
}

#define SIMDBEZIER_INSTANTIATE(S)                                                                  \
  template SIMDBEZIER_API SpanCounts span_count(const SplineSurface<S>&) noexcept;                 \
  template SIMDBEZIER_API SpanCounts span_count(const SplineCurve<S>&) noexcept;                   \
  template SIMDBEZIER_API Report merged_knots(const SplineSurface<S>&, std::span<double>,          \
                                              std::span<double>) noexcept;                         \
  template SIMDBEZIER_API Report locate(const SplineSurface<S>&, std::size_t, const double*,       \
                                        const double*, const SplinePlaces&) noexcept;              \
  template SIMDBEZIER_API Report locate(const SplineCurve<S>&, std::size_t, const double*,         \
                                        const SplinePlaces&) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
