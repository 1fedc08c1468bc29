#include "src/splines/spline_list.hpp"

#include <algorithm>
#include <cmath>

#include "src/nets/net_places.hpp"
#include "src/splines/spline_knots.hpp"
#include "src/storage/one_point.hpp"

namespace simdbezier::detail {
namespace {

/// Values beyond might overflow in sums with whole numbers as factors, which are up to 15!, or when
/// a mean is rounded to float.
template <typename S>
constexpr S kMostValue = sizeof(S) == sizeof(double) ? S(0x1p980) : S(0x1p127);

/// Means of smaller weights would lose digits, or vanish.
template <typename S>
constexpr double kLeastWeight = sizeof(S) == sizeof(double) ? 0x1p-1000 : 0;

/// Looks at every control value, and whether neighbours are one point. to: the form of results.
template <typename S>
Report inspect(PreparedSpline<S>& spline, Weights to) noexcept {
  const SplineSurface<S>& surface = spline.surface;
  const auto components = static_cast<std::size_t>(surface.components);
  const bool rational = surface.weights != Weights::none;
  const bool weigh = surface.weights == Weights::cartesian;
  const bool project = surface.weights == Weights::homogeneous && to == Weights::cartesian;
  for (std::size_t row = 0; row < surface.rows; ++row) {
    for (std::size_t column = 0; column < surface.columns; ++column) {
      const S* const point = spline.point(row, column);
      for (std::size_t c = 0; c < spline.channels(); ++c) {
        const S value = point[static_cast<std::ptrdiff_t>(c) * surface.component_stride];
        const bool is_weight = c == components;
        const auto number = static_cast<std::ptrdiff_t>(row * surface.columns + column);
        const bool too_light =
            is_weight && !(value > 0 && static_cast<double>(value) >= kLeastWeight<S>);
        if (!std::isfinite(value) || too_light) {
          return {is_weight ? Status::bad_weight : Status::non_finite_input, 0, number,
                  static_cast<int>(c)};
        }
        const double weight =
            (weigh || project) && !is_weight
                ? static_cast<double>(
                      point[static_cast<std::ptrdiff_t>(components) * surface.component_stride])
                : 1;
        const auto size = std::fabs(static_cast<double>(value));
        if (size * (weigh ? weight : 1) > double{kMostValue<S>} ||
            (project && size / weight > double{kMostValue<S>})) {
          return {Status::coefficient_overflow, 0, number, static_cast<int>(c)};
        }
      }
      // The last points of periodic directions are followed by the first ones.
      const S* const neighbours[] = {
          column > 0 || surface.periodic_u ? spline.point(row, column + surface.columns - 1)
                                           : nullptr,
          row > 0 || surface.periodic_v ? spline.point(row + surface.rows - 1, column) : nullptr};
      for (const S* const other : neighbours) {
        spline.has_poles =
            spline.has_poles || (rational && other != nullptr &&
                                 are_one_point<S>(point, other - point, 2, components,
                                                  surface.component_stride, surface.weights));
      }
    }
  }
  return {};
}

bool are_same(const SplineAxis& a, const SplineAxis& b) noexcept {
  return a.degree == b.degree && a.points == b.points && a.periodic == b.periodic &&
         a.range == b.range && a.tolerance == b.tolerance &&
         (a.knots.data() != nullptr || a.knots.empty()) && std::ranges::equal(a.knots, b.knots);
}

} // namespace

template <typename S>
Report SplineList<S>::add(const SplineSurface<S>& surface, int directions, Weights to) {
  // Points that are not there cost no tables of their knots.
  for (int direction = 0; direction < directions; ++direction) {
    if (const Status status = SplineKnots::check_points(axis_of(surface, direction)); !status) {
      return {status, 0, 0, direction};
    }
  }
  if (const Status status = check_places(one_net(surface)); !status) {
    return {status};
  }
  PreparedSpline<S> spline{surface, {}, {}, patches_, rows_, false};
  for (int direction = 0; direction < 2; ++direction) {
    const SplineAxis axis = axis_of(surface, direction);
    auto& factors = direction == 0 ? spline.u : spline.v;
    // Surfaces of one model mostly have the same knots as those before.
    if (!splines_.empty()) {
      const PreparedSpline<S>& last = splines_.back();
      if (are_same(axis, axis_of(last.surface, 0))) {
        factors = last.u;
      } else if (are_same(axis, axis_of(last.surface, 1))) {
        factors = last.v;
      }
    }
    if (factors == nullptr) {
      const auto built = std::make_shared<SplineFactors>();
      std::size_t knot = 0;
      if (direction == directions) {
        built->build_point();
      } else if (const Status status = built->build(axis, knot); !status) {
        return {status, 0, static_cast<std::ptrdiff_t>(knot), direction};
      }
      factors = built;
    }
  }
  if (const Report report = inspect(spline, to); !report) {
    return report;
  }
  rows_ += spline.v->spans(); // below 2^31 each, of vectors that are in memory
  std::size_t patches = 0;
  if (__builtin_mul_overflow(spline.u->spans(), spline.v->spans(), &patches) ||
      __builtin_add_overflow(patches_, patches, &patches_)) {
    return {Status::size_overflow};
  }
  splines_.push_back(std::move(spline));
  return {};
}

template <typename S>
Report SplineList<S>::prepare(std::span<const SplineSurface<S>> surfaces, Weights to) {
  splines_.reserve(surfaces.size());
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (Report report = add(surfaces[k], 2, to); !report) {
      report.item = k;
      return report;
    }
  }
  return {};
}

template <typename S>
Report SplineList<S>::prepare(const SplineCurve<S>& curve) {
  return add(as_surface(curve), 1, curve.weights);
}

template <typename S>
const PreparedSpline<S>& SplineList<S>::spline_of(std::size_t row) const noexcept {
  const auto after = std::upper_bound(
      splines_.begin(), splines_.end(), row,
      [](std::size_t at, const PreparedSpline<S>& spline) { return at < spline.first_row; });
  return *std::prev(after);
}

template <typename S>
void SplineList<S>::write_intervals(std::span<PatchInterval> intervals) const noexcept {
  for (std::size_t k = 0; k < splines_.size() && !intervals.empty(); ++k) {
    const PreparedSpline<S>& spline = splines_[k];
    for (std::size_t patch = 0; patch < spline.patches(); ++patch) {
      intervals[spline.first_patch + patch] = {spline.u->interval(patch % spline.u->spans()),
                                               spline.v->interval(patch / spline.u->spans())};
    }
  }
}

template <typename S>
std::size_t SplineList<S>::scratch_bytes() const noexcept {
  std::size_t most = 0;
  for (const PreparedSpline<S>& spline : splines_) {
    most = std::max(most, spline.row_values() + kMeanSlack +
                              (spline.v->order() + 1) * spline.line_room());
  }
  return most * sizeof(double);
}

template class SplineList<float>;
template class SplineList<double>;

} // namespace simdbezier::detail
