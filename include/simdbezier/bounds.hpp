// Certified boxes and flatness of control nets: what culling, intersection and adaptive subdivision
// ask for. Each bound holds for the exact surface of the control points as given, whatever rounds.
//
// For every call
//   Nets        S = float or double, any degrees and components; values finite, weights positive.
//   Outputs     packed arrays of the caller's, one row a patch; they may not overlap the nets or
//               each other. Component c of patch p stands at [p * components + c].
//   Bits        equal on all instruction sets, for any number of threads and place in the batch.
//   Threads     Options::threads, isa and executed are honoured. Allocation: scratch per thread.
//   Statuses    as in nets.hpp; on an error nothing has been written.
#pragma once

#include <type_traits>

#include <simdbezier/nets.hpp>

namespace simdbezier {

/// Where boxes go: count * components values each, neither null.
template <typename T>
struct Boxes {
  T* low = nullptr;
  T* high = nullptr;
};

/// The smallest and largest control values, projected where nets have weights: S lies in the convex
/// hull of its control points, so also in this box. Exact; homogeneous nets divide, and their boxes
/// are opened by 4 u of each bound.
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport control_boxes(const ControlNets<T>& nets,
                                                     const std::type_identity_t<Boxes<T>>& out,
                                                     const Options& options = {}) noexcept;

/// How far tight_boxes() may subdivide.
inline constexpr int kMostBoxLevels = 6;

/// Boxes that contain the surface and are never larger than the control boxes: the hull of the
/// control points of 4^levels pieces, opened by a proven bound on what rounding did to them. Every
/// level cuts the distance to the surface's own box to a quarter.
///
/// levels:   0 (control boxes) to kMostBoxLevels, else bad_grid; 2 leaves about 6 % of the excess.
/// Rounding: with Q = P - P[0][0], E = max|Q| and M = max|P| of a component, d = levels (m + n):
///           each value of a piece passes through at most d means of two numbers, every one of
///           which errs by at most u E (a mean of numbers within E, products by 1/2 are exact), and
///           means do not amplify: d u E, u E more for Q. Rational: the mean of w Q errs by u times
///           the same mean of w |Q| and that of w by u times itself, so that after the division the
///           error is at most (2 d + 3) u E whatever the weights. Adding P[0][0] and the margin
///           costs at most 4 u M; denormals are counted at their smallest unit each. Where weights
///           or values come near the ends of the number range the control box is returned.
/// Cost:     about 4^levels times that of split().
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport tight_boxes(const ControlNets<T>& nets, int levels,
                                                   const std::type_identity_t<Boxes<T>>& out,
                                                   const Options& options = {}) noexcept;

/// An upper bound on max |S(u,v) - L(u,v)| over the patch, Euclidean over all components, where
/// L is the bilinear patch of the four corner points with the same parameters; one value a patch.
/// Below a tolerance, two triangles with an error of their own do for the patch.
///
/// Proof:    polynomial: L has degree (m, n) control points L_ij = L(i/m, j/n), so S - L has
///           P_ij - L_ij, and lies in their convex hull: the bound is max |P_ij - L_ij|.
///           Rational: with W = sum w B B, S - L = (sum w P B B - W L) / W. Both parts of the
///           numerator have degree (m+1, n+1) control points,
///               N_kl = sum_ab a_k b_l w_(k-a,l-b) (P_(k-a,l-b) - c_ab),   a, b in {0, 1},
///           c_ab the corners, a_k = k/(m+1) for a = 1 and 1 - k/(m+1) for a = 0, b_l likewise; W
///           elevated to that degree has w_kl = sum_ab a_k b_l w_(k-a,l-b) > 0. So S - L is
///           a convex combination of the N_kl / w_kl: the bound is max |N_kl / w_kl|.
/// Rounding: with Q = P - P[0][0] and E = max|Q|, differences err by less than 16 u E (rational:
///           40 u E; homogeneous nets: 8 u max|P| more for the division) a component; the result is
///           opened by that, by the roundings of the norm and by a few denormals. It is 0 where all
///           control points are one, and infinite where the weights come near the ends of the
///           number range or the differences overflow.
/// out:      count values.
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport flatness(const ControlNets<T>& nets,
                                                std::type_identity_t<T>* out,
                                                const Options& options = {}) noexcept;

} // namespace simdbezier
