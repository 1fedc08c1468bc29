// Structures across lanes: values of consecutive structures in memory, lane p being structure p.
//
// Memory is read and written in pieces of 128 bits, or in whole lines where a register is one;
// shuffles turn them.
#pragma once

#include "kernels/simd/interleave.hpp"
#include "kernels/simd/quads.hpp"
#include "kernels/simd/repeat.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Loads 128 bits at from, from + step, …, side by side. Steps may be signed or not.
template <typename V, typename Step>
SIMDBEZIER_INLINE Bits<V> join_quads(const ScalarOf<V>* from, Step step) {
  return __builtin_bit_cast(Bits<V>, quads_at<V>([&](std::size_t q) SIMDBEZIER_INLINE_LAMBDA {
                              return from + static_cast<Step>(q) * step;
                            }));
}

/// Stores what join_quads() loads.
template <typename V, typename Step>
SIMDBEZIER_INLINE void part_quads(Bits<V> value, ScalarOf<V>* to, [[maybe_unused]] Step step) {
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
  store_any<false>(to, value);
#endif
}

/// Loads the first four values of each of kStructures structures, repeated in each structure's
/// lanes.
template <std::size_t kStructures, typename V>
SIMDBEZIER_INLINE V join_fours(const ScalarOf<V>* from, [[maybe_unused]] std::size_t step) {
  if constexpr (kStructures == 1) {
    return repeat_four<V>(from);
  } else if constexpr (kStructures == kQuads<V>) {
    return __builtin_bit_cast(V, join_quads<V>(from, step));
  } else {
    static_assert(kStructures == 2);
#if defined(SIMDBEZIER_KERNELS_AVX512)
    if constexpr (sizeof(ScalarOf<V>) == sizeof(float)) {
      const __m512 first = _mm512_broadcast_f32x4(load_any<__m128>(from));
      return V(_mm512_mask_broadcast_f32x4(first, 0xff00, load_any<__m128>(from + step)));
    } else {
      return V(two_halves(from, from + step));
    }
#endif
  }
}

// Arrays live in registers only where every index is a constant; loops that copy them go by way of
// memory, in halves, which cannot be forwarded to loads of whole registers.

/// Loads values[k], lane p = from[p * stride + k], for k < kQuad.
template <typename V, typename Step>
SIMDBEZIER_INLINE void load_across(const ScalarOf<V>* from, Step stride, V* values) {
  Bits<V> m[kQuad<V>];
  repeat<kQuad<V>>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
    m[r] = join_quads<V>(from + static_cast<Step>(r) * stride, Step{kQuad<V>} * stride);
  });
  transpose_quads<ScalarOf<V>>(m);
  repeat<kQuad<V>>([&](std::size_t k)
                       SIMDBEZIER_INLINE_LAMBDA { values[k] = __builtin_bit_cast(V, m[k]); });
}

/// Stores to[p * stride + k] = lane p of values[k], for k < kQuad.
template <typename V, typename Step>
SIMDBEZIER_INLINE void store_across(const V* values, ScalarOf<V>* to, Step stride) {
  Bits<V> m[kQuad<V>];
  repeat<kQuad<V>>([&](std::size_t k)
                       SIMDBEZIER_INLINE_LAMBDA { m[k] = __builtin_bit_cast(Bits<V>, values[k]); });
  transpose_quads<ScalarOf<V>>(m);
  repeat<kQuad<V>>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
    part_quads<V>(m[r], to + static_cast<Step>(r) * stride, Step{kQuad<V>} * stride);
  });
}

