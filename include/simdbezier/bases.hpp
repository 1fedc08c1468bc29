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
  b_spline     ///< four points of a uniform cubic B-spline; one piece of it. Cubic. To: sixths
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

/// The control points of a uniform bicubic B-spline surface: rows x columns of them, columns in u.
/// Component c of point (row, column) is points[row * row_stride + column * point_stride +
/// c * component_stride]; a weight stands behind the components.
template <typename S>
struct SplineMesh {
  const S* points = nullptr;
  std::size_t rows = 0;    ///< open: 4 or more; periodic: 3 or more
  std::size_t columns = 0; ///< likewise
  std::ptrdiff_t row_stride = 0;
  std::ptrdiff_t point_stride = 3;
  std::ptrdiff_t component_stride = 1;
  int components = 3;
  Weights weights = Weights::none;
  bool periodic_u = false; ///< column `columns` is column 0 again
  bool periodic_v = false;

  /// Pieces in each direction: three fewer than control points where open.
  [[nodiscard]] constexpr std::size_t patches_u() const noexcept {
    return periodic_u ? columns : columns < 3 ? 0 : columns - 3;
  }
  [[nodiscard]] constexpr std::size_t patches_v() const noexcept {
    return periodic_v ? rows : rows < 3 ? 0 : rows - 3;
  }
};

/// The Bézier patches of a whole B-spline mesh: patch iv * patches_u() + iu has the control points
/// of rows iv to iv + 3 and columns iu to iu + 3 (modulo rows and columns where periodic).
/// Neighbours, those across a periodic seam included, share bit-equal edges.
///
/// out:        patches_u() * patches_v() bicubic nets of the mesh's components and weights.
/// Allocation: a periodic mesh is copied once, with three more rows or columns.
/// Returns:    as in nets.hpp; bad_grid where rows or columns are too few. A fault's patch and
///             point are those of the first patch that the value is part of.
template <typename T>
[[nodiscard]] SIMDBEZIER_API NetReport
spline_to_bezier(const SplineMesh<T>& mesh, const std::type_identity_t<MutableNets<T>>& out,
                 const Options& options = {}) noexcept;

} // namespace simdbezier
