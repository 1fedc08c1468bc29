// B-spline and NURBS surfaces and curves with knots: from their control points to Bézier patches.
//
//     to_bezier(surface, nets, intervals)      control nets, and the interval of each patch
//     pack(surface, set)                       a PatchSet, without nets in between
//     locate(surface, U, V, places)            which patch has (U, V), and where on it
//     tessellate<T>(surfaces, options)         a closed mesh, as mesh.hpp makes it of nets
//
// A direction of degree p with n control points d_0 … d_(n-1) has the knots t_0 <= … <= t_(n+p).
// Its domain is [t_p, t_n]; every span [a, b] = [t_i, t_(i+1)] of it with a < b is one Bézier
// piece. Its control points are values of the spline's blossom f, b_k = f[a, …, a, b, …, b] (p - k
// times a, k times b): means of at most p + 1 neighbouring d with factors made of the knots.
//
// Constraints that hold for every call
//   Knots     n + p + 1 numbers in ascending order, none beyond 2^1000 in size, in double whatever
//             the points are. A knot may occur up to p + 1 times; t_p < t_n. No knots: uniform
//             ones, t_i = i - p. openNURBS leaves the first and the last one out.
//   Periodic  directions have n control points, which begin again after the last one, and n + 1
//             knots t_0 <= … <= t_n: one period, which is the domain. Span [t_i, t_(i+1)] depends
//             on points i to i + p modulo n. No knots: t_i = i.
//   Ranges    are parts of the domain, whose ends need not be knots. The first and the last piece
//             end there, and spans outside of a range have no pieces.
//   Patches   are numbered along u first: patch iv * patches_u + iu.
//   Error     Along one direction a control point is off by at most (m + 2) u max|d|, m = (p + 1) /
//             2 rounded up and u = 2^-53; both directions add. Results in float are rounded once
//             more. See docs/accuracy.md.
//   Bits      Factors that are 1 copy points, so that clamped ends are control points bit for bit.
//             Equal points give that point. Pieces on both sides of a knot that occurs up to p
//             times have bit-equal points there. If two splines are clamped on an edge, and have
//             equal control points and knots along it, their points along it are bit-equal. The
//             edge may run in u in one and in v in the other. It may also run the other way in one
//             of them, if its knots are exactly mirrored. Results do not depend on the instruction
//             set, threads or other splines.
//   Weights   must be above 0, doubles at least 2^-1000; products w P are rounded once to double
//             before anything else, and those that S cannot hold are coefficient_overflow.
//   Faults    control values must be finite; the first surface and point at fault is named.
//   Source    L. Ramshaw, Blossoming: A Connect-the-Dots Approach to Splines, 1987; G. Farin,
//             Curves and Surfaces for CAGD, 5th ed., 4.7 and 8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/curves.hpp>
#include <simdbezier/mesh.hpp>
#include <simdbezier/nets.hpp>
#include <simdbezier/patch_set.hpp>

namespace simdbezier {

/// Parameters from `begin` to `end`. If both are equal, the interval does not restrict anything.
struct Interval {
  double begin = 0;
  double end = 0;

