// Samples with their derivatives, and the quotient rule of rational patches and curves.
#pragma once

#include "kernels/poly/series.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// One value and its derivatives by the two local parameters.
template <typename V>
struct Partials {
  V value;
  V x;
  V y;
  V xx;
  V xy;
  V yy;
};

/// What a sample consists of; derivatives by u and v as far as the kernel's depth goes.
template <typename V>
struct SampleJet {
  V position[3];
  V du[3];
  V dv[3];
  V duu[3];
  V duv[3];
  V dvv[3];
  V inverse_weight; ///< of rational patches, with derivatives: 1 / w
};

/// S = h / w and its derivatives, from those of h and w: w S = h, differentiated. Those of w come
/// negated, so that every product is added.
/// Source: L. Piegl and W. Tiller, The NURBS Book, 4.2 and 4.3.
template <typename V>
struct Quotient {
  V inverse; ///< 1 / w

  static SIMDBEZIER_INLINE Quotient by(V w) { return {divide(broadcast<V>(ScalarOf<V>(1)), w)}; }
  SIMDBEZIER_INLINE V value(V h) const { return h * inverse; }
  SIMDBEZIER_INLINE V first(V h_x, V s, V minus_w_x) const {
    return madd(s, minus_w_x, h_x) * inverse;
  }
  /// s_x and s_y are first derivatives of S; they are the same one where this is not a mixed one.
  SIMDBEZIER_INLINE V second(V h_xy, V s, V s_x, V s_y, V minus_w_x, V minus_w_y,
                             V minus_w_xy) const {
    return madd(s_y, minus_w_x, madd(s_x, minus_w_y, madd(s, minus_w_xy, h_xy))) * inverse;
  }
};

/// Divides a series by the quotient rule: h and its derivatives become those of h / w. The weight's
/// are negated.
template <std::size_t kDepth, typename V>
SIMDBEZIER_INLINE void divide_series(const Quotient<V>& quotient, const Series<V>& weight,
                                     Series<V>& s) {
  s.value = quotient.value(s.value);
  if constexpr (kDepth > 0) {
    s.first = quotient.first(s.first, s.value, weight.first);
  }
  if constexpr (kDepth > 1) {
    s.second = quotient.second(s.second, s.value, s.first, s.first, weight.first, weight.first,
                               weight.second);
  }
}

/// |du x dv|^2 or |C'|^2 of rational patches and curves below this takes a second look: products on
/// the way might have left the range of T.
template <typename T>
inline constexpr T kLeastSquare = static_cast<T>(sizeof(T) == sizeof(float) ? 0x1p-94 : 0x1p-940);

template <typename V>
SIMDBEZIER_INLINE V negated(V a) {
  return broadcast<V>(ScalarOf<V>(0)) - a;
}

template <typename V>
SIMDBEZIER_INLINE V dot(const V a[3], const V b[3]) {
  return madd(a[0], b[0], madd(a[1], b[1], a[2] * b[2]));
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
