// Batches of Bézier curves: packed, then evaluated like patches, with the same contracts.
//
//     pack(ControlCurves, set);   evaluate(set, where, out, options)
//     where: CurveGrid, CurveGrids or CurveSamples; out: CurveOutputs
//     C(t) = sum_i P[i] B_i^n(t), t in [0,1]; with weights, (sum w P B) / (sum w B)
//
// The constraints of evaluate.hpp hold here: parameters, outputs, bits, allocation, layouts. Ends
// are the first and the last control point exactly. A curve with the control points of a patch's
// edge gets the bits of that edge at equal parameters, and a reversed curve has the bits of the
// curve at mirrored uniform parameters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <utility>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/evaluate.hpp>

namespace simdbezier {

namespace detail {
template <typename T>
struct CurveStorage;
}

/// Packed curves, ready to be evaluated: centred coefficients of T = float or double. They have one
/// degree and one number of components, and either all or none of them have weights. Sharing,
/// threads and the default are as for PatchSet.
template <typename T>
class CurveSet {
public:
  CurveSet() noexcept = default;

  /// Number of curves.
  [[nodiscard]] SIMDBEZIER_API std::size_t size() const noexcept;
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }

  /// Degree, components and weights of all curves; those of ControlCurves{} if default-constructed.
  [[nodiscard]] SIMDBEZIER_API int degree() const noexcept;
  [[nodiscard]] SIMDBEZIER_API int components() const noexcept;
  [[nodiscard]] SIMDBEZIER_API bool rational() const noexcept;

  /// Whether the set was packed with PackOptions::local_origin.
  [[nodiscard]] SIMDBEZIER_API bool has_local_origins() const noexcept;

  /// This is for the library's own use: the packed arrays (null for an empty set).
  [[nodiscard]] const detail::CurveStorage<T>* storage() const noexcept { return storage_.get(); }
  explicit CurveSet(std::shared_ptr<const detail::CurveStorage<T>> storage) noexcept
      : storage_(std::move(storage)) {}

private:
  std::shared_ptr<const detail::CurveStorage<T>> storage_;
};

/// Packs curves into a set, which evaluate() takes.
/// Formula:    the coefficients of powers of X = t - 1/2; from degree 6 on, those of both halves
///             around their own middles, as accurate as de Casteljau's algorithm.
/// curves:     S = float or double; the memory may be freed after the call.
/// options:    as for patches, but reuse_memory has no effect. relative_to applies to the first
///             three components. A curve has the bits of a patch's edge only if both have the same
///             options.
/// Numerics:   S = T = float: formed in double, else in double-double; rounded once to T. Results
///             depend neither on the instruction set nor on threads. -0 becomes +0.
/// Allocation: one block: for cubics in space 19 T and 12 S a curve. Positions read 18 T of these.
/// Returns:    as pack() of patches; Report::item is the curve, `point` its control point i.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Report pack(const ControlCurves<S>& curves, CurveSet<T>& set,
                                         const PackOptions& options = {}) noexcept;

/// n parameters for all curves of a range; sample (curve, i) has the index (curve - curves.first) *
/// n + i. If t is null, they are uniform, ends included: x_i = (2i-N)/N with N = n-1, by one
/// division. Otherwise t holds n values in any order.
template <typename T>
struct CurveGrid {
  std::size_t n = 0;
  const T* t = nullptr;
  Parameters parameters = Parameters::unit;
  SetRange curves = {};

  [[nodiscard]] static constexpr CurveGrid uniform(std::size_t n, SetRange curves = {}) noexcept {
    return {n, nullptr, Parameters::unit, curves};
  }
  [[nodiscard]] static constexpr CurveGrid at(std::span<const T> t,
                                              Parameters parameters = Parameters::unit,
                                              SetRange curves = {}) noexcept {
    return {t.size(), t.data(), parameters, curves};
  }
};

