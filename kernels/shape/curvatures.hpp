// Curvatures of a register of samples, from their first and second derivatives.
#pragma once

#include "kernels/poly/sample_jets.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns 1 / x for x = power_of_two_below(…), without a division: flipping the exponent's bits
/// gives 2 / x, for 0 and infinity as well.
template <typename V>
SIMDBEZIER_PART V inverse_of_power_of_two(V x) {
  using T = ScalarOf<V>;
  if constexpr (!kIsScalar<V>) {
    return (x ^ V(static_cast<T>(__builtin_inf()))) * V(T(0.5));
  } else if constexpr (sizeof(V) == sizeof(float)) {
    return __builtin_bit_cast(float, __builtin_bit_cast(unsigned, x) ^ 0xffU << 23) * 0.5F;
  } else {
    return __builtin_bit_cast(double, __builtin_bit_cast(unsigned long long, x) ^ 0x7ffULL << 52) *
           0.5;
  }
}

/// A vector over a power of two of about its size, so that products stay in range; `inverse` is one
/// over that power. Nothing is rounded.
template <typename V>
struct ScaledTangent {
  V inverse;
  V value[3];

  explicit SIMDBEZIER_PART ScaledTangent(const V tangent[3]) {
    V size = broadcast<V>(ScalarOf<V>(0));
    for (std::size_t c = 0; c < 3; ++c) {
      const V power = power_of_two_below(tangent[c]);
      size = select_where<V>(power > size, power, size);
    }
    inverse = inverse_of_power_of_two(size);
    for (std::size_t c = 0; c < 3; ++c) {
      value[c] = tangent[c] * inverse;
    }
  }
};

/// What curvatures take from first derivatives alone. Roots and divisions end here and in
/// curvatures(), so that those of several samples are under way together.
template <typename V>
struct CurvatureFrame {
  V inverse_u; ///< of the scaled tangents
  V inverse_v;
  V n[3];
  V inverse_area2;
  V e;
  V f;
  V g;

  SIMDBEZIER_PART void find(const SampleJet<V>& jet) {
    const ScaledTangent<V> du(jet.du);
    const ScaledTangent<V> dv(jet.dv);
    inverse_u = du.inverse;
    inverse_v = dv.inverse;
    const V area2 = cross_product(du.value, dv.value, n); // EG - F^2, without its cancellation
    e = dot(du.value, du.value);
    f = dot(du.value, dv.value);
    g = dot(dv.value, dv.value);
    inverse_area2 = divide(broadcast<V>(ScalarOf<V>(1)), area2);
    normalise(n, area2);
  }
};

/// Finds the Gaussian, the mean, the smaller and the larger principal curvature; see Curvatures.
template <typename V>
SIMDBEZIER_PART void curvatures(const SampleJet<V>& jet, const CurvatureFrame<V>& at,
                                V out[detail::kCurvatures]) {
  const V l = dot(jet.duu, at.n) * at.inverse_u * at.inverse_u;
  const V m = dot(jet.duv, at.n) * at.inverse_u * at.inverse_v;
  const V k = dot(jet.dvv, at.n) * at.inverse_v * at.inverse_v;
  const V half = broadcast<V>(ScalarOf<V>(0.5));
  const V zero = broadcast<V>(ScalarOf<V>(0));
  // Adding zero makes a plane's curvatures +0 and changes nothing else.
  const V gaussian = madd(msub(l, k, m * m), at.inverse_area2, zero);
  const V twice_f_m = (at.f + at.f) * m;
  const V mean = madd(half * (madd(at.e, k, at.g * l) - twice_f_m), at.inverse_area2, zero);
  const V discriminant = msub(mean, mean, gaussian);
  // Rounding makes it negative at umbilics; nan stays nan.
  const V spread = square_root(select_where<V>(discriminant < zero, zero, discriminant));
  out[0] = gaussian;
  out[1] = mean;
  out[2] = mean - spread;
  out[3] = mean + spread;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
