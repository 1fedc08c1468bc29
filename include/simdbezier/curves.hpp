// Batches of Bézier curves: packed, then evaluated like patches, with the same contracts.
//
//     C(t) = sum_i P[i] B_i^n(t), t in [0,1]; with weights, (sum w P B) / (sum w B)
//
// What evaluate.hpp says about parameters, outputs, bits, allocation and layouts holds here. Ends
// are the first and the last control point exactly. A curve that has the control points of a
// patch's edge gets the bits of that edge at equal parameters, and a reversed curve those of the
// curve at mirrored uniform ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/evaluate.hpp>
#include <simdbezier/isa.hpp>
#include <simdbezier/patch_set.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier {

namespace detail {
template <typename T>
struct CurveStorage;
}

/// Non-owning description of `count` control polygons of equal degree and components.
///
/// Component c of point P[i] of curve k is
///     points[k * curve_stride + i * point_stride + c * component_stride]
/// with all strides in elements of S; the weight stands where component `components` would. The
/// default describes cubics of x y z triples, packed, curve after curve. The memory is read during
/// calls only.
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

  /// Points with all of their values side by side, curve after curve.
  [[nodiscard]] static constexpr ControlCurves packed(const S* points, std::size_t count,
                                                      int degree, int components = 3,
                                                      Weights weights = Weights::none) noexcept {
    const std::ptrdiff_t point = components + (weights == Weights::none ? 0 : 1);
    return {points, count, degree, (degree + 1) * point, point, 1, components, weights};
  }
};

/// Curves as centred coefficients, T = float or double; all of one degree and number of components,
/// all with weights or all without.
///
/// Immutable: any number of threads may evaluate one set at once. Copies share the storage and
/// cost one reference count. A default-constructed set holds no curves.
template <typename T>
class CurveSet {
public:
  CurveSet() noexcept = default;

  /// Number of curves.
  [[nodiscard]] SIMDBEZIER_API std::size_t size() const noexcept;
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }

  /// Of every curve; of the default ControlCurves for a default-constructed set.
  [[nodiscard]] SIMDBEZIER_API int degree() const noexcept;
  [[nodiscard]] SIMDBEZIER_API int components() const noexcept;
  [[nodiscard]] SIMDBEZIER_API bool rational() const noexcept;

  /// Whether the set was packed with PackOptions::local_origin.
  [[nodiscard]] SIMDBEZIER_API bool has_local_origins() const noexcept;

  /// For the library's own use: the packed arrays (null for an empty set).
  [[nodiscard]] const detail::CurveStorage<T>* storage() const noexcept { return storage_.get(); }
  explicit CurveSet(std::shared_ptr<const detail::CurveStorage<T>> storage) noexcept
      : storage_(std::move(storage)) {}

private:
  std::shared_ptr<const detail::CurveStorage<T>> storage_;
};

/// Forms the coefficients of powers of X = t - 1/2 of all curves; from degree 6 on, of both halves
/// of each curve around their own middles, which keeps them as accurate as de Casteljau's
/// algorithm.
///
/// curves:     S = float or double, see ControlCurves; the memory may be freed after the call.
/// set:        replaced on ok, left as it was otherwise.
/// options:    as for patches; relative_to applies to the first three components. A curve that is
///             to match a patch's edge must be packed with the patch's options.
/// Numerics:   S = T = float: formed in double, else in double-double; rounded once to T. Results
///             depend neither on the instruction set nor on threads. -0 in the input becomes +0.
/// Allocation: one block; of cubics in space 19 T and 12 S a curve, 18 T of which positions read.
/// Returns:    ok | null_input | bad_degree | bad_components | bad_stride | bad_weight (also: below
///             the smallest normal T, or infinite as T) | non_finite_input | coefficient_overflow |
///             size_overflow (also: strides that lead beyond what memory can address) |
///             unsupported_isa | out_of_memory; PackReport::patch is the curve,
///             `point` its control point i. A wrong SIMDBEZIER_ISA is ignored here.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API PackReport pack_curves(const ControlCurves<S>& curves,
                                                    CurveSet<T>& set,
                                                    const PackOptions& options = {}) noexcept;

/// n parameters common to all curves; sample index = (curve - first_patch) * n + i.
/// Null t: uniform, ends included, x_i = (2i-N)/N with N = n-1, by one division. Otherwise t holds
/// n values in any order.
template <typename T>
struct CurveGrid {
  std::size_t n = 0;
  const T* t = nullptr;
  Parameters parameters = Parameters::unit;

  [[nodiscard]] static constexpr CurveGrid uniform(std::size_t n) noexcept {
    return {n, nullptr, Parameters::unit};
  }
};

/// Uniform parameters, ends included, a number of them for each curve: sample i of the k-th curve
/// evaluated has index offset[k] + i.
struct CurveCounts {
  const std::uint32_t* n = nullptr; ///< one value a curve evaluated, 2 or more
  /// Where each curve's samples begin, ascending by n or more (samples in between are not touched).
  /// Null: packed without gaps.
  const std::size_t* offset = nullptr;
};

