// What certificates ask of the control points of one patch or curve, as they were given.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/storage/given_points.hpp"
#include "src/storage/one_point.hpp"

namespace simdbezier::detail {

/// Some control points, `step` of them apart.
struct PointRun {
  std::size_t first;
  std::size_t step;
  std::size_t count;
};

struct ControlValues {
  GivenNet net;
  std::size_t points;
  std::size_t channels; ///< of a point; the last one is the weight where it is rational
  bool rational;

  /// A point's coordinate, or its weight.
  [[nodiscard]] double value(std::size_t point, std::size_t channel) const {
    return rational && channel + 1 == channels ? net.value(point * channels + channel)
                                               : net.coordinate(point, channels, channel);
  }
  /// Largest |value| of a channel.
  [[nodiscard]] double largest(std::size_t channel) const {
    double most = 0;
    for (std::size_t k = 0; k < points; ++k) {
      most = std::max(most, std::fabs(value(k, channel)));
    }
    return most;
  }
  [[nodiscard]] double least_weight() const {
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < points; ++k) {
      least = std::min(least, value(k, channels - 1));
    }
    return least;
  }
  /// Bounds the distance from a number in one component, with `unit` of roundoff: all samples are
  /// in the hull of the control points.
  [[nodiscard]] double reach_from(double around, std::size_t component, double unit) const {
    double reach = 0;
    for (std::size_t k = 0; k < points; ++k) {
      const double point = value(k, component);
      reach = std::max(reach, std::fabs(point - around) + 8 * unit * std::fabs(point));
    }
    return reach;
  }
  /// How far apart the coordinates of homogeneous points are that count as one although they differ
  /// by roundings, quotients' roundings included; 0 where they are not one.
  [[nodiscard]] double merged_distance(const PointRun& run, std::size_t component) const {
    const GivenPoints& all = *net.all;
    if (all.weights != Weights::homogeneous ||
        !(all.in_double ? are_one<double>(run) : are_one<float>(run))) {
      return 0;
    }
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (std::size_t k = 0; k < run.count; ++k) {
      const double x = value(run.first + k * run.step, component);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    const double origin = component < 3 ? std::fabs(all.relative_to[component]) : 0;
    return high - low + 0x1p-51 * (std::max(-low, high) + origin);
  }

private:
  template <typename S>
  [[nodiscard]] bool are_one(const PointRun& run) const {
    return are_one_point(static_cast<const S*>(net.values) + run.first * channels,
                         static_cast<std::ptrdiff_t>(run.step * channels), run.count, channels - 1,
                         1, net.all->weights);
  }
};

} // namespace simdbezier::detail
