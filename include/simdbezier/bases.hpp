// Other bases of the same surfaces: power, Hermite, Catmull-Rom and uniform B-spline, to and from
// Bézier control points.
//
// A direction's values c_0 … c_n in another basis and its control points b_0 … b_n are linear
// images of each other, so a net changes basis by P' = A P B^T, one matrix a direction. The
// matrices are exact (integers over one denominator a row). Nets of float are carried in double and
// rounded once at the end; nets of double are rounded after every sum. The result is exact wherever
// these sums are: for integer control points of moderate size, if a direction has no denominator or
// the denominator divides the sum.
//
// What nets.hpp says about outputs, faults, bits, zeros, threads and statuses holds here as well.
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

/// Bézier control points of surfaces given in another basis.
///
/// Degrees:  those of `out` and of the input are equal; Hermite, Catmull-Rom and B-spline are 3 x 3
///           (else bad_degree).
/// Weights:  power bases take homogeneous nets (a numerator and a denominator polynomial, of any
///           sign), B-splines take both forms (NURBS pieces), all others none; else bad_weight.
/// Edges:    neighbouring pieces of one B-spline or Catmull-Rom net get bit-equal control points
///           along their common edge.
/// Errors:   those of the sums, but relative to the largest value of either basis: powers of u
///           amplify rounding errors by up to 3^degree a direction (a round trip of a 15 x 15 patch
///           keeps no digit in float), centred powers by about 2^(degree/2), the others by small
///           constants.
/// Source:   Farin, chapters 5, 7 and 8; J. D. Foley et al., Computer Graphics, 2nd ed., 11.2.
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport to_bezier(Basis basis, const ControlNets<T>& nets,
                                                 const std::type_identity_t<MutableNets<T>>& out,
                                                 const Options& options = {}) noexcept;

/// The inverse: the values in another basis, of surfaces given by Bézier control points.
/// Weights:  power bases take homogeneous nets, all others none.
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport from_bezier(Basis basis, const ControlNets<T>& nets,
                                                   const std::type_identity_t<MutableNets<T>>& out,
                                                   const Options& options = {}) noexcept;

} // namespace simdbezier