  [[nodiscard]] constexpr double length() const noexcept { return end - begin; }
  [[nodiscard]] constexpr bool empty() const noexcept { return begin == end; }
  friend constexpr bool operator==(const Interval&, const Interval&) = default;
};

/// The parameters that a patch of a spline stands for: u = (U - u.begin) / u.length().
struct PatchInterval {
  Interval u;
  Interval v;
};

/// Describes a spline surface: rows x columns control points, the points of a row in u. Component c
/// of point (row, column) is points[row * row_stride + column * point_stride + c *
/// component_stride]; a weight stands behind the components.
template <typename S>
struct SplineSurface {
  const S* points = nullptr;
  std::size_t rows = 0;    ///< open: degree_v + 1 or more; periodic: degree_v or more
  std::size_t columns = 0; ///< the same in u
  std::ptrdiff_t row_stride = 0;
  std::ptrdiff_t point_stride = 3;
  std::ptrdiff_t component_stride = 1;
  int components = 3; ///< 1 to kMostComponents, without the weight
  Weights weights = Weights::none;
  bool periodic_u = false;
  bool periodic_v = false;
  int degree_u = 3; ///< 1 to kMostDegree
  int degree_v = 3;
  std::span<const double> knots_u = {}; ///< empty: uniform
  std::span<const double> knots_v = {};
  Interval u_range = {}; ///< empty: the whole domain
  Interval v_range = {};
  /// A knot that is no further than this from the knot before it, and from the first one of the
  /// equal knots before it, joins these. All of them become their first knot, or at the end of the
  /// domain their last one. An end of a range that is this near to a knot becomes that knot
  /// (bad_range if both ends become one).
  double knot_tolerance = 0;
  std::span<const S> memory = {}; ///< as in ControlNets
};

/// Describes a spline curve, in the same way.
template <typename S>
struct SplineCurve {
  const S* points = nullptr;
  std::size_t count = 0; ///< control points
  std::ptrdiff_t point_stride = 3;
  std::ptrdiff_t component_stride = 1;
  int components = 3;
  Weights weights = Weights::none;
  bool periodic = false;
  int degree = 3;
  std::span<const double> knots = {};
  Interval range = {};
  double knot_tolerance = 0;
  std::span<const S> memory = {};
};

/// How many patches a surface has in each direction; pieces of a curve are `u`, with v = 1.
struct SpanCounts {
  std::size_t u = 0;
  std::size_t v = 0;

  [[nodiscard]] constexpr std::size_t patches() const noexcept { return u * v; }
};

/// The number of patches of a surface, or of pieces of a curve; 0 if it would be refused. Cost:
/// that of its knots, not of its points.
template <typename S>
[[nodiscard]] SIMDBEZIER_API SpanCounts span_count(const SplineSurface<S>& surface) noexcept;
template <typename S>
[[nodiscard]] SIMDBEZIER_API SpanCounts span_count(const SplineCurve<S>& curve) noexcept;

/// Writes the knots of both directions as all calls take them: those are equal that knot_tolerance
/// makes equal. The points are not read.
/// u, v:    as many values as there are knots, also of uniform ones.
/// Returns: ok | bad_degree | bad_grid | null_input | bad_knots | bad_range | bad_tolerance |
///          size_overflow | output_too_small | out_of_memory. `component`: the direction; `point`:
///          the knot.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Report merged_knots(const SplineSurface<S>& surface,
                                                 std::span<double> u, std::span<double> v) noexcept;

/// Makes Bézier nets of spline surfaces, those of the first surface first.
/// surfaces:   equal degrees, components and presence of weights.
/// out:        as many nets as there are patches, of the surfaces' degrees and components, in other
///             memory than theirs; weights in either form. Rational points that are one point
///             whatever their weights (see Weights::homogeneous) stay one.
/// intervals:  of each patch; or empty.
/// Returns:    ok | the statuses of views | null_output | output_too_small | bad_degree,
///             bad_components (also: not those of `out`) | bad_weight | bad_grid (too few points) |
///             bad_knots | bad_range | bad_tolerance | bad_patch_range (`out` has another number of
///             nets) | unequal_lengths (`intervals`) | overlapping_outputs | non_finite_input |
///             coefficient_overflow (a value, a product w P, or a quotient that `out` asks for,
///             beyond 2^980 or, in float, 2^127)
///             | the statuses of running.
/// Allocation: tables of the knots, and degree_v + 2 lines of Bézier points a thread; threads share
///             the rows of spans. Cost: about (degree_u + 1) (degree_v + 1)^2 products and sums a
///             channel and patch.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report to_bezier(std::span<const SplineSurface<T>> surfaces,
                                              const std::type_identity_t<MutableNets<T>>& out,
                                              std::span<PatchInterval> intervals = {},
                                              const RunOptions& options = {}) noexcept;
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report to_bezier(const SplineSurface<T>& surface,
                                              const std::type_identity_t<MutableNets<T>>& out,
                                              std::span<PatchInterval> intervals = {},
                                              const RunOptions& options = {}) noexcept;

