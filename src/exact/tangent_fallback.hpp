// Tangents and curvatures where C' is small: decided exactly, from the control points as given.
#pragma once

#include "src/tables/curve_table.hpp"

namespace simdbezier::detail {

/// Looks at one sample again.
///
/// With tau running from the sample to the curve's middle, C' is a positive factor times a
/// polynomial G(tau) = sum_k G_k tau^k, and G x G' = Q(tau) = sum_k Q_k tau^k. The tangent has the
/// direction of the first G_a that is not zero: SampleStatus::regular for a = 0, else limit, and
/// degenerate (a tangent of zero) where there is none. The curvature is |Q| / |G|^3 up to factors,
/// so with Q_b the first that is not zero it is infinite for b < 3a, zero for b > 3a, and
///     |Q_b| w^2 / (n |d| |G_a|^3)
/// for b = 3a: n the degree, w the weight at the sample, d its distance from the middle (1/2 in the
/// middle, where tau runs upwards). Where x is not finite, both are nan: non_finite.
template <typename T>
void resolve_tangent(const TangentQuery<T>& query, TangentAnswer<T>& answer);

} // namespace simdbezier::detail