/// Scattered samples in any order: sample k lies on curve[k] at t[k].
template <typename T>
struct CurveSamples {
  std::size_t count = 0;
  const std::uint32_t* curve = nullptr; ///< count indices into the set
  const T* t = nullptr;                 ///< count values
  Parameters parameters = Parameters::unit;
};

/// The outputs of a call; every one is optional, at least one vector or the curvature is required.
/// Derivatives are with respect to t. Sets of one or two components have null z (and y) pointers,
/// as do calls for the last components of sets with more than three (Options::first_component).
///
/// The tangent is d1 / |d1|. Where d1 is zero (a cusp, repeated control points) it is the direction
/// of the first Taylor coefficient of d1 that is not, on the way to the curve's middle (upwards
/// from t = 1/2): SampleStatus::limit. Where all of them are zero the curve is a point and the
/// tangent zero: SampleStatus::degenerate. Which one it is, is decided exactly, for the control
/// points as given. The curvature there is its limit on the same way: +infinity at a usual cusp, 0
/// on a straight line or a point. Neither is ever nan for t in [0,1]. Both exist for sets of two
/// and three components. Source: G. Farin, Curves and Surfaces for CAGD, chapters 4, 5, 10 and 13.
template <typename T>
struct CurveOutputs {
  Vectors<T> position;            ///< C(t)
  Vectors<T> d1;                  ///< C'(t)
  Vectors<T> d2;                  ///< C''(t)
  Vectors<T> tangent;             ///< C' / |C'|
  T* curvature = nullptr;         ///< |C' x C''| / |C'|^3, unit stride
  SampleStatus* status = nullptr; ///< one value a sample, unit stride; tangents and curvatures only
                                  ///< report `limit` and `degenerate`
};

/// Evaluates curves [options.first_patch, first_patch + patch_count) of the set on one grid.
///
/// By Horner's rule in X = t - 1/2: `degree` multiply-adds a component and sample; derivatives by
/// synthetic division, as many again each; rational curves by the quotient rule.
/// options:   Options::watertight has no effect, ends cost nothing.
/// Accuracy:  see curve_bounds().
/// Returns ok | null_output | bad_stride | bad_components | overlapping_outputs | bad_grid |
/// bad_patch_range | size_overflow | unknown_isa | unsupported_isa | out_of_memory. On an error
/// nothing has been written.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_curves(const CurveSet<T>& set,
                                                    const CurveGrid<T>& grid,
                                                    const CurveOutputs<T>& out,
                                                    const Options& options = {}) noexcept;

/// Evaluates curves [options.first_patch, first_patch + patch_count), each on its own uniform
/// parameters: the values of the call above on each curve alone, bit for bit. Work is divided
/// between threads by samples. Outputs count as overlapping where their whole ranges do.
/// Allocation: 8 bytes a curve and scratch per thread, a call.
/// Returns, besides those of the call above, null_input (n, with curves to evaluate) | bad_offsets.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_curves(const CurveSet<T>& set,
                                                    const CurveCounts& counts,
                                                    const CurveOutputs<T>& out,
                                                    const Options& options = {}) noexcept;

/// Evaluates single samples, in the grid's own order of operations: where the centred parameters
/// are equal, the bits are. Runs of samples of one curve are fast ones. Streaming stores are used
/// with Destination::memory only.
/// Returns, besides those of the first call (without bad_grid, bad_patch_range), null_input |
/// bad_patch_index.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_curves(const CurveSet<T>& set,
                                                    const CurveSamples<T>& samples,
                                                    const CurveOutputs<T>& out,
                                                    const Options& options = {}) noexcept;

/// Absolute bounds on |computed - exact| of each component, at the centred parameters as rounded.
struct CurveBounds {
  double position[kMostComponents] = {};
  double d1[kMostComponents] = {};
  double d2[kMostComponents] = {};
};

/// The certificate of one curve, for every sample with t in [0,1].
///
/// Formula:     1.01 u sum_k (e_k + 1) |a_k| 2^-k over the coefficients in X, e_k = min(k+1, n)
///              roundings in Horner's rule, twice as many without FMA; the larger half where there
///              are two, with the rounding of its parameter, k more. Rational: the same of
///              numerator and denominator, carried through the quotient rule, the denominator being
///              at least the smallest weight.
/// Relative to: the control points less PackOptions::relative_to, as that difference was rounded.
/// Returns all zero for a curve outside of the set, and infinities where `isa` cannot be resolved.
/// No allocation, any thread.
template <typename T>
[[nodiscard]] SIMDBEZIER_API CurveBounds curve_bounds(const CurveSet<T>& set, std::size_t curve,
                                                      Isa isa = Isa::automatic) noexcept;

extern template class CurveSet<float>;
extern template class CurveSet<double>;

} // namespace simdbezier