/// Makes the pieces of a curve in the same way: control points side by side, piece after piece, as
/// in ControlCurves::packed(), with weights in the curve's own form.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report to_bezier(const SplineCurve<T>& curve,
                                              const std::type_identity_t<Values<T>>& points,
                                              std::span<Interval> intervals = {},
                                              const RunOptions& options = {}) noexcept;

/// Packs the patches of spline surfaces without nets in between: the set is that of to_bezier() in
/// S, with homogeneous weights, and pack().
/// surfaces:   any degrees, with and without weights, of the same components.
/// intervals:  of each patch, as many as `surfaces` have patches (else unequal_lengths); or empty.
/// Allocation: the set, what to_bezier() needs, and nets of a few rows of spans for each thread.
/// Returns:    what to_bezier() and pack() return.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Report pack(std::span<const SplineSurface<S>> surfaces,
                                         PatchSet<T>& set, std::span<PatchInterval> intervals = {},
                                         const PackOptions& options = {}) noexcept;
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Report pack(const SplineSurface<S>& surface, PatchSet<T>& set,
                                         std::span<PatchInterval> intervals = {},
                                         const PackOptions& options = {}) noexcept;

/// Where parameters of a spline lie on its patches. Every array may be null: not asked for.
struct SplinePlaces {
  std::uint32_t* patch = nullptr;
  double* u = nullptr; ///< in [0, 1] of the patch, by one subtraction and one division
  double* v = nullptr;
  double* length_u = nullptr; ///< of the patch's interval: dS/dU = (dS/du) / length_u
  double* length_v = nullptr;
  /// The same parameters in [-1, 1], for Parameters::centred: ((U - a) - (b - U)) / (b - a) in the
  /// interval [a, b]. Unlike 2 u - 1, they are mirrored bit for bit if the parameters and the knots
  /// are mirrored exactly.
  double* centred_u = nullptr;
  double* centred_v = nullptr;
};

/// Finds the patch and the local parameters of each (U[k], V[k]).
/// Knots:    an inner knot belongs to the patch on its right side, the last knot to the last patch.
/// Periodic: parameters outside of the period are moved by whole periods.
/// U, V:     `count` values each, in any order, in the domain or range (else bad_range).
/// Returns:  ok | bad_degree | bad_grid | null_input | bad_knots | bad_range | bad_tolerance |
///           size_overflow (also: `patch` is asked for of more than 2^32 patches) |
///           non_finite_input | out_of_memory. `point`: the parameter or knot.
/// Cost:     a binary search for each parameter that is not in the span of the one before.
template <typename S>
[[nodiscard]] SIMDBEZIER_API Report locate(const SplineSurface<S>& surface, std::size_t count,
                                           const double* U, const double* V,
                                           const SplinePlaces& places) noexcept;
template <typename S>
[[nodiscard]] SIMDBEZIER_API Report locate(const SplineCurve<S>& curve, std::size_t count,
                                           const double* U, const SplinePlaces& places) noexcept;

/// The divisor that turns derivatives of these orders by u and v of a patch into those by U and V:
/// length_u^order_u length_v^order_v, one product after the other, as evaluations below divide.
[[nodiscard]] constexpr double derivative_divisor(int order_u, int order_v, double length_u,
                                                  double length_v) noexcept {
  double divisor = 1;
  for (int k = 0; k < order_u; ++k) {
    divisor *= length_u;
  }
  for (int k = 0; k < order_v; ++k) {
    divisor *= length_v;
  }
  return divisor;
}

/// Evaluates a spline surface on the grid of all (U[i], V[j]): sample (i, j) is j * U.size() + i.
/// surface: its knots, degrees and ranges are read, its points are not.
/// set:     made by pack() or by way of to_bezier(); the surface's patches are those from
///          `first_patch` on (else bad_patch_range).
/// U, V:    as locate() takes them, which also says which patch counts at a knot. Ascending
///          parameters are the fastest, because those of one span are evaluated together.
/// out:     as in evaluate(), with its bits at the centred places of locate(), rounded to T.
///          Derivatives are by U and V: they are divided by powers of the intervals' lengths, which
///          are formed in double and rounded to T. If T cannot hold these, results are 0, infinite
///          or nan.
/// Bits:    exactly mirrored splines have bit-equal positions at mirrored parameters. Their other
///          outputs are bit-equal between knots only: at a knot they come from different sides.
/// Returns: what locate() and evaluate() return. Allocation: a few values for each of U and V.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Report
evaluate_grid(const PatchSet<T>& set, const SplineSurface<S>& surface, std::span<const double> U,
              std::span<const double> V, const std::type_identity_t<Outputs<T>>& out,
              const Options& options = {}, std::size_t first_patch = 0) noexcept;

