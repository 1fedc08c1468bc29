// Control nets from control nets: cuts, pieces, degree elevation, reversals, derivatives.
//
// Constraints that hold for every call
//   Nets      any degrees from 1 to kMostDegree, any components. With weights the arithmetic is
//             that of homogeneous coordinates (wx, wy, wz, w); the form of the nets stays.
//   Outputs   belong to the caller. Count, components and weights are those of the input; each
//             operation says which degrees they have. They may not overlap the inputs or each
//             other, but may be interleaved (four children of a patch side by side, for instance).
//             If the strides are sorted by size, each must be larger than what the smaller ones
//             span.
//   Faults    control values must be finite and weights positive; the first patch at fault is
//             named. Values so large that the operation overflows come out infinite or nan.
//   Bits      equal on all instruction sets (products and sums are rounded one by one, nothing is
//             fused), for any number of threads and any place in the batch. The reversed net at
//             mirrored parameters gives the reversed result bit for bit. -0 becomes +0.
//   Edges     an edge of the result that lies on an edge of the patch depends on that edge's
//             control points only: neighbours with bit-equal edges keep them after equal
//             operations, in any orientation. Corners of the patch, and whole edges that the
//             operation does not touch, stay exact. Equal neighbouring values stay equal: a
//             collapsed edge stays collapsed, whatever its weights.
//   Threads   RunOptions::threads. Allocation: scratch per thread, none per patch. Nothing throws.
//   Statuses  ok, those of views and running (Status) | null_output | output_too_small | bad_weight
//             | non_finite_input | bad_patch_range (counts differ) | overlapping_outputs.
//   Source    G. Farin, Curves and Surfaces for CAGD, 5th ed., chapters 4 to 6 and 14.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include <simdbezier/options.hpp>
#include <simdbezier/patch_set.hpp>

namespace simdbezier {

/// The caller's memory for control nets. Its members mean what they mean in ControlNets, to which
/// it converts, so that one operation's output can be the next one's input.
template <typename S>
struct MutableNets {
  S* points = nullptr; ///< may be null only when count is 0
  std::size_t count = 0;
  int degree_u = 3;
  int degree_v = 3;
  std::ptrdiff_t patch_stride = 48;
  std::ptrdiff_t row_stride = 12;
  std::ptrdiff_t point_stride = 3;
  std::ptrdiff_t component_stride = 1;
  int components = 3;
  Weights weights = Weights::none;
  std::span<S> memory = {}; ///< as in ControlNets (else output_too_small)

  /// Makes a view as ControlNets::packed() does; a span is the memory of `count` nets.
  [[nodiscard]] static constexpr MutableNets packed(S* points, std::size_t count, int degree_u,
                                                    int degree_v, int components = 3,
                                                    Weights weights = Weights::none) noexcept {
    const auto like =
        ControlNets<S>::packed(points, count, degree_u, degree_v, components, weights);
    return {points,
            count,
            degree_u,
            degree_v,
            like.patch_stride,
            like.row_stride,
            like.point_stride,
            like.component_stride,
            components,
            weights,
            {}};
  }
  [[nodiscard]] static constexpr MutableNets packed(std::span<S> points, std::size_t count,
                                                    int degree_u, int degree_v, int components = 3,
                                                    Weights weights = Weights::none) noexcept {
    MutableNets nets = packed(points.data(), count, degree_u, degree_v, components, weights);
    nets.memory = points;
    return nets;
  }

  constexpr operator ControlNets<S>() const noexcept { // NOLINT: implicit on purpose
    return {points,       count,      degree_u,     degree_v,
            patch_stride, row_stride, point_stride, component_stride,
            components,   weights,    memory};
  }
};

namespace detail {

// Roundings of UnitParameter. They are in the library because a caller's -Ofast would replace
// 1 - (1 - t) by t, and i / n by a product with 1 / n: results would have other bits.
template <typename T>
[[nodiscard]] SIMDBEZIER_API T one_less(T t) noexcept;
template <typename T>
[[nodiscard]] SIMDBEZIER_API T quotient(std::int64_t i, std::int64_t n) noexcept;

} // namespace detail

/// A parameter t together with its complement 1 - t. Both enter into the arithmetic; mirrored pairs
/// give mirrored results with equal bits.
template <typename T>
class UnitParameter {
public:
  /// t and 1 - t, rounded: exact for 1/2 <= t <= 1 and all multiples of 2^-24 (double: 2^-53).
  constexpr UnitParameter(T t) noexcept : t_(t), complement_(one_less(t)) {} // NOLINT: implicit
  /// Counted from the other end: the complement is c, and t = 1 - c rounded.
  [[nodiscard]] static constexpr UnitParameter from_end(T c) noexcept { return {one_less(c), c}; }
  /// i / n and (n - i) / n, each rounded once if T holds i, n and n - i; n > 0.
  [[nodiscard]] static constexpr UnitParameter fraction(int i, int n) noexcept {
    return {quotient(i, n), quotient(std::int64_t{n} - i, n)};
  }

