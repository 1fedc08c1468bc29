// Groups of 128 bits, each of which belongs to a sample of its own.
#pragma once

#include "kernels/simd/quads.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Loads lane q from the 128 bits at at(q).
template <typename V, typename At>
SIMDBEZIER_INLINE V quads_at(const At& at) {
#if defined(SIMDBEZIER_KERNELS_AVX512) || defined(SIMDBEZIER_KERNELS_AVX2)
  const auto two = [&](std::size_t q) SIMDBEZIER_INLINE_LAMBDA {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(load_any<__m128>(at(q))),
                                load_any<__m128>(at(q + 1)), 1);
  };
#endif
#if defined(SIMDBEZIER_KERNELS_AVX512)
  return __builtin_bit_cast(
      V, _mm512_maskz_insertf32x8(0xffff, _mm512_castps256_ps512(two(0)), two(2), 1));
#elif defined(SIMDBEZIER_KERNELS_AVX2)
  return __builtin_bit_cast(V, two(0));
#else
  static_assert(kQuads<V> == 1);
  return load_vector<V>(at(0));
#endif
}

/// Spreads the values of each 128-bit lane: value k goes to all of the lane in each[k].
template <typename V>
SIMDBEZIER_INLINE void spread_quads(V v, V each[kQuad<V>]) {
  each[0] = broadcast_in_groups<kQuad<V>, 0>(v);
  each[1] = broadcast_in_groups<kQuad<V>, 1>(v);
  if constexpr (kQuad<V> == 4) {
    each[2] = broadcast_in_groups<kQuad<V>, 2>(v);
    each[3] = broadcast_in_groups<kQuad<V>, 3>(v);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
