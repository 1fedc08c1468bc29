// What it changes that homogeneous points which differ by roundings count as one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/storage/given_points.hpp"
#include "src/storage/one_point.hpp"

namespace simdbezier::detail {

/// Some control points of a net, `step` of them apart.
struct PointRun {
  std::size_t first;
  std::size_t step;
  std::size_t count;
};

template <typename S>
bool are_one_point(const GivenNet& net, const PointRun& run, std::size_t channels) {
  return are_one_point(static_cast<const S*>(net.values) + run.first * channels,
                       static_cast<std::ptrdiff_t>(run.step * channels), run.count, channels - 1, 1,
                       net.all->weights);
}

/// How far apart the coordinates of homogeneous points are that count as one, quotients' roundings
/// included; 0 where they are not one.
inline double merged_distance(const GivenNet& net, const PointRun& run, std::size_t channels,
                              std::size_t component) {
  if (net.all->weights != Weights::homogeneous ||
      !(net.all->in_double ? are_one_point<double>(net, run, channels)
                           : are_one_point<float>(net, run, channels))) {
    return 0;
  }
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (std::size_t k = 0; k < run.count; ++k) {
    const double x = net.coordinate(run.first + k * run.step, channels, component);
    low = std::min(low, x);
    high = std::max(high, x);
  }
  const double origin = component < 3 ? std::fabs(net.all->relative_to[component]) : 0;
  return high - low + 0x1p-51 * (std::max(-low, high) + origin);
}

} // namespace simdbezier::detail
