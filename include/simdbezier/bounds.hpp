// Certified boxes and flatness of control nets, for culling, intersection and adaptive subdivision.
// Each bound holds for the exact surface of the given control points, roundings included.
// For every call
//   Nets      S = float or double, any degrees and components; values finite, weights positive.
//   Outputs   the caller's packed arrays, one row a patch; they may not overlap the nets or each
//             other. Component c of patch p is at [p * components + c].
//   Bits      equal on all instruction sets, for any number of threads and place in the batch.
//   Threads   RunOptions::threads. Allocation: scratch per thread.
//   Statuses  as in nets.hpp; on an error nothing has been written.
#pragma once

#include <cstddef>
#include <type_traits>

#include <simdbezier/curves.hpp>
#include <simdbezier/nets.hpp>
#include <simdbezier/outputs.hpp>
#include <simdbezier/patch_set.hpp>

namespace simdbezier {

/// Where boxes go: count * components values each, neither null.
template <typename T>
struct Boxes {
  Values<T> low;
  Values<T> high;
};

/// Finds the smallest and largest control values of each patch, projected if nets have weights. S
/// lies in the convex hull of its control points, and so in this box. Boxes are exact, but those of
/// homogeneous nets (quotients) are widened by 4 u of each bound. Cost: reading the nets.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report control_boxes(const ControlNets<T>& nets,
                                                  const std::type_identity_t<Boxes<T>>& out,
                                                  const RunOptions& options = {}) noexcept;

/// How far tight_boxes() may subdivide.
inline constexpr int kMostBoxLevels = 6;

/// Finds closer boxes of the surface, never larger than the control boxes: around the control
/// points of 4^levels pieces, widened by a proven bound on the roundings (docs/accuracy.md). Every
/// level divides the distance to the surface's own box by four. If weights or values come near the
/// ends of the number range, the control box is returned.
/// levels: 0 (control boxes) to kMostBoxLevels, else bad_grid; 2 leaves about 6 % of the distance.
/// Cost:   about 4^levels times that of split().
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report tight_boxes(const ControlNets<T>& nets, int levels,
                                                const std::type_identity_t<Boxes<T>>& out,
                                                const RunOptions& options = {}) noexcept;

/// Bounds the distance of each patch from the bilinear patch L of its four corner points: max
/// |S(u,v) - L(u,v)|, Euclidean over all components. Two triangles are at most as far from the
/// patch as the sum of this bound and their own distance from L.
/// Formula: max |P_ij - L(i/m, j/n)|; for rational nets the same at degree (m+1, n+1).
///          docs/accuracy.md has the proof and counts the roundings. 0 if all points are equal;
///          infinite if weights come near the ends of the number range or differences overflow.
/// out:     count values.
/// Cost:    one pass over the control points, some 10 operations a component and point.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report flatness(const ControlNets<T>& nets,
                                             const std::type_identity_t<Values<T>>& out,
                                             const RunOptions& options = {}) noexcept;

// Certified error bounds of single patches and curves, tighter than those that hold for all.

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

/// Finds the largest position bound of any component of any patch: 0 for an empty set, infinity if
/// `isa` cannot be resolved. Cost: at most that of error_bounds() for every patch.
template <typename T>
[[nodiscard]] SIMDBEZIER_API double largest_position_bound(const PatchSet<T>& set,
                                                           Isa isa = Isa::automatic) noexcept;

/// Whether every position of the set is certified to be within `tolerance` of the exact one. For a
/// PatchSet<float>, this says whether single precision is enough. Cost: as above.
template <typename T>
[[nodiscard]] bool meets_tolerance(const PatchSet<T>& set, double tolerance,
                                   Isa isa = Isa::automatic) noexcept {
  return largest_position_bound(set, isa) <= tolerance;
}

} // namespace simdbezier
