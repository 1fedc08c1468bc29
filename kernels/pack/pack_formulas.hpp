// What packing computes, for one component of as many patches as a register has doubles.
//
// All sums are folded: even coefficients are symmetric, odd ones antisymmetric under reversal of
// the control points, operation by operation. With x_i = -x_{N-i} that makes both sides of a
// shared edge round alike, however it is oriented. Nothing is fused, so that the bits are the same
// on every instruction set.
#pragma once

#include <limits>

#include "kernels/pack/double_double.hpp"
#include "kernels/simd/extrema.hpp"
#include "src/storage/bicubic_layout.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Finds the half-centred power coefficients of a cubic: c[k] multiplies X^k, X = u - 1/2. W is
/// what they are carried in; control values may be single doubles.
template <typename W, typename In>
SIMDBEZIER_INLINE void centred_cubic(In b0, In b1, In b2, In b3, W c[detail::kOrder]) {
  const W inner = difference_of<W>(b2, b1);
  const W outer = difference_of<W>(b3, b0);
  c[0] = scaled(sum_of<W>(sum_of<W>(b0, b3), tripled(sum_of<W>(b1, b2))), 0.125);
  c[1] = tripled(sum_of<W>(outer, inner), 0.25);
  c[2] = tripled(sum_of<W>(difference_of<W>(b0, b1), difference_of<W>(b3, b2)), 0.5);
  c[3] = difference_of<W>(outer, tripled(inner));
}

/// The coefficients of one component.
template <typename W>
struct PackedComponent {
  W matrix[detail::kOrder * detail::kOrder]; ///< [k][l]
  W edges[detail::kOrder * detail::kEdges];  ///< [power][edge]
};

/// Forms one component. net is [j][i].
template <typename W, typename In>
SIMDBEZIER_INLINE void form_component(const In net[16], PackedComponent<W>& out) {
  constexpr std::size_t n = detail::kOrder;
  W rows[n][n]; // [j][k]: row j as a polynomial in X
  for (std::size_t j = 0; j < n; ++j) {
    centred_cubic<W>(net[n * j], net[n * j + 1], net[n * j + 2], net[n * j + 3], rows[j]);
  }
  W sides[2][n];
  centred_cubic<W>(net[0], net[4], net[8], net[12], sides[0]);
  centred_cubic<W>(net[3], net[7], net[11], net[15], sides[1]);
  for (std::size_t k = 0; k < n; ++k) {
    W* const edges = out.edges + k * detail::kEdges;
    edges[detail::kEdgeV0] = rows[0][k];
    edges[detail::kEdgeV1] = rows[3][k];
    edges[detail::kEdgeU0] = sides[0][k];
    edges[detail::kEdgeU1] = sides[1][k];
    centred_cubic<W>(rows[0][k], rows[1][k], rows[2][k], rows[3][k], out.matrix + n * k);
  }
}

SIMDBEZIER_INLINE Wide less(Wide constant, Wide origin) { return constant - origin; }
SIMDBEZIER_INLINE DoubleDouble less(DoubleDouble constant, Wide origin) {
  return difference_of<DoubleDouble>(constant, DoubleDouble{origin, Wide(0.0)});
}

/// Splits the rounded constant term off, so that it can be added last.
template <typename T, typename W>
SIMDBEZIER_INLINE Wide take_origin(W& constant) {
  const Wide origin = rounded_to<T>(to_wide(constant));
  constant = less(constant, origin);
  return origin;
}

/// What packing in W may add to values, as a share of a sum of terms: the roundings of a sum, and
/// `terms` as often as they count. It is not relative to hodographs: a large column that is
/// constant in v leaves its roundings in dv. The factor is such that what passes the quick test is
/// turned by 2^-7 at the most for it (2^-24 where W is pairs), by a bound that is far above what
/// occurs.
template <typename W>
SIMDBEZIER_INLINE Wide packing_doubt(int degrees, double terms) {
  constexpr bool kInPairs = sizeof(W) != sizeof(Wide);
  return Wide((kInPairs ? 0x1p-80 : 0x1p-46) * (2 * degrees + 4) * terms);
}

/// The largest differences of neighbours and one of the control points, in the max norm, by which
/// the plain cross product of a polynomial patch is judged.
struct DifferenceSizes {
  Wide u = Wide(0.0);
  Wide v = Wide(0.0);
  Wide point = Wide(0.0);
};