/// Uniform parameters, ends included: a number of them for each curve of a range. Sample i of the
/// k-th of these curves has the index offset[k] + i.
struct CurveGrids {
  std::span<const std::uint32_t> n; ///< 2 or more
  /// Where each curve's samples begin, ascending by n or more (samples in between are not touched).
  /// Empty: packed without gaps.
  std::span<const std::size_t> offset = {};
  /// The curves. A count, if given, must be the number of values in n (else unequal_lengths).
  SetRange curves = {};
};

/// Single samples in any order: sample k lies on curve[k] at t[k].
template <typename T>
struct CurveSamples {
  std::span<const std::uint32_t> curve; ///< indices into the set
  std::span<const T> t;                 ///< as many
  Parameters parameters = Parameters::unit;
};

/// The number of samples of a call, for which every output needs room, as for patches.
template <typename T>
[[nodiscard]] SIMDBEZIER_API std::size_t sample_count(const CurveSet<T>& set,
                                                      const CurveGrid<T>& grid) noexcept;
template <typename T>
[[nodiscard]] SIMDBEZIER_API std::size_t sample_count(const CurveSet<T>& set,
                                                      const CurveGrids& grids) noexcept;
template <typename T>
[[nodiscard]] std::size_t sample_count(const CurveSet<T>& /*set*/,
                                       const CurveSamples<T>& samples) noexcept {
  return samples.curve.size();
}

/// The outputs of a call: at least one vector or the curvature. Tangents and curvatures need two or
/// three components, and are never nan for t in [0,1]. If d1 is zero (a cusp, repeated control
/// points), the tangent has the direction of the first Taylor coefficient of d1 that is not zero on
/// the way to the curve's middle (upwards from t = 1/2), and the status is SampleStatus::limit.
/// Which coefficient that is, is decided exactly, for the control points as given. The curvature is
/// its limit on that way: +infinity at a usual cusp, 0 on a straight line. If all coefficients are
/// zero, the curve is a point, and both are zero: SampleStatus::degenerate. Curvatures of regular
/// samples have no error bound, because rounded d1 and d2 are divided by |d1|^3: near cusps and on
/// nearly straight curves no digit may be correct. Source: G. Farin, Curves and Surfaces for CAGD,
/// chapters 4, 5, 10 and 13.
template <typename T>
struct CurveOutputs {
  Vectors<T> position;
  Vectors<T> d1;
  Vectors<T> d2;
  Vectors<T> tangent;
  Values<T> curvature;         ///< |C' x C''| / |C'|^3
  Values<SampleStatus> status; ///< only tangents and curvatures report `limit` and `degenerate`
  int first_component = 0;     ///< as in Outputs

  /// How the vectors are numbered, and how many there are.
  using Name = CurveOutput;
  static constexpr std::size_t kVectors = kCurveVectorOutputs;
  [[nodiscard]] constexpr Vectors<T>& operator[](CurveOutput output) noexcept {
    return this->*kMembers[static_cast<std::size_t>(output)];
  }
  [[nodiscard]] constexpr const Vectors<T>& operator[](CurveOutput output) const noexcept {
    return this->*kMembers[static_cast<std::size_t>(output)];
  }

private:
  static constexpr Vectors<T> CurveOutputs::*kMembers[] = {
      &CurveOutputs::position, &CurveOutputs::d1, &CurveOutputs::d2, &CurveOutputs::tangent};
  static_assert(std::size(kMembers) == kVectors, "every vector output has a member, in its order");
};

/// Evaluates every curve of a range on one grid. error_bounds() certifies the accuracy.
/// Options::watertight has no effect, because ends are always exact.
/// Formula: in X = t - 1/2, like the edges of patches: even and odd parts in degrees 3, 4 and 5,
///          otherwise Horner's rule and synthetic division, `degree` multiply-adds a component,
///          sample and derivative; the quotient rule for rational curves.
/// Returns: ok | the statuses of outputs and of running | bad_grid | bad_patch_range.
///          bad_components: CurveOutputs::first_component is outside of the set's, or a tangent or
///          a curvature is asked of a set without two or three.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate(const CurveSet<T>& set, const CurveGrid<T>& grid,
                                             const CurveOutputs<T>& out,
                                             const Options& options = {}) noexcept;

