// Certified error bounds of single patches and curves, tighter than those that hold for all.
#pragma once

#include <cstddef>

#include <simdbezier/curves.hpp>
#include <simdbezier/patch_set.hpp>

namespace simdbezier {

/// Absolute bounds on |computed - exact| per component, at the centred parameters as rounded. Zero
/// if the patch has no such component.
struct ErrorBounds {
  double position[kMostComponents] = {};
  double du[kMostComponents] = {};
  double dv[kMostComponents] = {};
};

/// Certifies the error of one patch, for every sample with u, v in [0,1].
/// Formula:     1.01 u sum_kl (e_k + f_l + 1) |C_kl| over the coefficients in centred parameters;
///              e_k counts the roundings that term k passes through in a column, f_l those in a
///              row. Local origins, halves, weights and packing add terms: docs/accuracy.md.
/// Relative to: the control points less PackOptions::relative_to, as that difference was rounded
///              (to double if T and S are float, else to about 2^-104). If u is given instead of x
///              = 2u-1, its rounding moves the sample by at most u_T/2 in x.
/// isa:         decides between the FMA and the other class; automatic as in resolve_isa().
/// Returns:     all zero for a patch outside of the set; infinities if `isa` cannot be resolved, if
///              the weights leave nothing to divide by, or if sums on the way might overflow.
/// Cost:        about 100 ns for a bicubic patch. No allocation, any thread.
template <typename T>
[[nodiscard]] SIMDBEZIER_API ErrorBounds error_bounds(const PatchSet<T>& set, std::size_t patch,
                                                      Isa isa = Isa::automatic) noexcept;

/// The same bounds for curves.
struct CurveErrorBounds {
  double position[kMostComponents] = {};
  double d1[kMostComponents] = {};
  double d2[kMostComponents] = {};
};

/// Certifies the error of one curve, for every sample with t in [0,1], by the same formula in one
/// direction: 1.01 u sum_k (f_k + 1) |a_k| 2^-k. Returns as for patches.
template <typename T>
[[nodiscard]] SIMDBEZIER_API CurveErrorBounds error_bounds(const CurveSet<T>& set,
                                                           std::size_t curve,
                                                           Isa isa = Isa::automatic) noexcept;

/// The largest position bound of any component of any patch; 0 for an empty set, infinity if `isa`
/// cannot be resolved. Cost: at most that of error_bounds() for every patch.
template <typename T>
[[nodiscard]] SIMDBEZIER_API double largest_position_bound(const PatchSet<T>& set,
                                                           Isa isa = Isa::automatic) noexcept;

/// Whether every position of the batch is certified to be within `tolerance` of the exact one; for
/// a PatchSet<float>, whether single precision is enough. Cost: as above.
template <typename T>
[[nodiscard]] bool meets_tolerance(const PatchSet<T>& set, double tolerance,
                                   Isa isa = Isa::automatic) noexcept {
  return largest_position_bound(set, isa) <= tolerance;
}

} // namespace simdbezier