  [[nodiscard]] constexpr T t() const noexcept { return t_; }
  [[nodiscard]] constexpr T complement() const noexcept { return complement_; }
  /// The parameter of the same point on the reversed curve.
  [[nodiscard]] constexpr UnitParameter mirrored() const noexcept { return {complement_, t_}; }

private:
  constexpr UnitParameter(T t, T complement) noexcept : t_(t), complement_(complement) {}

  static constexpr T one_less(T t) noexcept {
    return std::is_constant_evaluated() ? T(1) - t : detail::one_less(t);
  }
  static constexpr T quotient(std::int64_t i, std::int64_t n) noexcept {
    return std::is_constant_evaluated() ? static_cast<T>(i) / static_cast<T>(n)
                                        : detail::quotient<T>(i, n);
  }

  T t_;
  T complement_;
};

// T is deduced from the nets alone, so that callers can pass plain numbers as parameters.
template <typename T>
using AtParameter = std::type_identity_t<UnitParameter<T>>;

/// Cuts every patch at u: `low` is the part over [0, u], `high` the one over [u, 1], each again
/// over [0,1], with the degrees of the input.
/// Formula:    de Casteljau, b = (1-t) a + t b (a if a = b); the triangle's sides are the nets.
/// Parameters: finite (else non_finite_input). Outside of [0,1] they extrapolate; nets with weights
///             are then refused (bad_weight), because a weight could change its sign.
/// Errors:     at most 3 degree_u u max|P| a component (u = 2^-24 or 2^-53) for parameters in
///             [0,1]; with weights, the bound holds for numerators and for weights. At 0, 1/2 and 1
///             only sums are rounded.
/// Cost:       reading and writing the nets in cache; O(degree) times that for high degrees.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report split_u(const ControlNets<T>& nets, AtParameter<T> u,
                                            const std::type_identity_t<MutableNets<T>>& low,
                                            const std::type_identity_t<MutableNets<T>>& high,
                                            const RunOptions& options = {}) noexcept;

/// Cuts every patch at v, in the same way.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report split_v(const ControlNets<T>& nets, AtParameter<T> v,
                                            const std::type_identity_t<MutableNets<T>>& low,
                                            const std::type_identity_t<MutableNets<T>>& high,
                                            const RunOptions& options = {}) noexcept;

/// Cuts every patch at u, then both parts at v: out[2 * (v half) + (u half)].
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report
split(const ControlNets<T>& nets, AtParameter<T> u, AtParameter<T> v,
      const std::array<std::type_identity_t<MutableNets<T>>, 4>& out,
      const RunOptions& options = {}) noexcept;

/// A rectangle of the parameter domain. u0 > u1 turns the piece around; u0 = u1 gives a line.
template <typename T>
struct SubPatch {
  UnitParameter<T> u0 = T(0);
  UnitParameter<T> u1 = T(1);
  UnitParameter<T> v0 = T(0);
  UnitParameter<T> v1 = T(1);
};

/// Cuts [u0, u1] x [v0, v1] out of every patch, as a patch over [0,1]^2 of the same degrees.
/// Formula:            control point i is the blossom at u0 (degree - i times) and u1 (i times). It
///                     is computed twice, with u0 inserted first and with u1 inserted first, and
///                     the result is the mean of both, so that neither end is favoured. Pieces that
///                     meet at one parameter get bit-equal points there, and [0, u] is what
///                     split_u() gives, except for u = 1: a whole direction is copied, while
///                     split_u() takes cartesian points to homogeneous ones and back.
/// Parameters, errors: as split_u(). Cost: reading and writing the nets; O(degree^2) times that for
/// high degrees. Whole directions cost nothing.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report segment(const ControlNets<T>& nets,
                                            const std::type_identity_t<SubPatch<T>>& piece,
                                            const std::type_identity_t<MutableNets<T>>& out,
                                            const RunOptions& options = {}) noexcept;

/// Raises the degrees of the same surfaces to those of `out` (lower ones are bad_degree).
/// Formula: q_i = sum_k C(n,k) C(r,i-k) p_k / C(n+r,i), degree n to n+r, paired from both ends.
/// Errors:  float: one rounding (the sums are carried in double). double: at most (n + 2) u max|P|
///          per direction. Exact if these sums and quotients are.
/// Cost:    O(degree) multiply-adds a value and direction whose degree rises.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report elevate(const ControlNets<T>& nets,
                                            const std::type_identity_t<MutableNets<T>>& out,
                                            const RunOptions& options = {}) noexcept;

/// Makes the derivative patches dS/du: control points degree_u (P[j][i+1] - P[j][i]), degree_u - 1
/// by degree_v. A direction of degree 1 keeps its degree, with two equal columns, because nets have
/// no degree 0. Polynomial nets only (bad_weight). Errors: two roundings a value; float: one. Cost:
/// about the time of reading and writing the nets.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report hodograph_u(const ControlNets<T>& nets,
                                                const std::type_identity_t<MutableNets<T>>& out,
                                                const RunOptions& options = {}) noexcept;

