// See src/splines/spline_nets.hpp.
#include "src/splines/spline_nets.hpp"

#include <algorithm>
#include <cmath>

#include "src/nets/net_call.hpp"
#include "src/nets/net_places.hpp"
#include "src/splines/spline_axes.hpp"
#include "src/storage/one_point.hpp"

namespace simdbezier::detail {
namespace {

constexpr std::size_t kNoRow = ~std::size_t{0};

/// Whether the points can be read: degrees and numbers are sound.
template <typename S>
Status check_points(const SplineSurface<S>& surface) noexcept {
  if (surface.points == nullptr) {
    return Status::null_input;
  }
  if (surface.components < 1 || surface.components > kMostComponents ||
      surface.weights > Weights::homogeneous) {
    return Status::bad_components;
  }
  const bool one_row = surface.rows == 1;
  if ((surface.row_stride == 0 && !one_row) || surface.point_stride == 0 ||
      surface.component_stride == 0) {
    return Status::bad_stride;
  }
  Lattice lattice;
  const ControlNets<S> net = one_net(surface);
  if (!lattice_of(net, lattice)) {
    return Status::size_overflow;
  }
  return lies_in(lattice, 1, surface.memory) ? Status::ok : Status::input_too_small;
}

/// Looks at every control value, and whether neighbours are one point.
template <typename S>
SplineReport inspect(PreparedSpline<S>& spline) noexcept {
  const SplineSurface<S>& surface = spline.surface;
  const auto components = static_cast<std::size_t>(surface.components);
  const bool rational = surface.weights != Weights::none;
  for (std::size_t row = 0; row < surface.rows; ++row) {
    for (std::size_t column = 0; column < surface.columns; ++column) {
      const S* const point = spline.point(row, column);
      for (std::size_t c = 0; c < spline.channels(); ++c) {
        const S value = point[static_cast<std::ptrdiff_t>(c) * surface.component_stride];
        const bool is_weight = c == components;
        if (!std::isfinite(value) || (is_weight && !(value > 0))) {
          return {is_weight ? Status::bad_weight : Status::non_finite_input, 0,
                  row * surface.columns + column, static_cast<int>(c)};
        }
      }
      const S* const neighbours[] = {column > 0 ? spline.point(row, column - 1) : nullptr,
                                     row > 0 ? spline.point(row - 1, column) : nullptr};
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
         a.range == b.range && a.tolerance == b.tolerance && std::ranges::equal(a.knots, b.knots);
}

} // namespace

// SplineList -------------------------------------------------------------------------------------

template <typename S>
SplineReport SplineList<S>::add(const SplineSurface<S>& surface) {
  PreparedSpline<S> spline{surface, {}, {}, 0, 0, false};
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
      if (const Status status = built->build(axis, knot); !status) {
        return {status, 0, knot, direction};
      }
      factors = built;
    }
  }
  return finish(spline);
}

template <typename S>
SplineReport SplineList<S>::finish(PreparedSpline<S> spline) {
  if (const Status status = check_points(spline.surface); !status) {
    return {status};
  }
  if (const SplineReport report = inspect(spline); !report) {
    return report;
  }
  spline.first_patch = patches_;
  spline.first_row = rows_;
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
SplineReport SplineList<S>::prepare(std::span<const SplineSurface<S>> surfaces) {
  splines_.reserve(surfaces.size());
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (SplineReport report = add(surfaces[k]); !report) {
      report.surface = k;
      return report;
    }
  }
  return {};
}

template <typename S>
SplineReport SplineList<S>::prepare(const SplineCurve<S>& curve) {
  const SplineSurface<S> surface = as_surface(curve);
  const auto u = std::make_shared<SplineFactors>();
  std::size_t knot = 0;
  if (const Status status = u->build(axis_of(surface, 0), knot); !status) {
    return {status, 0, knot, 0};
  }
  const auto v = std::make_shared<SplineFactors>();
  v->build_point();
  return finish({surface, u, v, 0, 0, false});
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
    const std::size_t row = spline.surface.columns * spline.channels();
    most = std::max(most, row + (spline.v->order() + 1) * spline.line_values());
  }
  return most * sizeof(double);
}

// SplineCutter -----------------------------------------------------------------------------------

template <typename S>
void SplineCutter<S>::begin(const PreparedSpline<S>& spline) noexcept {
  spline_ = &spline;
  row_ = scratch_;
  mean_of_lines_ = row_ + spline.surface.columns * spline.channels();
  lines_ = mean_of_lines_ + spline.line_values();
  std::fill_n(held_, kMostOrder, kNoRow);
}

template <typename S>
void SplineCutter<S>::fill(std::size_t row, double* line) noexcept {
  const SplineSurface<S>& surface = spline_->surface;
  const std::size_t channels = spline_->channels();
  const bool weigh = surface.weights == Weights::cartesian;
  for (std::size_t column = 0; column < surface.columns; ++column) {
    const S* const from = spline_->point(row, column);
    double* const to = row_ + column * channels;
    for (std::size_t c = 0; c < channels; ++c) {
      to[c] = static_cast<double>(from[static_cast<std::ptrdiff_t>(c) * surface.component_stride]);
    }
    for (std::size_t c = 0; weigh && c + 1 < channels; ++c) {
      to[c] *= to[channels - 1];
    }
  }
  const SplineFactors& factors = *spline_->u;
  for (const SplineMean& mean : factors.means()) {
    const double* points[kMostOrder];
    for (std::size_t k = 0; k < mean.terms; ++k) {
      points[k] = row_ + wrapped(mean.first + k, factors.period()) * channels;
    }
    mean_({points, factors.factors(mean), mean.terms, mean.divisor, line, channels});
    line += channels;
  }
}

