// Curves as polylines that stay within a tolerance of them.
//
//     choose_polylines(curves, {.tolerance = 1e-3}, points, deviation);   sizes first
//     evaluate(set, CurveGrids{.n = points}, out);                        then points
//
// flatten() does both in one call.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/curves.hpp>

namespace simdbezier {

/// The most points of one polyline.
inline constexpr std::uint32_t kMostPolylinePoints = (1U << 16) + 1;

struct FlattenOptions {
  /// The largest distance between a curve and its polyline, over all components.
  double tolerance = 0;
  std::span<const double> tolerances = {}; ///< one value a curve, instead of `tolerance`; or empty
  /// How far evaluated points may be from the exact ones, one value a curve: position_errors() of
  /// the set that will be evaluated. Part of the tolerance. Empty: 0.
  std::span<const double> errors = {};
  std::uint32_t most_points = kMostPolylinePoints; ///< larger numbers count as this one
  int threads = 0;                                 ///< as in Options
};

/// Where choosing stopped.
struct FlattenReport {
  Status status;
  std::size_t curve = 0; ///< the first one at fault
  [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(status); }
};

/// Upper bounds on the distance of evaluated points of each curve from the exact ones: the norm of
/// error_bounds(). out: one value a curve.
/// options: threads and isa count, the other members have no meaning. Allocation: none.
/// Returns: ok | output_too_small | unknown_isa | unsupported_isa.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status position_errors(const CurveSet<T>& set, std::span<double> out,
                                                    const Options& options = {}) noexcept;

/// The fewest uniform parameters with which every curve is within its tolerance of its polyline,
/// and the polyline of the curve: 2 or more points, as CurveGrids::n takes them.
///
/// Formula:    n segments deviate by at most max |C''| / (8 n^2), which is theorem 1 of
///             docs/tessellation.md for one parameter; max |C''| is at most degree (degree - 1)
///             times the largest second difference of control points. With weights, |v| of a second
///             difference becomes |v_X - c v_w| + R |v_w|, c being the middle and R half of the
///             diagonal of the box of the control points, and the bound is divided by the smallest
///             weight. Where weights are more than 4.5-fold apart, fewer segments are taken if the
///             distance of point sets is within the tolerance: few, not always the fewest.
/// curves:     any components.
/// points:     one value a curve. deviation: the certified distance, errors included; one value a
///             curve, or empty.
/// Determinism: the same on all machines, for any number of threads. Allocation: none. Cost: some
///             0.1 us a cubic.
/// Returns:    ok | null_input | input_too_small | bad_degree | bad_components | bad_stride |
///             size_overflow | non_finite_input | bad_weight | unequal_lengths (spans that are not
///             one value a curve) | bad_tolerance (not above zero, or not above the curve's error,
///             an error below zero, or more than most_points would be needed; the report names the
///             curve). Outputs are undefined on an error.
template <typename S>
[[nodiscard]] SIMDBEZIER_API FlattenReport choose_polylines(const ControlCurves<S>& curves,
                                                            const FlattenOptions& options,
                                                            std::span<std::uint32_t> points,
                                                            std::span<double> deviation) noexcept;

/// Polylines, one after the other.
template <typename T>
struct Polylines {
  Status status;
  std::size_t fault_curve = 0;
  std::vector<std::array<T, 3>> points; ///< z (and y) are 0 where curves have no such component
  std::vector<std::size_t> first; ///< each polyline's first point, and the end of the last one
  double deviation = 0; ///< the distance between all of them and the curves is at most this

  [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(status); }
};

/// Packs, chooses, and evaluates curves of up to three components.
/// Returns: in Polylines::status, what pack(), choose_polylines() and evaluate() return;
///          out_of_memory.
/// Memory:  allocates the set of curves, which goes at the end, and the polylines.
template <typename T, typename S>
[[nodiscard]] Polylines<T> flatten(const ControlCurves<S>& curves, double tolerance,
                                   const Options& options = {}) noexcept;

} // namespace simdbezier
