// evaluate_derivatives(set, where, derivatives, options): partial derivatives of any order.
//
// The constraints of evaluate.hpp hold here. Its calls are the fast way to derivatives of up to the
// second order; these have one kernel for all orders, whose cost grows with the highest.
#pragma once

#include <concepts>
#include <span>
#include <type_traits>

#include <simdbezier/evaluate.hpp>
#include <simdbezier/partial_derivative.hpp>

namespace simdbezier {

/// What a call is asked for: anything that converts to a span of PartialDerivative.
template <typename T>
struct DerivativeOutputs {
  std::span<const PartialDerivative<T>> derivatives;
  int first_component = 0; ///< as in Outputs

  template <std::convertible_to<std::span<const PartialDerivative<T>>> Range>
  constexpr DerivativeOutputs(Range&& range, int first = 0) noexcept // NOLINT: implicit on purpose
      : derivatives(range), first_component(first) {}
};

/// Evaluates derivatives at single samples, in any order: S^(a,b) = d^(a+b) S / du^a dv^b.
///
/// Polynomials take repeated synthetic division in x = 2u-1, then in y, and give zero for an order
/// above the degree. Rational patches S = H / w take the quotient rule of any order,
///     S^(a,b) = (H^(a,b) - sum_(i,j)>(0,0) C(a,i) C(b,j) w^(i,j) S^(a-i,b-j)) / w.
/// Shapes:   component c of sample k of a derivative is its c-th pointer [k * stride], as in
///           Outputs. Sets may mix shapes. No derivative, or one without pointers, is null_output.
/// Aliasing: outputs may not overlap each other, the inputs or the list of derivatives; two may be
///           members of one vertex. Options::destination has no effect.
/// Edges:    derivatives along an edge, (0,b) at u = 0 or 1 and (a,0) at v = 0 or 1, come from that
///           edge's control points alone. Both sides get equal bits, up to the sign that the edge's
///           orientation gives them; in the middle of an edge of degree 6 or more, where two halves
///           meet, they agree only within the bounds.
/// Bits:     (0,0), (1,0), (0,1), (2,0), (1,1), (0,2) have the bits of evaluate(), unless a result
///           or a sum on the way to it leaves the normal range; (2,0) and (0,2) of rational patches
///           agree only within the bounds. The other derivatives of a call change no bit.
/// Accuracy: docs/accuracy.md. What T cannot hold is infinite or nan.
/// Source:   L. Piegl and W. Tiller, The NURBS Book, 2nd ed., A3.6 (computed in another way), A4.4.
/// Cost:     polynomial: A n (m + B) multiply-adds a component, A and B the highest orders asked
///           for plus one; rational: 1/4 A^2 B^2 more. Samples of one patch are computed together
///           if at most some hundreds of others lie between them.
/// Returns:  as evaluate() for Samples; also bad_degree for an order below 0 or above
///           kMostDerivativeOrder.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_derivatives(
    const PatchSet<T>& set, const Samples<T>& samples,
    const std::type_identity_t<DerivativeOutputs<T>>& out, const Options& options = {}) noexcept;

/// Evaluates derivatives on one grid of every patch of a range, indexed as in Grid, with the bits
/// of single samples at the same centred parameters. Returns as evaluate(), and bad_degree.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_derivatives(
    const PatchSet<T>& set, const Grid<T>& grid,
    const std::type_identity_t<DerivativeOutputs<T>>& out, const Options& options = {}) noexcept;

} // namespace simdbezier
