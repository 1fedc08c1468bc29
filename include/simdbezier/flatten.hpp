// Curves as polylines that stay within a tolerance of them; flatten() does both steps in one call.
//
//     choose_polylines(curves, {.tolerance = 1e-3}, points, deviation);   sizes first
//     evaluate(set, CurveGrids{.n = points}, out);                        then points
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/curves.hpp>
#include <simdbezier/rates.hpp>

namespace simdbezier {

/// The most points of one polyline.
inline constexpr std::uint32_t kMostPolylinePoints = (1U << 16) + 1;

struct FlattenOptions {
  /// The largest distance between a curve and its polyline, over all components.
  double tolerance = kUnlimited;
  /// One value a curve, or empty. If `tolerance` is given as well, the smaller one counts.
  std::span<const double> tolerances = {};
  /// How far evaluated points may be from the exact ones, one value a curve: position_errors() of
  /// the set that will be evaluated. It is a part of the tolerance. Empty: 0.
  std::span<const double> errors = {};
  std::uint32_t most_points = kMostPolylinePoints; ///< larger numbers count as this one
};

/// Bounds the distance of evaluated points of each curve from the exact ones, by the norm of
/// error_bounds(). out: one value a curve. Allocation: none.
/// Returns ok | output_too_small | unknown_isa | unsupported_isa.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status position_errors(const CurveSet<T>& set, std::span<double> out,
                                                    const RunOptions& options = {}) noexcept;

/// Chooses the fewest uniform points, 2 or more, for each curve, so that the curve and its polyline
/// are within the tolerance of each other. CurveGrids::n takes these numbers.
/// Formula:  n segments deviate by at most max |C''| / (8 n^2), and max |C''| is at most degree
///           (degree - 1) times the largest second difference of control points. For weights see
///           docs/tessellation.md. If weights are more than 4.5-fold apart, few segments are
///           chosen, but not always the fewest.
/// points:   one value a curve, of any components. deviation: the certified distance, errors
///           included; one value a curve, or empty. Both are undefined on an error.
/// Cost:     some 0.1 us a cubic. Allocation: none, except some control polygons per thread if
///           weights are so far apart. Determinism: the same on all machines and threads.
/// Returns:  ok | the statuses of views | non_finite_input | bad_weight | unequal_lengths (spans
///           that are not one value a curve) | bad_tolerance (not above zero, or not above the
///           curve's error, an error below zero, or more than most_points would be needed; the
///           report names the curve) | out_of_memory.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Report choose_polylines(const ControlCurves<S>& curves,
                                                     const FlattenOptions& options,
                                                     std::span<std::uint32_t> points,
                                                     std::span<double> deviation,
                                                     const RunOptions& run = {}) noexcept;

/// Polylines, one after the other.
template <typename T>
struct Polylines {
  Report report;
  std::vector<std::array<T, 3>> points; ///< z (and y) are 0 if curves have no such component
  std::vector<std::size_t> first; ///< each polyline's first point, and the end of the last one
  double deviation = 0; ///< the distance between all of them and the curves is at most this

  [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(report); }
};

/// Packs, chooses, and evaluates curves of up to three components. Returns, in Polylines::report,
/// what pack(), choose_polylines() and evaluate() return, or out_of_memory. Allocates the set of
/// curves, which is freed at the end, and the polylines.
template <typename T, typename S>
[[nodiscard]] Polylines<T> flatten(const ControlCurves<S>& curves, double tolerance,
                                   const RunOptions& options = {}) noexcept;

} // namespace simdbezier
