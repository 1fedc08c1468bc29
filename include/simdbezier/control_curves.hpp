// A view of the caller's control polygons.
#pragma once

#include <cstddef>
#include <span>

#include <simdbezier/control_nets.hpp>

namespace simdbezier {

/// Describes `count` control polygons of equal degree and components in the caller's memory, which
/// is read during calls only. Component c of point P[i] of curve k is
///     points[k * curve_stride + i * point_stride + c * component_stride]
/// with strides in elements of S; the weight is where component `components` would be. The default
/// describes packed cubics of x y z triples. Refused as ControlNets are.
template <typename S>
struct ControlCurves {
  const S* points = nullptr; ///< may be null only when count is 0
  std::size_t count = 0;     ///< number of curves
  int degree = 3;            ///< 1 to kMostDegree
  std::ptrdiff_t curve_stride = 12;
  std::ptrdiff_t point_stride = 3;
  std::ptrdiff_t component_stride = 1;
  int components = 3; ///< 1 to kMostComponents, without the weight
  Weights weights = Weights::none;
  std::span<const S> memory = {}; ///< as in ControlNets

  /// Points with all of their values side by side, curve after curve.
  [[nodiscard]] static constexpr ControlCurves packed(const S* points, std::size_t count,
                                                      int degree, int components = 3,
                                                      Weights weights = Weights::none) noexcept {
    const std::ptrdiff_t point = std::ptrdiff_t{components} + (weights == Weights::none ? 0 : 1);
    const std::ptrdiff_t curve =
        (std::ptrdiff_t{degree} + 1) * point; // no int: any degree may come
    return {points, count, degree, curve, point, 1, components, weights, {}};
  }
  /// Makes as many curves as there are points for, an incomplete one included, which calls refuse.
  [[nodiscard]] static constexpr ControlCurves packed(std::span<const S> points, int degree = 3,
                                                      int components = 3,
                                                      Weights weights = Weights::none) noexcept {
    ControlCurves curves = packed(points.data(), 0, degree, components, weights);
    const auto values = static_cast<std::size_t>(curves.curve_stride < 1 ? 1 : curves.curve_stride);
    curves.count = points.size() / values + (points.size() % values == 0 ? 0 : 1);
    curves.memory = points;
    return curves;
  }
};

} // namespace simdbezier
