// How far the patches of splines may be from them.
#include <simdbezier/splines.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/storage/one_point.hpp"
#include "src/storage/vector_length.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// How far points that are one and follow each other in a row or a column are apart at most;
/// quotients are rounded.
template <typename S>
double merged_step(const SplineSurface<S>& surface) {
  if (surface.weights != Weights::homogeneous) {
    return 0;
  }
  const auto components = static_cast<std::size_t>(surface.components);
  const auto value = [&](const S* point, std::size_t c) {
    return static_cast<double>(point[static_cast<std::ptrdiff_t>(c) * surface.component_stride]);
  };
  double most = 0;
  const auto compare = [&](const S* a, const S* b) {
    if (!are_one_point(a, b - a, 2, components, surface.component_stride, surface.weights)) {
      return;
    }
    double point[kMostComponents];
    double apart[kMostComponents];
    for (std::size_t c = 0; c < components; ++c) {
      point[c] = value(a, c) / value(a, components);
      apart[c] = point[c] - value(b, c) / value(b, components);
    }
    most = std::max(most, vector_length(std::span(apart).first(components)) +
                              0x1p-51 * vector_length(std::span(point).first(components)));
  };
  // The last ones of periodic directions are followed by the first ones.
  for (std::size_t row = 0; row < surface.rows; ++row) {
    for (std::size_t column = 0; column < surface.columns; ++column) {
      const auto at = [&](std::size_t j, std::size_t i) {
        return surface.points + static_cast<std::ptrdiff_t>(j % surface.rows) * surface.row_stride +
               static_cast<std::ptrdiff_t>(i % surface.columns) * surface.point_stride;
      };
      compare(at(row, column), at(row, column + 1));
      compare(at(row, column), at(row + 1, column));
    }
  }
  return most;
}

} // namespace
} // namespace detail

template <typename S>
double extraction_error(const SplineSurface<S>& surface) noexcept {
  const detail::DefaultFpEnvironment environment;
  const bool rational = surface.weights != Weights::none;
  double largest[kMostComponents] = {};
  double farthest = 0;
  double heaviest = rational ? 0 : 1;
  double lightest = rational ? std::numeric_limits<double>::infinity() : 1;
  for (std::size_t row = 0; row < surface.rows; ++row) {
    for (std::size_t column = 0; column < surface.columns; ++column) {
      const S* const point = surface.points +
                             static_cast<std::ptrdiff_t>(row) * surface.row_stride +
                             static_cast<std::ptrdiff_t>(column) * surface.point_stride;
      const auto value = [&](int c) {
        return static_cast<double>(point[c * surface.component_stride]);
      };
      const double weight = rational ? value(surface.components) : 1;
      heaviest = std::max(heaviest, weight);
      lightest = std::min(lightest, weight);
      double place[kMostComponents] = {};
      for (int c = 0; c < surface.components; ++c) {
        const bool multiplied = surface.weights == Weights::homogeneous;
        largest[c] = std::max(largest[c], std::abs(multiplied ? value(c) : value(c) * weight));
        place[c] = multiplied ? value(c) / weight : value(c);
      }
      farthest = std::max(farthest, detail::vector_length(place));
    }
  }
  const double whole = detail::vector_length(largest);
  // Of a homogeneous coordinate, relative to the largest one of its kind. Float rounds it once
  // more.
  const double relative = spline_error(surface.degree_u, surface.degree_v, surface.weights) +
                          (sizeof(S) == sizeof(float) ? 0x1p-24 * (1 + 0x1p-20) : 0);
  // Each sum of a mean, and each product, may lose half of a denormal besides.
  const double lost = (surface.degree_u + surface.degree_v + 8) *
                      static_cast<double>(std::numeric_limits<S>::denorm_min());
  const double off = relative * (whole + (rational ? heaviest * farthest : 0)) +
                     lost * (std::sqrt(surface.components) + (rational ? farthest : 0));
  const double least = lightest - (rational ? relative * heaviest + lost : 0);
  // Points of the patches that are means of one point are the one of these nearest to zero.
  const double merged =
      std::sqrt(3.0) * (surface.degree_u + surface.degree_v) * detail::merged_step(surface);
  constexpr double kRounding = 1 + 0x1p-40; // of this computation
  return least > 0 ? (off / least + merged) * kRounding : std::numeric_limits<double>::infinity();
}

SIMDBEZIER_EXPORT_BOTH_TYPES(extraction_error);

} // namespace simdbezier