/// Evaluates every curve of a range on its own uniform parameters, with the bits of the call above
/// on each curve alone. Threads share samples. Outputs overlap if their ranges do. Allocation: 8
/// bytes a curve and scratch per thread. Also returns unequal_lengths | null_input | bad_offsets.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate(const CurveSet<T>& set, const CurveGrids& grids,
                                             const CurveOutputs<T>& out,
                                             const Options& options = {}) noexcept;

/// Evaluates single samples, by the operations of a grid: equal centred parameters give equal bits.
/// Runs of samples of one curve are fast. Streaming stores are used with Destination::memory only.
/// Returns as the first call, but unequal_lengths | null_input | bad_patch_index instead of
/// bad_grid and bad_patch_range.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate(const CurveSet<T>& set, const CurveSamples<T>& samples,
                                             const CurveOutputs<T>& out,
                                             const Options& options = {}) noexcept;

extern template class CurveSet<float>;
extern template class CurveSet<double>;

// Curves on patches: the four boundaries, and iso-parametric curves.

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
/// nets:     S = float or double; with weights, the points have them in the form of the nets.
/// u0:       any finite value; 0 and 1 give the boundary's points exactly.
/// points:   count * (degree_v + 1) * (components + 1 with weights) values, packed as in
///           ControlCurves::packed(); may not overlap the nets. No alignment needed.
/// Numerics: de Casteljau's algorithm in double, (1-t) a + t b at every step, with the same bits
///           always; a reversed net gives them at 1 - u0 if that is exact. Error at most 2
///           (degree_u + 1) 2^-53 max|P| (with weights: of the homogeneous points) for u0 in [0,1].
/// Returns:  ok | the statuses of views | null_output | output_too_small | bad_weight |
///           non_finite_input (also of u0) | overlapping_outputs. Allocation: none.
/// Cost:     degree_u (degree_u + 1) (degree_v + 1) / 2 interpolations a component and patch.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Report iso_u(const ControlNets<S>& nets, double u0,
                                          Values<double> points,
                                          const RunOptions& options = {}) noexcept;

/// The same for S(., v0), which has degree degree_u.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Report iso_v(const ControlNets<S>& nets, double v0,
                                          Values<double> points,
                                          const RunOptions& options = {}) noexcept;

/// Packs the iso-parametric curve S(u0, .) (or S(., v0)) of every patch: iso_u() (iso_v()) and
/// pack() by way of memory of its own. Evaluated positions agree with the patch's own within the
/// sum of both bounds and of the error that iso_u() states. Returns the statuses of both.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Report iso_u(const ControlNets<S>& nets, double u0,
                                          CurveSet<T>& curves,
                                          const PackOptions& options = {}) noexcept;
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Report iso_v(const ControlNets<S>& nets, double v0,
                                          CurveSet<T>& curves,
                                          const PackOptions& options = {}) noexcept;

/// Packs the iso-parametric curve of every patch of a set. A set keeps its control points as they
/// were given, and they are used here. PackOptions::relative_to is taken from the set, but
/// local_origin is taken from `options`.
/// patches:    of one shape; their nets need not exist any more.
/// Numerics:   as the call above on the nets. If u0 is 0 or 1 and local_origin is that of the set,
///             curves of a set of double have the bits of its edges, and curves of a set of float
///             differ from them by roundings only. If the forms of weights differ, points are
///             divided by their weights at the end.
/// Allocation: (degree + 1) (components + 1 with weights) doubles a patch, and the curves.
/// Returns:    ok | bad_degree (patches of several shapes) | non_finite_input (u0, or points there)
///             | bad_weight (u0 is outside of [0,1], and a weight may lose its sign) |
///             coefficient_overflow | size_overflow | unsupported_isa | out_of_memory.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report iso_u(const PatchSet<T>& patches, double u0,
                                          CurveSet<T>& curves,
                                          const PackOptions& options = {}) noexcept;
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report iso_v(const PatchSet<T>& patches, double v0,
                                          CurveSet<T>& curves,
                                          const PackOptions& options = {}) noexcept;

} // namespace simdbezier
