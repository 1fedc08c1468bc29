// Curves on patches: the four boundaries, and iso-parametric curves.
#pragma once

#include <cstddef>

#include <simdbezier/curves.hpp>
#include <simdbezier/patch_edge.hpp>

namespace simdbezier {

/// Views the control points of one boundary curve of every patch, in the nets' own memory. Packed
/// and evaluated, they give the patch's own positions on that edge, bit for bit.
template <typename S>
[[nodiscard]] constexpr ControlCurves<S> boundary_curves(const ControlNets<S>& nets,
                                                         PatchEdge edge) noexcept {
  const bool along_u = edge == PatchEdge::v0 || edge == PatchEdge::v1;
  std::ptrdiff_t first = 0;
  if (edge == PatchEdge::v1) {
    first = nets.degree_v * nets.row_stride;
  } else if (edge == PatchEdge::u1) {
    first = nets.degree_u * nets.point_stride;
  }
  return {nets.points == nullptr ? nullptr : nets.points + first,
          nets.count,
          along_u ? nets.degree_u : nets.degree_v,
          nets.patch_stride,
          along_u ? nets.point_stride : nets.row_stride,
          nets.component_stride,
          nets.components,
          nets.weights,
          nets.memory};
}

/// Computes the control points Q_j(u0) = sum_i P[j][i] B_i(u0) of every patch's curve S(u0, .).
/// nets:     S = float or double, any degrees; with weights, the points are those of the rational
///           curve, in the form (cartesian, homogeneous) of the nets.
/// u0:       any finite value; 0 and 1 give the boundary's points exactly.
/// points:   count * (degree_v + 1) * (components + 1 with weights) values, packed as in
///           ControlCurves::packed(); may not overlap the nets. No alignment needed.
/// Numerics: de Casteljau's algorithm in double, (1-t) a + t b at every step, with the same bits
///           always; a reversed net gives them at 1 - u0 if that is exact. Error at most 2
///           (degree_u + 1) 2^-53 max|P| (with weights: of the homogeneous points) for u0 in [0,1].
/// options:  only threads counts. Allocation: none.
/// Returns:  ok | the statuses of views | null_output | output_too_small | bad_weight |
///           non_finite_input (a value that is not finite, u0 included) | overlapping_outputs
/// Cost:     degree_u (degree_u + 1) (degree_v + 1) / 2 interpolations a component and patch.
template <typename S>
[[nodiscard]] SIMDBEZIER_API PackReport iso_u(const ControlNets<S>& nets, double u0,
                                              Values<double> points,
                                              const Options& options = {}) noexcept;

/// The same for S(., v0), which has degree degree_u.
template <typename S>
[[nodiscard]] SIMDBEZIER_API PackReport iso_v(const ControlNets<S>& nets, double v0,
                                              Values<double> points,
                                              const Options& options = {}) noexcept;

/// Packs the iso-parametric curve S(u0, .) (or S(., v0)) of every patch: iso_u() (iso_v()) and
/// pack() by way of memory of its own. Evaluated positions agree with the patch's own within the
/// sum of both bounds and of the error that iso_u() states. Returns the statuses of both.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API PackReport iso_u(const ControlNets<S>& nets, double u0,
                                              CurveSet<T>& curves,
                                              const PackOptions& options = {}) noexcept;
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API PackReport iso_v(const ControlNets<S>& nets, double v0,
                                              CurveSet<T>& curves,
                                              const PackOptions& options = {}) noexcept;

/// Packs the iso-parametric curve of every patch of a set, from the control points that it keeps as
/// they were given, with the PackOptions::relative_to of the set.
/// patches:    of one shape. The nets that they were packed from need not exist any more.
/// options:    relative_to is ignored; local_origin is not taken from the set.
/// Numerics:   as the call above on the nets themselves. At 0 and 1 a set of double that was packed
///             with the same local_origin gives the bits of its edges, and one of float gives them
///             but for their rounding. If some nets had Cartesian and some homogeneous weights, the
///             points are divided by their weights at the end.
/// Allocation: (degree + 1) (components + 1 with weights) doubles a patch, and the curves.
/// Returns:    ok | bad_degree (patches of several shapes) | non_finite_input (u0, or points that
///             are infinite there) | bad_weight (u0 is outside of [0,1], and a weight may lose its
///             sign) | coefficient_overflow | size_overflow | unsupported_isa | out_of_memory.
template <typename T>
[[nodiscard]] SIMDBEZIER_API PackReport iso_u(const PatchSet<T>& patches, double u0,
                                              CurveSet<T>& curves,
                                              const PackOptions& options = {}) noexcept;
template <typename T>
[[nodiscard]] SIMDBEZIER_API PackReport iso_v(const PatchSet<T>& patches, double v0,
                                              CurveSet<T>& curves,
                                              const PackOptions& options = {}) noexcept;

} // namespace simdbezier
