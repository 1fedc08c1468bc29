// A view of the caller's control points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace simdbezier {

/// The highest degree in each direction, and the most components of a point.
inline constexpr int kMostDegree = 15;
inline constexpr int kMostComponents = 16;

/// Whether points carry a weight, as one more value behind their components, and in which form.
enum class Weights : std::uint8_t {
  none,      ///< polynomial
  cartesian, ///< x y z w: the point is (x, y, z)
  /// wx wy wz w: the point is (wx/w, wy/w, wz/w). If no component of the quotients of two points
  /// differs by more than 16 units of roundoff of S, relative to the largest component of both (of
  /// more than three components: each relative to itself), all calls take them for one point.
  homogeneous
};

/// Describes `count` control nets of one shape in the caller's memory, read during calls only.
///
///     v ^  P[3][0] P[3][1] P[3][2] P[3][3]      j numbers rows, in v; i points of a row, in u
///       |  P[2][0]    …                         S(u,v) = sum_j sum_i P[j][i] B_i(u) B_j(v)
///       |  P[1][0]    …
///       |  P[0][0] P[0][1] P[0][2] P[0][3]      with weights, (sum w P B B) / (sum w B B)
///       +--------------------------------> u
///
/// Component c of point P[j][i] of patch p is
///     points[p * patch_stride + j * row_stride + i * point_stride + c * component_stride]
/// with strides in elements of S. The weight stands where component `components` would be. Strides
/// may be negative; those of rows, points and components must not be 0 (else bad_stride). The
/// default describes packed bicubic x y z triples, the order of `.bez` and `.bpt` files; packed()
/// describes other shapes. What cannot be read is refused with the statuses of views (Status).
template <typename S>
struct ControlNets {
  const S* points = nullptr; ///< may be null only when count is 0
  std::size_t count = 0;     ///< number of patches
  int degree_u = 3;          ///< degree along a row, 1 to kMostDegree
  int degree_v = 3;          ///< degree across rows, 1 to kMostDegree
  std::ptrdiff_t patch_stride = 48;
  std::ptrdiff_t row_stride = 12;
  std::ptrdiff_t point_stride = 3;
  std::ptrdiff_t component_stride = 1;
  int components = 3; ///< 1 to kMostComponents, without the weight
  Weights weights = Weights::none;
  /// The memory that all values must lie in (else input_too_small), if it is known.
  std::span<const S> memory = {};

  /// Points with all of their values side by side, row after row, patch after patch.
  [[nodiscard]] static constexpr ControlNets packed(const S* points, std::size_t count,
                                                    int degree_u, int degree_v, int components = 3,
                                                    Weights weights = Weights::none) noexcept {
    const auto wide = [](int value) { return static_cast<std::size_t>(value); }; // never overflows
    const std::size_t point = wide(components) + (weights == Weights::none ? 0 : 1);
    const std::size_t row = (wide(degree_u) + 1) * point;
    const auto stride = [](std::size_t values) { return static_cast<std::ptrdiff_t>(values); };
    return {points,      count,         degree_u, degree_v,   stride((wide(degree_v) + 1) * row),
            stride(row), stride(point), 1,        components, weights,
            {}};
  }
  /// Makes as many nets as `points` contains. An incomplete last one counts; calls then refuse it.
  [[nodiscard]] static constexpr ControlNets packed(std::span<const S> points, int degree_u = 3,
                                                    int degree_v = 3, int components = 3,
                                                    Weights weights = Weights::none) noexcept {
    ControlNets nets = packed(points.data(), 0, degree_u, degree_v, components, weights);
    const auto net = static_cast<std::size_t>(nets.patch_stride < 1 ? 1 : nets.patch_stride);
    nets.count = points.size() / net + (points.size() % net == 0 ? 0 : 1);
    nets.memory = points;
    return nets;
  }
  [[nodiscard]] static constexpr ControlNets packed(std::span<const std::array<S, 3>> points,
                                                    int degree_u = 3, int degree_v = 3) noexcept {
    return packed(points.empty() ? std::span<const S>()
                                 : std::span<const S>(points.front().data(), 3 * points.size()),
                  degree_u, degree_v);
  }
};

// Names for the four edges of a patch.

/// The edges v = 0, v = 1, u = 0, u = 1, each in the direction in which its own parameter grows.
enum class PatchEdge : std::uint8_t { v0, v1, u0, u1 };
inline constexpr std::size_t kPatchEdges = 4;

// A view of the caller's control polygons.

/// Describes `count` control polygons of equal degree and components in the caller's memory, which
/// is read during calls only. Component c of point P[i] of curve k is
///     points[k * curve_stride + i * point_stride + c * component_stride]
/// with strides in elements of S. The weight stands where component `components` would be. The
/// default describes packed cubics of x y z triples. Statuses are those of ControlNets.
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
  /// Makes as many curves as `points` contains. An incomplete last one counts; calls then refuse
  /// it.
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
