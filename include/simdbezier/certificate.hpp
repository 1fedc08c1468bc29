// Certified error bounds of single patches, tighter than the ones that hold for all of them.
#pragma once

#include <cstddef>

#include <simdbezier/isa.hpp>
#include <simdbezier/patch_set.hpp>

namespace simdbezier {

/// Absolute bounds on |computed - exact| per component, at the centred parameters as rounded. Zero
/// where the patch has no such component.
struct ErrorBounds {
  double position[kMostComponents] = {};
  double du[kMostComponents] = {};
  double dv[kMostComponents] = {};
};

/// The certificate of one patch, for every sample with u, v in [0,1].
///
/// Formula:     1.01 u sum_kl (e_k + e_l + 1) |C_kl| over the coefficients in centred parameters,
///              where e_k counts the roundings that term k passes through: min(k+1, n) in Horner's
///              rule and in its synthetic division (k = 1, 2, …; times k); twice as many without
///              FMA; one more for the coefficient itself; with local origins u (|O| + the sum above
///              without its constant) for the last addition. In a direction of degree 6 or more the
///              largest of both halves, with k more roundings (k - 1 of the derivative) because the
///              half's own parameter is rounded, and derivatives times 2. Rational patches: with
///              such sums E_h and E_w of numerator and weight, |S - O| <= R in the hull of the
///              control points, and w >= w0, E = (E_h + R E_w) / w0 + 2 u R; derivatives likewise
///              through w S_u = h_u - S w_u; infinite where E_w leaves nothing of w0. What packing
///              itself has rounded in double (or double-double) is added where it is not exact, and
///              64 of the smallest denormal. (First-order running error analysis; 1.01 covers the
///              higher orders.)
/// Relative to: the control points less PackOptions::relative_to, as that difference was rounded
///              (to double where T and S are float, else to about 2^-104). Where u
///              is given instead of x = 2u-1, its rounding moves the sample by at most u_T/2 in x.
/// isa:         decides between the FMA and the other class; automatic as in resolve_isa().
/// Returns all zero for a patch outside of the set, and infinities where `isa` cannot be resolved.
/// No allocation, any thread. Cost: about 100 ns for a bicubic patch.
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
