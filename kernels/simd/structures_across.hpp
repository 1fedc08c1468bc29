// Structures across lanes: values of consecutive structures in memory, lane p being structure p.
//
// Memory is read and written in pieces of 128 bits. Turning such pieces around takes shuffles
// inside of 128 bits only, which do not compete with multiply-adds.
#pragma once

#include "kernels/simd/interleave.hpp"
#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A register as the compilers' own vector type, whose shuffles are portable.
template <typename V>
using Bits = typename VectorOf<ScalarOf<V>, kLanes<V> * sizeof(ScalarOf<V>)>::type;

/// Values in a piece.
template <typename V>
inline constexpr std::size_t kPiece = kGroupLanes<ScalarOf<V>>;

/// In each 128 bits: the low (high) units of a and b in turn, a unit being kUnit values.
SIMDBEZIER_INLINE constexpr int zipped(std::size_t lane, std::size_t lanes, std::size_t piece,
                                       std::size_t unit, bool high) {
  const std::size_t k = lane % piece / unit;
  return static_cast<int>(lane / piece * piece + (high ? piece / 2 : 0) + k / 2 * unit +
                          lane % unit + (k % 2) * lanes);
}

template <std::size_t kUnit, bool kHigh, typename V, std::size_t... kLane>
SIMDBEZIER_INLINE Bits<V> zip(Bits<V> a, Bits<V> b, std::index_sequence<kLane...>) {
  return __builtin_shufflevector(a, b, zipped(kLane, kLanes<V>, kPiece<V>, kUnit, kHigh)...);
}

/// In each 128 bits: rows of a square matrix become its columns.
template <typename V>
SIMDBEZIER_INLINE void turn_pieces(Bits<V> m[kPiece<V>]) {
  constexpr auto kAll = std::make_index_sequence<kLanes<V>>{};
  if constexpr (kPiece<V> == 2) {
    const Bits<V> low = zip<1, false, V>(m[0], m[1], kAll);
    m[1] = zip<1, true, V>(m[0], m[1], kAll);
    m[0] = low;
  } else {
    const Bits<V> low01 = zip<1, false, V>(m[0], m[1], kAll);
    const Bits<V> high01 = zip<1, true, V>(m[0], m[1], kAll);
    const Bits<V> low23 = zip<1, false, V>(m[2], m[3], kAll);
    const Bits<V> high23 = zip<1, true, V>(m[2], m[3], kAll);
    m[0] = zip<2, false, V>(low01, low23, kAll);
    m[1] = zip<2, true, V>(low01, low23, kAll);
    m[2] = zip<2, false, V>(high01, high23, kAll);
    m[3] = zip<2, true, V>(high01, high23, kAll);
  }
}

/// 128 bits at from, from + step, …, side by side.
template <typename V>
SIMDBEZIER_INLINE Bits<V> join_pieces(const ScalarOf<V>* from, std::size_t step) {
  Bits<V> value;
#if defined(SIMDBEZIER_KERNELS_AVX512) || defined(SIMDBEZIER_KERNELS_AVX2)
  const auto piece = [&](std::size_t g)
                         SIMDBEZIER_INLINE_LAMBDA { return load_any<__m128>(from + g * step); };
#if defined(SIMDBEZIER_KERNELS_AVX512)
  __m512 bits = _mm512_castps128_ps512(piece(0));
  bits = _mm512_insertf32x4(bits, piece(1), 1);
  bits = _mm512_insertf32x4(bits, piece(2), 2);
  bits = _mm512_insertf32x4(bits, piece(3), 3);
#else
  const __m256 bits = _mm256_insertf128_ps(_mm256_castps128_ps256(piece(0)), piece(1), 1);
#endif
  __builtin_memcpy(&value, &bits, sizeof(value));
#else
  (void)step;
  __builtin_memcpy(&value, from, sizeof(value));
#endif
  return value;
}

/// The reverse.
template <typename V>
SIMDBEZIER_INLINE void part_pieces(Bits<V> value, ScalarOf<V>* to, std::size_t step) {
#if defined(SIMDBEZIER_KERNELS_AVX512)
  __m512 bits;
  __builtin_memcpy(&bits, &value, sizeof(bits));
  store_any<false>(to, _mm512_castps512_ps128(bits));
  store_any<false>(to + step, _mm512_extractf32x4_ps(bits, 1));
  store_any<false>(to + 2 * step, _mm512_extractf32x4_ps(bits, 2));
  store_any<false>(to + 3 * step, _mm512_extractf32x4_ps(bits, 3));
#elif defined(SIMDBEZIER_KERNELS_AVX2)
  __m256 bits;
  __builtin_memcpy(&bits, &value, sizeof(bits));
  store_any<false>(to, _mm256_castps256_ps128(bits));
  store_any<false>(to + step, _mm256_extractf128_ps(bits, 1));
#else
  (void)step;
  __builtin_memcpy(to, &value, sizeof(value));
#endif
}

// Arrays live in registers only where every index is a constant; loops that copy them go by way of
// memory, in halves, which cannot be forwarded to loads of whole registers.
template <typename F, std::size_t... k>
SIMDBEZIER_INLINE void for_each_index(const F& f, std::index_sequence<k...>) {
  (f(k), ...);
}

/// values[k], lane p = from[p * stride + k], for k < kPiece.
template <typename V>
SIMDBEZIER_INLINE void load_across(const ScalarOf<V>* from, std::size_t stride, V* values) {
  constexpr auto kAll = std::make_index_sequence<kPiece<V>>{};
  Bits<V> m[kPiece<V>];
  for_each_index(
      [&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
        m[r] = join_pieces<V>(from + r * stride, kPiece<V> * stride);
      },
      kAll);
  turn_pieces<V>(m);
  for_each_index([&](std::size_t k)
                     SIMDBEZIER_INLINE_LAMBDA { values[k] = __builtin_bit_cast(V, m[k]); },
                 kAll);
}

/// to[p * stride + k] = lane p of values[k], for k < kPiece.
template <typename V>
SIMDBEZIER_INLINE void store_across(const V* values, ScalarOf<V>* to, std::size_t stride) {
  constexpr auto kAll = std::make_index_sequence<kPiece<V>>{};
  Bits<V> m[kPiece<V>];
  for_each_index([&](std::size_t k)
                     SIMDBEZIER_INLINE_LAMBDA { m[k] = __builtin_bit_cast(Bits<V>, values[k]); },
                 kAll);
  turn_pieces<V>(m);
  for_each_index(
      [&](std::size_t r)
          SIMDBEZIER_INLINE_LAMBDA { part_pieces<V>(m[r], to + r * stride, kPiece<V> * stride); },
      kAll);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
