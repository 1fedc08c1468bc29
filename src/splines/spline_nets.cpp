#include "src/splines/spline_nets.hpp"

#include <algorithm>

#include "src/storage/one_point.hpp"

namespace simdbezier::detail {
namespace {

constexpr std::size_t kNoRow = ~std::size_t{0};

} // namespace

template <typename S>
void SplineCutter<S>::begin(const PreparedSpline<S>& spline) noexcept {
  spline_ = &spline;
  row_ = scratch_;
  mean_of_lines_ = row_ + spline.row_values() + kMeanSlack;
  lines_ = mean_of_lines_ + spline.line_room();
  std::fill_n(row_ + spline.row_values(), kMeanSlack, 0.0); // is read, to no effect
  std::fill_n(held_, kMostOrder, kNoRow);
  mean_ = nullptr;
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
  const SplineFactors& u = *spline_->u;
  means_.points(
      {u.means().data(), u.means().size(), u.factors(), row_, u.period(), channels, line});
}

template <typename S>
const double* SplineCutter<S>::line(std::size_t row) noexcept {
  const std::size_t slot = row % spline_->v->order();
  double* const line = lines_ + slot * spline_->line_room();
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
  for (std::size_t span = 0; span < spans; ++span) {
    const double* from = line + spline_->u->begin(span) * out.channels;
    S* to = out.points + static_cast<std::ptrdiff_t>(span) * out.patch_stride +
            static_cast<std::ptrdiff_t>(j) * out.row_stride;
    __builtin_prefetch(to + 8 * out.patch_stride); // stores would wait for it
    if (out.packed && !project) {                  // mostly
      const auto round = [&](std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) {
          to[k] = static_cast<S>(from[k]) + S(0);
        }
      };
      row_values == 12 ? round(12) : round(row_values); // bicubic ones without a loop
      continue;
    }
    for (std::size_t i = 0; i < out.order_u; ++i, to += out.point_stride, from += out.channels) {
      const double weight = project ? from[out.components] : 1;
      for (std::size_t c = 0; c < out.channels; ++c) {
        const double value = c < out.components && project ? from[c] / weight : from[c];
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
    if (mean_ != &mean) { // else spans join
      const double* lines[kMostOrder];
      for (std::size_t k = 0; k < mean.terms; ++k) {
        lines[k] = line(mean.first + k);
      }
      means_.lines({lines, v.factors() + mean.factor, mean.terms, mean.divisor, mean_of_lines_,
                    spline_->line_values()});
      mean_ = &mean;
    }
    store(mean_of_lines_, j, out);
  }
  const bool exact_points = out.weights == Weights::cartesian; // ends are copies of Cartesian ones
  if (spline_->has_poles || exact_points) {
    restore(span, out);
  }
}

template class SplineCutter<float>;
template class SplineCutter<double>;

} // namespace simdbezier::detail