template <typename S>
const double* SplineCutter<S>::line(std::size_t row) noexcept {
  const std::size_t slot = row % spline_->v->order();
  double* const line = lines_ + slot * spline_->line_values();
  if (held_[slot] != row) {
    fill(row, line);
    held_[slot] = row;
  }
  return line;
}

/// Writes row j of all nets of a row of spans.
template <typename S>
void SplineCutter<S>::store(const double* line, std::size_t j,
                            const NetView<S>& out) const noexcept {
  const std::size_t spans = spline_->u->spans();
  const bool project = out.weights == Weights::cartesian;
  const std::size_t row_values = out.order_u * out.channels;
  for (std::size_t span = 0; out.packed && !project && span < spans; ++span) { // mostly
    S* const to = out.points + static_cast<std::ptrdiff_t>(span) * out.patch_stride +
                  static_cast<std::ptrdiff_t>(j) * out.row_stride;
    for (std::size_t k = 0; k < row_values; ++k) {
      to[k] = static_cast<S>(line[k]) + S(0);
    }
    line += row_values;
  }
  for (std::size_t span = 0; !(out.packed && !project) && span < spans; ++span) {
    S* to = out.points + static_cast<std::ptrdiff_t>(span) * out.patch_stride +
            static_cast<std::ptrdiff_t>(j) * out.row_stride;
    for (std::size_t i = 0; i < out.order_u; ++i, to += out.point_stride, line += out.channels) {
      const double weight = project ? line[out.components] : 1;
      for (std::size_t c = 0; c < out.channels; ++c) {
        const double value = c < out.components && project ? line[c] / weight : line[c];
        to[static_cast<std::ptrdiff_t>(c) * out.component_stride] = static_cast<S>(value) + S(0);
      }
    }
  }
}

/// Makes points that are means of one point that point again, in rational nets: their roundings
/// would depend on weights.
template <typename S>
void SplineCutter<S>::restore(std::size_t span_v, const NetView<S>& out) const noexcept {
  const SplineSurface<S>& surface = spline_->surface;
  const auto stride = [&](std::size_t c) {
    return static_cast<std::ptrdiff_t>(c) * out.component_stride;
  };
  for (std::size_t span = 0; span < spline_->u->spans(); ++span) {
    for (std::size_t k = 0; k < out.order_u * out.order_v; ++k) {
      const SplineMean& u = spline_->u->mean(span, k % out.order_u);
      const SplineMean& v = spline_->v->mean(span_v, k / out.order_u);
      const auto at = [&](std::size_t n) {
        return spline_->point(v.first + n / u.terms, u.first + n % u.terms);
      };
      double nearest[kMostChannels];
      S* const to = out.points + static_cast<std::ptrdiff_t>(span) * out.patch_stride +
                    static_cast<std::ptrdiff_t>(k / out.order_u) * out.row_stride +
                    static_cast<std::ptrdiff_t>(k % out.order_u) * out.point_stride;
      const std::size_t points = u.terms * v.terms;
      if ((points == 1 && surface.weights == Weights::homogeneous) ||
          !are_one_point<S>(at, points, out.components, surface.component_stride, surface.weights,
                            nearest)) {
        continue;
      }
      const double weight =
          out.weights == Weights::cartesian ? 1 : static_cast<double>(to[stride(out.components)]);
      for (std::size_t c = 0; c < out.components; ++c) {
        to[stride(c)] = static_cast<S>(nearest[c] * weight) + S(0);
      }
    }
  }
}

template <typename S>
void SplineCutter<S>::cut(std::size_t row, const NetView<S>& out) noexcept {
  if (spline_ == nullptr || row < spline_->first_row ||
      row - spline_->first_row >= spline_->v->spans()) {
    begin(list_.spline_of(row));
  }
  const SplineFactors& v = *spline_->v;
  const std::size_t span = row - spline_->first_row;
  for (std::size_t j = 0; j < v.order(); ++j) {
    const SplineMean& mean = v.mean(span, j);
    const double* lines[kMostOrder];
    for (std::size_t k = 0; k < mean.terms; ++k) {
      lines[k] = line(mean.first + k);
    }
    mean_(
        {lines, v.factors(mean), mean.terms, mean.divisor, mean_of_lines_, spline_->line_values()});
    store(mean_of_lines_, j, out);
  }
  const bool exact_points = out.weights == Weights::cartesian; // ends are copies of Cartesian ones
  if (spline_->has_poles || exact_points) {
    restore(span, out);
  }
}

template class SplineList<float>;
template class SplineList<double>;
template class SplineCutter<float>;
template class SplineCutter<double>;

} // namespace simdbezier::detail
