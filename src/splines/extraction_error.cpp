// How far the patches of splines may be from them.
#include <simdbezier/splines.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/runtime/fp_environment.hpp"

namespace simdbezier {

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
      double distance = 0;
      for (int c = 0; c < surface.components; ++c) {
        const bool multiplied = surface.weights == Weights::homogeneous;
        largest[c] = std::max(largest[c], std::abs(multiplied ? value(c) : value(c) * weight));
        distance = std::hypot(distance, multiplied ? value(c) / weight : value(c));
      }
      farthest = std::max(farthest, distance);
    }
  }
  double whole = 0;
  for (int c = 0; c < surface.components; ++c) {
    whole = std::hypot(whole, largest[c]);
  }
  // Of a homogeneous coordinate, relative to the largest one of its kind. Float rounds it once
  // more.
  const double relative = spline_error(surface.degree_u, surface.degree_v, surface.weights) +
                          (sizeof(S) == sizeof(float) ? 0x1p-24 * (1 + 0x1p-20) : 0);
  const double off = relative * (whole + (rational ? heaviest * farthest : 0)) +
                     4 * static_cast<double>(std::numeric_limits<S>::denorm_min()) *
                         (1 + (rational ? farthest : 0));
  const double least = lightest - relative * (rational ? heaviest : 0);
  constexpr double kRounding = 1 + 0x1p-40; // of this computation
  return least > 0 ? off / least * kRounding : std::numeric_limits<double>::infinity();
}

template SIMDBEZIER_API double extraction_error(const SplineSurface<float>&) noexcept;
template SIMDBEZIER_API double extraction_error(const SplineSurface<double>&) noexcept;

} // namespace simdbezier