// Where a register is a line, a line of each structure takes three quarters of the shuffles and
// inserts that its pieces would take, and a fourth of the loads or stores.
#if defined(SIMDBEZIER_KERNELS_AVX512)
/// Transposes the matrix of 128-bit pieces of four registers.
template <typename B>
SIMDBEZIER_INLINE void transpose_pieces(B (&m)[4]) {
  __m512 a[4];
  repeat<4>([&](std::size_t k)
                SIMDBEZIER_INLINE_LAMBDA { a[k] = __builtin_bit_cast(__m512, m[k]); });
  const __m512 low01 = _mm512_maskz_shuffle_f32x4(0xffff, a[0], a[1], 0x44);
  const __m512 high01 = _mm512_maskz_shuffle_f32x4(0xffff, a[0], a[1], 0xee);
  const __m512 low23 = _mm512_maskz_shuffle_f32x4(0xffff, a[2], a[3], 0x44);
  const __m512 high23 = _mm512_maskz_shuffle_f32x4(0xffff, a[2], a[3], 0xee);
  m[0] = __builtin_bit_cast(B, _mm512_maskz_shuffle_f32x4(0xffff, low01, low23, 0x88));
  m[1] = __builtin_bit_cast(B, _mm512_maskz_shuffle_f32x4(0xffff, low01, low23, 0xdd));
  m[2] = __builtin_bit_cast(B, _mm512_maskz_shuffle_f32x4(0xffff, high01, high23, 0x88));
  m[3] = __builtin_bit_cast(B, _mm512_maskz_shuffle_f32x4(0xffff, high01, high23, 0xdd));
}

/// Loads values[k], lane p = from[p * stride + k], for all k of a line.
template <typename V, typename Step>
SIMDBEZIER_INLINE void load_lines_across(const ScalarOf<V>* from, Step stride, V* values) {
  constexpr std::size_t kQ = kQuad<V>;
  Bits<V> m[4][kQ];
  repeat<kQ>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
    Bits<V> line[4];
    repeat<4>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
      const V whole = load_vector<V>(from + static_cast<Step>(r + k * kQ) * stride);
      line[k] = __builtin_bit_cast(Bits<V>, whole);
    });
    transpose_pieces(line);
    repeat<4>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { m[k][r] = line[k]; });
  });
  repeat<4>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    transpose_quads<ScalarOf<V>>(m[k]);
    repeat<kQ>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
      values[k * kQ + r] = __builtin_bit_cast(V, m[k][r]);
    });
  });
}

/// Stores to[p * stride + k] = lane p of values[k], for all k of a line.
template <typename V, typename Step>
SIMDBEZIER_INLINE void store_lines_across(const V* values, ScalarOf<V>* to, Step stride,
                                          bool streams = false) {
  constexpr std::size_t kQ = kQuad<V>;
  Bits<V> m[4][kQ];
  repeat<4>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    repeat<kQ>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
      m[k][r] = __builtin_bit_cast(Bits<V>, values[k * kQ + r]);
    });
    transpose_quads<ScalarOf<V>>(m[k]);
  });
  repeat<kQ>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
    Bits<V> line[4] = {m[0][r], m[1][r], m[2][r], m[3][r]};
    transpose_pieces(line);
    repeat<4>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
      ScalarOf<V>* const place = to + static_cast<Step>(r + k * kQ) * stride;
      store_line(place, __builtin_bit_cast(V, line[k]), streams);
    });
  });
}
#endif

/// Loads values[k], lane p = from[p * stride + k], for kCount k.
template <std::size_t kCount, typename V, typename Step>
SIMDBEZIER_INLINE void load_values_across(const ScalarOf<V>* from, Step stride, V* values) {
  if constexpr (kIsScalar<V>) {
    repeat<kCount>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { values[k] = from[k]; });
  } else if constexpr (kLineWide<V> && kCount % kLanes<V> == 0) {
    repeat<kCount / kLanes<V>>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
      load_lines_across(from + k * kLanes<V>, stride, values + k * kLanes<V>);
    });
  } else {
    repeat<kCount / kQuad<V>>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
      load_across(from + k * kQuad<V>, stride, values + k * kQuad<V>);
    });
  }
}
/// Stores what load_values_across() loads. streams: rows that are lines go past the caches.
template <std::size_t kCount, typename V, typename Step>
SIMDBEZIER_INLINE void store_values_across(const V* values, ScalarOf<V>* to, Step stride,
                                           [[maybe_unused]] bool streams = false) {
  if constexpr (kIsScalar<V>) {
    repeat<kCount>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { to[k] = values[k]; });
  } else if constexpr (kLineWide<V> && kCount == kLanes<V>) {
    store_lines_across(values, to, stride, streams);
  } else {
    repeat<kCount / kQuad<V>>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
      store_across(values + k * kQuad<V>, to + k * kQuad<V>, stride);
    });
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
