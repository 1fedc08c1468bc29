// Tangents and curvatures where C' is small: a second look in double, and limits at cusps.
#pragma once

#include "kernels/curve/table.hpp"

namespace simdbezier::detail {

/// Looks at one sample again, from the control points.
///
/// Derivatives are formed in double by de Casteljau's algorithm on repeated differences, relative
/// to the control point at the nearer end, so that repeated points there give zeros. With r the
/// order of the first one that is more than rounding noise and h the side of the curve's middle,
///     C'(t + h) = h^(r-1) C^(r)(t) / (r-1)! + …
/// so the tangent's limit has the direction of h^(r-1) C^(r). With s the first order whose
/// derivative is not parallel to it, the curvature behaves as |h|^(s-2r): infinite, zero, or
///     |C^(r) x C^(s)| (s-r) (r-1)!^2 / ((s-1)! |C^(r)|^3) where s = 2r.
/// r = 1 gives the plain formulas (s = 2), and is SampleStatus::regular. Where all derivatives
/// vanish, both are zero: SampleStatus::degenerate. Where x is nan, so are both: non_finite.
template <typename T>
void resolve_tangent(const TangentQuery<T>& query, TangentAnswer<T>& answer);

} // namespace simdbezier::detail
