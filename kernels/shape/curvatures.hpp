// Curvatures of a register of samples, from their first and second derivatives.
#pragma once

#include "kernels/poly/sample_jets.hpp"
#include "kernels/simd/extrema.hpp"

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

/// Returns one over a power of two of about a vector's size: scaled by it, products stay in range,
/// and nothing is rounded.
template <typename V>
SIMDBEZIER_PART V inverse_size(const V tangent[3]) {
  return inverse_of_power_of_two(
      larger_of(larger_of(power_of_two_below(tangent[0]), power_of_two_below(tangent[1])),
                power_of_two_below(tangent[2])));
}

/// What curvatures take from first derivatives alone. Roots and divisions end here and in
/// curvatures(), so that those of several samples are under way together.
template <typename V>
struct CurvatureFrame {
  V inverse_u; ///< what tangents are scaled by
  V inverse_v;
  V n[3];
  V inverse_area2;
  V e;
  V f;
  V g;

  SIMDBEZIER_PART void find(const SampleJet<V>& jet) {
    const V scale_u = inverse_size(jet.du);
    const V scale_v = inverse_size(jet.dv);
    V du[3];
    V dv[3];
    repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      du[c] = jet.du[c] * scale_u;
      dv[c] = jet.dv[c] * scale_v;
    });
    V normal[3];
    const V area2 = cross_product(du, dv, normal); // EG - F^2, without its cancellation
    normalise(normal, area2);
    inverse_area2 = divide(broadcast<V>(ScalarOf<V>(1)), area2);
    inverse_u = scale_u;
    inverse_v = scale_v;
    e = dot(du, du);
    f = dot(du, dv);
    g = dot(dv, dv);
    repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA { n[c] = normal[c]; });
  }
};

/// Finds the Gaussian, the mean, the smaller and the larger principal curvature; see Curvatures.
template <typename V>
SIMDBEZIER_PART void curvatures(const SampleJet<V>& jet, const CurvatureFrame<V>& at,
                                V out[kCurvatureKinds]) {
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
  // Rounding makes it negative at umbilics; nan, which comes second, stays nan.
  const V spread = square_root(larger_of(zero, discriminant));
  out[0] = gaussian;
  out[1] = mean;
  out[2] = mean - spread;
  out[3] = mean + spread;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
