// The error bounds that results are judged by, in units of the unit roundoff u.
//
// Each is a certified maximum of the scheme's first-order running-error formula over all control
// nets and parameters (docs/accuracy.md), rounded up; bicubic_bounds_test.cpp maximises the
// formulas again, over all extreme nets, and compares.
#pragma once

namespace simdbezier::tests {

/// |error of P| <= K u max|b|, per component.
inline constexpr double kPositionBoundFma = 21;   // formula: 20.44
inline constexpr double kPositionBoundNoFma = 30; // formula: 29.06

/// |error of dS/du, dS/dv| <= D u max|hodograph|, per component.
inline constexpr double kDerivativeBoundFma = 18;   // formula: 17.33
inline constexpr double kDerivativeBoundNoFma = 24; // formula: 23.33

/// |error of d2S/du2, d2S/dudv, d2S/dv2| <= D2 u max|second hodograph|, per component, the second
/// hodograph being that of the hodograph: 6 (b[i+2] - 2 b[i+1] + b[i]), and 9 times the mixed
/// differences. A second derivative reads only those coefficients that are linear in it (k >= 2,
/// or k, l >= 1, or l >= 2), so it has a formula of the same kind. On an edge it is that of a net
/// which does not change across the edge.
inline constexpr double kSecondDerivativeBoundFma = 15;   // formula: 14.50
inline constexpr double kSecondDerivativeBoundNoFma = 19; // formula: 18.00

[[nodiscard]] constexpr double position_bound(bool fma) {
  return fma ? kPositionBoundFma : kPositionBoundNoFma;
}
[[nodiscard]] constexpr double derivative_bound(bool fma) {
  return fma ? kDerivativeBoundFma : kDerivativeBoundNoFma;
}
[[nodiscard]] constexpr double second_derivative_bound(bool fma) {
  return fma ? kSecondDerivativeBoundFma : kSecondDerivativeBoundNoFma;
}

/// With a local origin O the bound is u|P| + K u max|b-O|; O lies in the hull of the control
/// points, so |b-O| <= 2 max|b|.
[[nodiscard]] constexpr double position_bound_with_origin(bool fma) {
  return 2 * position_bound(fma) + 1;
}

/// The unit normal inherits the tangents' errors times its conditioning. With every component of
/// a tangent within D u H, the tangent is within sqrt(3) D u H; kappa = (Hu|dv| + Hv|du|)/|du x dv|
/// carries that to the direction. The cross product itself adds at most 3 u |du||dv| / |du x dv|
/// <= 3 sqrt(3) kappa / 2 u (|du| <= sqrt(3) Hu), and normalising 3 u.
[[nodiscard]] constexpr double normal_bound(bool fma, double kappa) {
  return (1.7321 * derivative_bound(fma) + 2.6) * kappa + 3;
}

/// Roundings of a curvature's own formula, relative to its terms as if nothing cancelled: some 20
/// operations, most of them on values of the size of the terms.
inline constexpr double kCurvatureRoundings = 24;

/// Curvatures are judged where the tangents' control values lie within this factor of 1, either
/// way: |du x dv|^2 has their fourth power, and must be neither denormal nor infinite.
template <typename T>
inline constexpr double kCurvatureRange = sizeof(T) == 4 ? 0x1p24 : 0x1p240;

/// G6: what a normal may miss its limit by, in degrees, where the cross product vanishes to first
/// order, and where it vanishes to higher order or nearly so.
inline constexpr double kLimitDegrees = 1e-3;
inline constexpr double kDegenerateDegrees = 0.02;

/// What any normal may be off by, in degrees: the quick test |du x dv| > 2^-10 passes conditioning
/// up to 2^14, whose errors of at most 2 u kappa come to 0.1 degree in float; worse samples must
/// have taken the second look.
inline constexpr double kPlainDegrees = 0.1;

/// G5: RMS error at most so many times that of the best scalar de Casteljau; more where a direction
/// of degree 4 or 5 is one expansion (nets of 1 and -1 of degree 5: 1.7), and with weights.
inline constexpr double kRmsAgainstDeCasteljau = 1.25;
inline constexpr double kRmsAgainstDeCasteljauHigh = 2;

} // namespace simdbezier::tests