/// The same with a set of its own: pack() and evaluate_grid() in one call.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Report evaluate_grid(const SplineSurface<S>& surface,
                                                  std::span<const double> U,
                                                  std::span<const double> V, const Outputs<T>& out,
                                                  const Options& options = {}) noexcept;

/// Evaluates a spline surface at single parameters (U[k], V[k]), in any order, otherwise like
/// evaluate_grid(). They are copied first, so that outputs may lie in U and V. Allocation: 36 bytes
/// and two T a sample. Also returns unequal_lengths.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Report
evaluate_samples(const PatchSet<T>& set, const SplineSurface<S>& surface, std::span<const double> U,
                 std::span<const double> V, const std::type_identity_t<Outputs<T>>& out,
                 const Options& options = {}, std::size_t first_patch = 0) noexcept;

/// Evaluates a spline curve at parameters t[k], in any order, in the same way.
/// curve: its knots, degree and range are read, its points are not.
/// set:   packed from what to_bezier() makes of it; its pieces are those from `first_curve` on.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Report
evaluate_samples(const CurveSet<T>& set, const SplineCurve<S>& curve, std::span<const double> t,
                 const std::type_identity_t<CurveOutputs<T>>& out, const Options& options = {},
                 std::size_t first_curve = 0) noexcept;

/// Bounds the error of a Bézier control point of a surface in double, relative to the largest |d|
/// of the component (with weights: |w d|; of weights: the largest weight): (m_u + m_v + 4 + (1 for
/// Cartesian weights)) u (1 + 2^-40), m = (degree + 1) / 2 rounded up.
[[nodiscard]] constexpr double spline_error(int degree_u, int degree_v,
                                            Weights weights = Weights::none) noexcept {
  const int pairs = (degree_u + 2) / 2 + (degree_v + 2) / 2;
  return (pairs + 4 + (weights == Weights::cartesian ? 1 : 0)) * 0x1p-53 * (1 + 0x1p-40);
}

/// Bounds the distance between a surface and its patches at equal parameters. The patches are those
/// that to_bezier() makes in S, with homogeneous weights if any. Infinite if weights are too far
/// apart.
/// Formula: with N the numerator, W the weight, and N', W' of the patches, N'/W' - N/W = ((N' - N)
///          - (N/W) (W' - W)) / W'; N/W is no farther away than the farthest control point.
/// surface: one that to_bezier() accepts. Cost: a look at every control point.
template <typename S>
[[nodiscard]] SIMDBEZIER_API double extraction_error(const SplineSurface<S>& surface) noexcept;

/// Meshes of spline surfaces, whose patches are numbered as those of to_bezier(): see mesh.hpp.
/// surfaces:  of any degrees, with and without weights, of three components.
/// Deviation: is certified from the splines, with extraction_error() as a part of the tolerance.
/// report:    not null: gets the surface at fault, and the place in it; ok if none is.
/// Returns:   what to_bezier() and the call for nets return.
/// Memory:    also the nets of all patches while the mesh is planned.
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API MeshPlan<T> plan_mesh(std::span<const SplineSurface<S>> surfaces,
                                                   const MeshOptions& options,
                                                   Report* report = nullptr) noexcept;
template <typename T, typename S>
[[nodiscard]] SIMDBEZIER_API Mesh<T> tessellate(std::span<const SplineSurface<S>> surfaces,
                                                const MeshOptions& options,
                                                Report* report = nullptr) noexcept;
template <typename T, typename S>
[[nodiscard]] Mesh<T> tessellate(const SplineSurface<S>& surface,
                                 const MeshOptions& options) noexcept {
  return tessellate<T>(std::span<const SplineSurface<S>>(&surface, 1), options);
}

} // namespace simdbezier
