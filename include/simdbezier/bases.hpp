// Other bases, to and from Bézier control points: power, Hermite, Catmull-Rom, uniform B-spline.
//
// A net changes basis by P' = A P B^T, one matrix a direction. The matrices are exact (integers
// over one denominator a row). Nets of float are carried in double and rounded once at the end;
// nets of double are rounded after every sum. The result is exact if these sums are: for integer
// control points of moderate size, and no denominator or one that divides the sum.
//
// The constraints of nets.hpp hold here as well: outputs, faults, bits, zeros, threads, statuses.
#pragma once

#include <type_traits>

#include <simdbezier/nets.hpp>

namespace simdbezier {

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
[[nodiscard]] SIMDBEZIER_API NetReport to_bezier(Basis basis, const ControlNets<T>& nets,
                                                 const std::type_identity_t<MutableNets<T>>& out,
                                                 const Options& options = {}) noexcept;

/// The inverse: computes the values in another basis of surfaces given by Bézier control points.
/// Weights: power bases take homogeneous nets, all others none.
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport from_bezier(Basis basis, const ControlNets<T>& nets,
                                                   const std::type_identity_t<MutableNets<T>>& out,
                                                   const Options& options = {}) noexcept;

} // namespace simdbezier
