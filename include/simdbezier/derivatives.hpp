// evaluate_derivatives(set, where, derivatives, options): partial derivatives of any order.
//
// What holds for every call of evaluate.hpp holds here: parameters, watertight edges, bits,
// allocation, layouts, errors as values. The calls there are the fast way to derivatives of up to
// the second order; these have one kernel for all orders, at a cost that grows with the highest.
#pragma once

#include <concepts>
#include <span>
#include <type_traits>

#include <simdbezier/evaluate.hpp>
#include <simdbezier/partial_derivative.hpp>

namespace simdbezier {

/// What a call is asked for. It converts from anything that is a span of PartialDerivative.
template <typename T>
struct DerivativeOutputs {
  std::span<const PartialDerivative<T>> derivatives;
  int first_component = 0; ///< as in Outputs

  template <std::convertible_to<std::span<const PartialDerivative<T>>> Range>
  constexpr DerivativeOutputs(Range&& range, int first = 0) noexcept // NOLINT: implicit on purpose
      : derivatives(range), first_component(first) {}
};

/// Derivatives at single samples, in any order.
///
///     S^(a,b) = d^(a+b) S / du^a dv^b
///
/// Polynomials take repeated synthetic division in x = 2u-1, then in y, and give zero where an
/// order is above the degree. Rational patches S = H / w take the quotient rule of any order,
///     S^(a,b) = (H^(a,b) - sum_(i,j)>(0,0) C(a,i) C(b,j) w^(i,j) S^(a-i,b-j)) / w.
/// Source: L. Piegl and W. Tiller, The NURBS Book, 2nd edition, algorithms A3.6 (computed in
/// another way) and A4.4.
///
/// Shapes      component c of sample k of a derivative is its c-th pointer [k * stride], as in
///             Outputs. Sets may mix shapes.
/// Null        no derivative, or one without pointers, is null_output.
/// Aliasing    outputs overlap neither each other, nor the inputs, nor the list of derivatives; two
///             may be members of one vertex. Options::destination has no effect.
/// Edges       derivatives along an edge, (0,b) where u is 0 or 1 and (a,0) where v is, come from
///             that edge's control points alone, and have equal bits on both sides up to the sign
///             that the edge's orientation gives them. In the middle of an edge of degree 6 or
///             more, where two halves meet, they agree only within the bounds.
/// Bits        (0,0), (1,0), (0,1), (2,0), (1,1), (0,2) have the bits of evaluate(), except (2,0)
///             and (0,2) of rational patches, which are equal only within the bounds, and where a
///             result or a sum on the way to it is outside of the normal range. Bits do not depend
///             on which others are asked for.
/// Accuracy    docs/accuracy.md. What T cannot hold is infinite or nan.
/// Cost        polynomial: A n (m + B) multiply-adds a component, A and B the highest orders asked
///             for plus one; rational: 1/4 A^2 B^2 more. Samples of one patch are computed together
///             if not more than some hundreds of others lie between them.
/// Returns     ok | null_input | unequal_lengths | null_output | missing_y | missing_z | extra_y |
///             extra_z (as for evaluate()) | output_too_small | bad_degree (an order below 0 or
///             above kMostDerivativeOrder) | bad_components | bad_stride | overlapping_outputs |
///             bad_patch_index | unknown_isa | unsupported_isa | size_overflow | out_of_memory. On
///             an error nothing has been written.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_derivatives(
    const PatchSet<T>& set, const Samples<T>& samples,
    const std::type_identity_t<DerivativeOutputs<T>>& out, const Options& options = {}) noexcept;

/// Evaluates derivatives on one grid of every patch of a range, indexed as in Grid, and with the
/// bits of single samples at the same centred parameters. Returns what the call for samples does,
/// with bad_grid | bad_patch_range instead of null_input, unequal_lengths and bad_patch_index.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_derivatives(
    const PatchSet<T>& set, const Grid<T>& grid,
    const std::type_identity_t<DerivativeOutputs<T>>& out, const Options& options = {}) noexcept;

} // namespace simdbezier