/// packing_doubt() times the largest control value of a patch with one cell: none is larger than
/// one of them and all differences on the way to it. Bicubic patches have the same doubt, whichever
/// kernel packs them.
template <typename W>
SIMDBEZIER_INLINE Wide packing_doubt_of(const DifferenceSizes& size, int degree_u, int degree_v) {
  const int degrees = degree_u + degree_v;
  const Wide most = size.point + (Wide(static_cast<double>(degree_u)) * size.u +
                                  Wide(static_cast<double>(degree_v)) * size.v);
  return packing_doubt<W>(degrees, static_cast<double>(1U << degrees)) * most;
}

/// Returns the value of |du x dv|^2 above which the plain cross product is good (2^-14 for float,
/// 2^-40 for double, of what the hodographs allow), from what |du| and |dv| stay below, or above
/// which errors of values by packing, at most `packed`, count as little.
///
/// It is infinity where the squares could leave the range of T. Powers of two are kept as such: 2^e
/// is x without its mantissa, and all products that pass the comparisons are exact.
template <typename T>
SIMDBEZIER_INLINE Wide normal_floor(Wide m, Wide n, const DifferenceSizes& size, Wide packed) {
  constexpr bool kSingle = sizeof(T) == sizeof(float);
  // Each factor and the product must leave room for squares above and below.
  const Wide lowest(kSingle ? 0x1p-40 : 0x1p-450);
  const Wide highest(kSingle ? 0x1p50 : 0x1p480);
  const Wide u = power_of_two_below(m * size.u);
  const Wide v = power_of_two_below(n * size.v);
  const Wide uv = u * v;
  const MaskOf<Wide> in_range = (u >= lowest * lowest) & (u <= highest * highest) &
                                (v >= lowest * lowest) & (v <= highest * highest) & (uv >= lowest) &
                                (uv <= highest);
  // Above it |du x dv| > 2^-7 (double: 2^-20) of uv, and so > 2^-9 (2^-22) of the product of what
  // |du| and |dv| stay below: errors, a few roundings of that product, turn the normal by little.
  const Wide floor = uv * uv * Wide(kSingle ? 0x1p-14 : 0x1p-40);
  // Derivatives err by 2 m and 2 n as much as values, and so |du x dv| by this.
  const Wide lost = (packed + packed) * ((m * n) * (size.u + size.v));
  return select_where<Wide>(in_range, larger_of<Wide>(lost * lost, floor),
                            Wide(std::numeric_limits<double>::infinity()));
}

/// Finds the normal floor of bicubic patches, packed in W.
template <typename T, typename W>
class NormalFloor {
public:
  /// Adds one component of the control points as they are stored, [j][i].
  SIMDBEZIER_INLINE void add(const Wide points[16]) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) {
        size_.u = larger_of<Wide>(magnitude(points[4 * j + i + 1] - points[4 * j + i]), size_.u);
        size_.v = larger_of<Wide>(magnitude(points[4 * i + 4 + j] - points[4 * i + j]), size_.v);
      }
    }
    size_.point = larger_of<Wide>(magnitude(points[0]), size_.point);
  }
  SIMDBEZIER_INLINE Wide value() const {
    return normal_floor<T>(Wide(3.0), Wide(3.0), size_, packing_doubt_of<W>(size_, 3, 3));
  }

private:
  DifferenceSizes size_;
};

/// Returns what a floor of rational patches or curves is made of. It is infinity, which nothing
/// passes, where sizes or weights are such that products of the test could leave the range of T.
template <typename T>
SIMDBEZIER_INLINE Wide error_size(Wide size, Wide heaviest) {
  constexpr bool kSingle = sizeof(T) == sizeof(float);
  const MaskOf<Wide> in_range = (size >= Wide(kSingle ? 0x1p-100 : 0x1p-900)) &
                                (size <= Wide(kSingle ? 0x1p120 : 0x1p1000)) &
                                (heaviest >= Wide(kSingle ? 0x1p-40 : 0x1p-400)) &
                                (heaviest <= Wide(kSingle ? 0x1p40 : 0x1p400));
  return select_where<Wide>(in_range, size, Wide(std::numeric_limits<double>::infinity()));
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