/// Makes the derivative patches dS/dv, in the same way.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report hodograph_v(const ControlNets<T>& nets,
                                                const std::type_identity_t<MutableNets<T>>& out,
                                                const RunOptions& options = {}) noexcept;

/// Reverses u, on the same surface: Q[j][i] = P[j][degree_u - i]. The result is a copy; for calls
/// that only read, the view reversed_u() is enough. This call and the two below cost as much as
/// reading and writing the nets.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report reverse_u(const ControlNets<T>& nets,
                                              const std::type_identity_t<MutableNets<T>>& out,
                                              const RunOptions& options = {}) noexcept;

/// Reverses v: Q[j][i] = P[degree_v - j][i].
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report reverse_v(const ControlNets<T>& nets,
                                              const std::type_identity_t<MutableNets<T>>& out,
                                              const RunOptions& options = {}) noexcept;

/// Exchanges u and v: Q[i][j] = P[j][i]; degree_u of `out` is degree_v of the input.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report transpose(const ControlNets<T>& nets,
                                              const std::type_identity_t<MutableNets<T>>& out,
                                              const RunOptions& options = {}) noexcept;

/// Views of the same nets the other way round: no memory is touched. `nets` must be valid.
template <typename S>
[[nodiscard]] constexpr ControlNets<S> reversed_u(ControlNets<S> nets) noexcept {
  nets.points = nets.count == 0 ? nets.points : nets.points + nets.degree_u * nets.point_stride;
  nets.point_stride = -nets.point_stride;
  return nets;
}
template <typename S>
[[nodiscard]] constexpr ControlNets<S> reversed_v(ControlNets<S> nets) noexcept {
  nets.points = nets.count == 0 ? nets.points : nets.points + nets.degree_v * nets.row_stride;
  nets.row_stride = -nets.row_stride;
  return nets;
}
template <typename S>
[[nodiscard]] constexpr ControlNets<S> transposed(ControlNets<S> nets) noexcept {
  const int degree = nets.degree_u;
  nets.degree_u = nets.degree_v;
  nets.degree_v = degree;
  const std::ptrdiff_t stride = nets.row_stride;
  nets.row_stride = nets.point_stride;
  nets.point_stride = stride;
  return nets;
}

// Other bases, to and from Bézier control points: power, Hermite, Catmull-Rom, uniform B-spline.
//
// A net changes basis by P' = A P B^T, one matrix a direction. The matrices are exact (integers
// over one denominator a row). Nets of float are carried in double and rounded once at the end;
// nets of double are rounded after every sum. The result is exact if the sums are exact, as for
// integer control points of moderate size, and if every denominator divides its sum.
//
// The constraints of all calls hold here as well: outputs, faults, bits, zeros, threads, statuses.

/// What the values of a "net" stand for in each direction, and which denominators conversions have.
enum class Basis : std::uint8_t {
  power, ///< sum_k c_k u^k; any degree. To Bézier: c over binomials; from it: no denominator
  centred_power, ///< sum_k c_k (2u-1)^k; any degree. From Bézier: over 2^degree
  hermite,     ///< f(0), f(1), f'(0), f'(1); so P[2][2], … are twists. Cubic. To Bézier: thirds
  catmull_rom, ///< four points; the piece between the middle two, tension 1/2. Cubic. To: sixths
  b_spline ///< four points of a uniform cubic B-spline; one piece of it. Cubic. To: sixths. Whole
           ///< surfaces, of any knots: splines.hpp
};

/// Computes the Bézier control points of surfaces that are given in another basis.
/// Degrees: equal in `out` and the input; 3 x 3 except for power bases (else bad_degree).
/// Weights: power bases take homogeneous nets (a numerator and a denominator polynomial, of any
///          sign), B-splines take both forms (NURBS pieces), all others none (else bad_weight).
/// Edges:   pieces of one B-spline or Catmull-Rom net get bit-equal control points on common edges.
/// Errors:  those of the sums, relative to the largest value of either basis: powers of u amplify
///          rounding errors by up to 3^degree a direction (a round trip of a 15 x 15 patch keeps no
///          digit in float), centred powers by about 2^(degree/2), the others by small constants.
/// Source:  Farin, chapters 5, 7 and 8; J. D. Foley et al., Computer Graphics, 2nd ed., 11.2.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report to_bezier(Basis basis, const ControlNets<T>& nets,
                                              const std::type_identity_t<MutableNets<T>>& out,
                                              const RunOptions& options = {}) noexcept;

/// The inverse: computes the values in another basis of surfaces given by Bézier control points.
/// Weights: power bases take homogeneous nets, all others none.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Report from_bezier(Basis basis, const ControlNets<T>& nets,
                                                const std::type_identity_t<MutableNets<T>>& out,
                                                const RunOptions& options = {}) noexcept;

} // namespace simdbezier
