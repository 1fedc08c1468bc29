// Certified error bounds of single patches, tighter than the ones that hold for all of them.
#pragma once

#include <cstddef>

#include <simdbezier/isa.hpp>
#include <simdbezier/patch_set.hpp>

namespace simdbezier {

/// Absolute bounds on |computed - exact| per component, at the centred parameters as rounded.
struct ErrorBounds {
  double position[3] = {0, 0, 0};
  double du[3] = {0, 0, 0};
  double dv[3] = {0, 0, 0};
};

/// The certificate of one patch, for every sample with u, v in [0,1].
///
/// Formula:     1.01 u sum_kl (e_k + e_l + 1) |C_kl| over the coefficients in centred parameters,
///              where e_k counts the roundings that term k passes through: min(k+1, 3) in Horner's
///              rule, 2, 3, 3 (k = 1, 2, 3, times k) in its synthetic division; twice as many
///              without FMA; one more for the coefficient itself; with local origins u (|O| + the
///              sum above without its constant) for the last addition. Denormals add 64 of the
///              smallest one. (First-order running error analysis; 1.01 covers the higher orders.)
/// Relative to: the control points less PackOptions::relative_to, as that difference was rounded
///              (to double where T and S are float, else to about 2^-104). Where u
///              is given instead of x = 2u-1, its rounding moves the sample by at most u_T/2 in x.
/// isa:         decides between the FMA and the other class; automatic as in resolve_isa().
/// Returns all zero for a patch outside of the set, and infinities where `isa` cannot be resolved.
/// No allocation, any thread. Cost: about 100 ns.
template <typename T>
[[nodiscard]] SIMDBEZIER_API ErrorBounds error_bounds(const PatchSet<T>& set, std::size_t patch,
                                                      Isa isa = Isa::automatic) noexcept;

/// The largest position bound of any component of any patch; 0 for an empty set.
template <typename T>
[[nodiscard]] SIMDBEZIER_API double largest_position_bound(const PatchSet<T>& set,
                                                           Isa isa = Isa::automatic) noexcept;

/// True where every position of the batch is certified to be within `tolerance` of the exact one:
/// asked of a PatchSet<float>, whether single precision is enough.
template <typename T>
[[nodiscard]] bool meets_tolerance(const PatchSet<T>& set, double tolerance,
                                   Isa isa = Isa::automatic) noexcept {
  return largest_position_bound(set, isa) <= tolerance;
}

} // namespace simdbezier
