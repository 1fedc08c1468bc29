// What it is for control points to be one point: the only place that decides it.
//
// Values are taken as they were given, before any change of form or origin. Cartesian points, with
// or without weights, are one where their coordinates are equal. Homogeneous ones, (w x, w), are
// one where the quotients differ by no more than numbers of the input's type can tell: 3/1 and
// 0.3/0.1 are one point in the file and differ by two roundings, and products with weights that a
// program has rounded, turned or halved by a few more. In each coordinate the largest and the
// smallest quotient may differ by kOneFactor units of roundoff of the largest magnitude of any
// coordinate, since a model that has been turned has roundings of all coordinates in each of them.
// Of points with more than three components, which need not be places, each component counts by
// itself. A point that a translation has moved to the origin has nothing left to compare with.
//
// Packing, exact questions and topologies ask here, so that a side that is a point for one of them
// is one for all. The quotients are formed in double by single divisions, so that the answer is the
// same on every machine, and it does not depend on the order of the points.
#pragma once

#include <cstddef>

#include <simdbezier/control_nets.hpp>

namespace simdbezier::detail {

/// Each of the four numbers of two quotients may have been rounded so often by a quarter of this.
inline constexpr double kOneFactor = 16;

/// How far coordinates of one point may be apart, relative to the larger one.
constexpr double one_point_tolerance(Weights weights, bool in_double) noexcept {
  return weights == Weights::homogeneous ? kOneFactor * (in_double ? 0x1p-53 : 0x1p-24) : 0.0;
}

/// How many components are compared with the largest of them: those of places.
constexpr std::size_t joint_components(std::size_t components) noexcept {
  return components <= 3 ? components : 1;
}

/// Whether two points are surely not one: value(k, c) is component c of point k, and the weight
/// stands behind the components. Products cost a tenth of quotients, and their roundings are small
/// beside twice the tolerance. False where they may underflow or are not finite.
template <typename Value>
[[gnu::always_inline]] inline bool are_surely_apart(const Value& value, std::size_t k,
                                                    std::size_t l, std::size_t components,
                                                    double tolerance) noexcept {
  const std::size_t joint = joint_components(components);
  const double w = value(k, components);
  const double v = value(l, components);
  for (std::size_t first = 0; first < components; first += joint) {
    double size = 0;
    double apart = 0;
    for (std::size_t c = first; c < first + joint; ++c) {
      const double x = value(k, c) * v;
      const double y = value(l, c) * w;
      const double difference = x < y ? y - x : x - y;
      size += (x < 0 ? -x : x) + (y < 0 ? -y : y);
      apart = difference > apart ? difference : apart;
    }
    if (apart > 2 * tolerance * size && size > 0x1p-900) {
      return true;
    }
  }
  return false;
}

/// Whether `count` points are one point: point(k) leads to the first value of one, and a weight
/// stands behind its components. Values that are not finite are no point. nearest: null, or where
/// each component nearest to zero goes, in Cartesian form.
template <typename S, typename PointAt>
[[gnu::always_inline]] inline bool
are_one_point(const PointAt& point, std::size_t count, std::size_t components,
              std::ptrdiff_t component_stride, Weights weights, double* nearest) noexcept {
  const bool divided = weights == Weights::homogeneous;
  const double tolerance = one_point_tolerance(weights, sizeof(S) == sizeof(double));
  const auto value = [=](std::size_t k, std::size_t c) __attribute__((always_inline)) {
    return static_cast<double>(point(k)[static_cast<std::ptrdiff_t>(c) * component_stride]);
  };
  // Most points are far apart.
  if (divided && are_surely_apart(value, 0, count - 1, components, tolerance)) {
    return false;
  }
  const std::size_t joint = divided ? joint_components(components) : 1;
  for (std::size_t first = 0; first < components; first += joint) {
    double size = 0;
    double apart = 0;
    for (std::size_t c = first; c < first + joint; ++c) {
      double low = 0;
      double high = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const double x = divided ? value(k, c) / value(k, components) : value(k, c);
        if (!(x - x == 0)) { // the difference of numbers that are not finite is nan
          return false;
        }
        low = k == 0 || x < low ? x : low;
        high = k == 0 || x > high ? x : high;
      }
      size = high > size ? high : size;
      size = -low > size ? -low : size;
      apart = high - low > apart ? high - low : apart;
      if (nearest != nullptr) {
        nearest[c] = low > 0 ? low : high;
      }
    }
    if (!(apart <= tolerance * size)) {
      return false;
    }
  }
  return true;
}

/// The same for points that are `step` values apart.
template <typename S>
[[gnu::always_inline]] inline bool
are_one_point(const S* first, std::ptrdiff_t step, std::size_t count, std::size_t components,
              std::ptrdiff_t component_stride, Weights weights) noexcept {
  const auto point = [=](std::size_t k) __attribute__((always_inline)) {
    return first + static_cast<std::ptrdiff_t>(k) * step;
  };
  return are_one_point<S>(point, count, components, component_stride, weights, nullptr);
}

} // namespace simdbezier::detail
