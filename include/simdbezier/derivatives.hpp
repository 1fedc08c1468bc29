// Partial derivatives of any order.
//
// What holds for every call of evaluate.hpp holds here: parameters, watertight edges, bits,
// allocation, layouts, errors as values. The calls there are the fast way to derivatives of up to
// the second order; these have one kernel for all orders, at a cost that grows with the highest.
#pragma once

#include <cstddef>
#include <span>

#include <simdbezier/evaluate.hpp>

namespace simdbezier {

/// The highest order in each direction: from the degree on, nothing but zeros follows for
/// polynomials. Derivatives of rational patches do not end there.
inline constexpr int kMostDerivativeOrder = kMostDegree;

/// A derivative that a call is asked for: d^(a+b) S / du^a dv^b, a = order_u, b = order_v, each
/// from 0 to kMostDerivativeOrder; (0, 0) is the position.
template <typename T>
struct PartialDerivative {
  int order_u = 0;
  int order_v = 0;
  Vectors<T> out; ///< required; pointers as in Outputs, any stride that check_outputs accepts
};

/// Derivatives of single samples, in any order.
///
///     S^(a,b) = d^(a+b) S / du^a dv^b
///
/// Of polynomials by repeated synthetic division in x = 2u-1, then in y; zero where an order is
/// above the degree. Of rational patches S = H / w by the quotient rule of any order,
///     S^(a,b) = (H^(a,b) - sum_(i,j)>(0,0) C(a,i) C(b,j) w^(i,j) S^(a-i,b-j)) / w,
/// with all of it divided by a! b! first, so that no binomial factor is left.
/// Source: L. Piegl and W. Tiller, The NURBS Book, 2nd edition, algorithms A3.6 (by other means)
/// and A4.4.
///
/// Shapes      component c of sample k of a derivative is its c-th pointer [k * stride], as in
///             Outputs; Options::first_component chooses components. Sets may mix shapes.
/// Domain      u, v in [0,1]; other finite values extrapolate. Where one is nan or infinite, every
///             derivative of that sample is nan, orders above the degree included.
/// Null        no derivative, or one without pointers, is null_output; samples' arrays may be null
///             where count is 0.
/// Aliasing    outputs overlap neither each other, nor the inputs, nor `derivatives` itself; two
///             may be members of one vertex. Every pair of derivatives is compared once. Stores
///             are plain ones: Options::destination has no effect.
/// Edges       derivatives along an edge, (0,b) where u is 0 or 1 and (a,0) where v is, come from
///             that edge's control points alone, and have equal bits on both sides up to the sign
///             that the edge's orientation gives them; but in the middle of an edge of degree 6 or
///             more, where two halves meet, they agree within the bounds only. All other
///             derivatives come from the patch.
/// Bits        (0,0), (1,0), (0,1), (2,0), (1,1), (0,2) have the bits of evaluate_scattered and
///             evaluate_grid, except (2,0) and (0,2) of rational patches, which are equal within
///             the bounds only, and results outside of the normal range. They do not depend on
///             which other derivatives are asked for.
/// Accuracy    up to the second order as in evaluate.hpp. Of random polynomials of degrees m x n
///             errors of any order stay below ((m + n) / 2 + 4) u times the largest control value
///             of the (a,b) hodograph; measured, not proved. Quotients lose in every order what
///             their weights' derivatives amplify. What T cannot hold is infinite or nan.
/// Threads     blocks of samples.
/// Cost        polynomial: A n (m + B) multiply-adds a component, A and B the highest orders asked
///             for plus one; rational: 1/4 A^2 B^2 more. Samples of one patch are computed together
///             where they follow each other within some hundreds.
/// Returns     ok | null_input | null_output | bad_degree (an order below 0 or above
///             kMostDerivativeOrder) | bad_components | bad_stride | overlapping_outputs |
///             bad_patch_index | unknown_isa | unsupported_isa | size_overflow | out_of_memory. On
///             an error nothing has been written.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_derivatives(
    const PatchSet<T>& set, const Samples<T>& samples,
    std::span<const PartialDerivative<T>> derivatives, const Options& options = {}) noexcept;

/// The same on one grid of every patch: sample (patch - first_patch) * nu * nv + iv * nu + iu, as
/// evaluate_grid has them, and with the bits of scattered samples at the same centred parameters.
/// Returns what the call for scattered samples does but for null_input and bad_patch_index, and
/// bad_grid | bad_patch_range.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_derivatives(
    const PatchSet<T>& set, const Grid<T>& grid, std::span<const PartialDerivative<T>> derivatives,
    const Options& options = {}) noexcept;

} // namespace simdbezier
