// Puts planes into packed records of three, six or nine members, and these to memory.
//
// form_records() makes a register of each plane as many registers of records, in the order of
// memory. Processors have one or two places for shuffles, so their number counts.
#pragma once

#include <utility>

#include "kernels/simd/structures_across.hpp"
#if defined(SIMDBEZIER_KERNELS_AVX512)
#include "kernels/simd/registers_to_records_512.hpp"
#elif defined(SIMDBEZIER_KERNELS_AVX2)
#include "kernels/simd/registers_to_records_256.hpp"
#endif

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if !defined(SIMDBEZIER_KERNELS_AVX512) && !defined(SIMDBEZIER_KERNELS_AVX2)
/// Element e of x y z x y z … comes from plane e % 3 at e / 3. These are the indices of the two
/// shuffles that make it.
SIMDBEZIER_INLINE constexpr int from_xy(std::size_t e, std::size_t lanes) {
  return static_cast<int>(e % 3 == 2 ? 0 : e / 3 + (e % 3) * lanes);
}
SIMDBEZIER_INLINE constexpr int with_z(std::size_t lane, std::size_t e, std::size_t lanes) {
  return static_cast<int>(e % 3 == 2 ? e / 3 + lanes : lane);
}

template <typename T, std::size_t kOut, std::size_t... kLane>
SIMDBEZIER_INLINE LinePart<T> triple_part(LinePart<T> x, LinePart<T> y, LinePart<T> z,
                                          std::index_sequence<kLane...>) {
  constexpr std::size_t kN = kPartLanes<T>;
  const LinePart<T> xy = __builtin_shufflevector(x, y, from_xy(kOut * kN + kLane, kN)...);
  return __builtin_shufflevector(xy, z, with_z(kLane, kOut * kN + kLane, kN)...);
}

/// Puts a part of each plane into packed records.
template <typename T>
SIMDBEZIER_INLINE void form_records(const LinePart<T> (&p)[3], LinePart<T> (&line)[3]) {
  constexpr auto kLanes = std::make_index_sequence<kPartLanes<T>>{};
  line[0] = triple_part<T, 0>(p[0], p[1], p[2], kLanes);
  line[1] = triple_part<T, 1>(p[0], p[1], p[2], kLanes);
  line[2] = triple_part<T, 2>(p[0], p[1], p[2], kLanes);
}

/// Puts six planes into records: in pairs of members where parts have 128 bits, and by way of
/// memory elsewhere.
template <typename T>
SIMDBEZIER_INLINE void form_records(const LinePart<T> (&p)[6], LinePart<T> (&line)[6]) {
  if constexpr (kPartBytes != 16) {
    T values[6 * kPartLanes<T>];
    for (std::size_t e = 0; e < 6 * kPartLanes<T>; ++e) {
      values[e] = p[e % 6][e / 6];
    }
    __builtin_memcpy(&line, values, sizeof(values));
  } else if constexpr (kGroupLanes<T> == 4) {
    const auto put = [&line](std::size_t first, Part128<T> a, Part128<T> b, Part128<T> c) {
      line[first] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
      line[first + 1] = __builtin_shufflevector(c, a, 0, 1, 6, 7);
      line[first + 2] = __builtin_shufflevector(b, c, 2, 3, 6, 7);
    };
    put(0, __builtin_shufflevector(p[0], p[1], 0, 4, 1, 5), // samples 0 and 1
        __builtin_shufflevector(p[2], p[3], 0, 4, 1, 5),
        __builtin_shufflevector(p[4], p[5], 0, 4, 1, 5));
    put(3, __builtin_shufflevector(p[0], p[1], 2, 6, 3, 7), // samples 2 and 3
        __builtin_shufflevector(p[2], p[3], 2, 6, 3, 7),
        __builtin_shufflevector(p[4], p[5], 2, 6, 3, 7));
  } else {
    for (std::size_t m = 0; m < 3; ++m) {
      line[m] = __builtin_shufflevector(p[2 * m], p[2 * m + 1], 0, 2);
      line[m + 3] = __builtin_shufflevector(p[2 * m], p[2 * m + 1], 1, 3);
    }
  }
}
#endif

/// Whether nine members are put together in lines, and whether in registers at all.
inline constexpr bool kNonupleLines = kPartBytes == 64;
inline constexpr bool kNonuples = kPartBytes >= 32;

template <bool kStreaming, typename T, std::size_t kMembers, std::size_t... k>
SIMDBEZIER_INLINE void store_lines(const LinePart<T> (&line)[kMembers], T* to,
                                   std::index_sequence<k...>) {
  (store_any<kStreaming>(to + k * kPartLanes<T>, line[k]), ...);
}

/// Stores nine members, of which eight are turned around in pieces of 128 bits.
template <typename T, std::size_t... k>
SIMDBEZIER_INLINE void store_pieces(const LinePart<T> (&p)[9], T* to, std::index_sequence<k...>) {
  using V = vec<T>;
  const V value[8] = {__builtin_bit_cast(V, p[0]), __builtin_bit_cast(V, p[1]),
                      __builtin_bit_cast(V, p[2]), __builtin_bit_cast(V, p[3]),
                      __builtin_bit_cast(V, p[4]), __builtin_bit_cast(V, p[5]),
                      __builtin_bit_cast(V, p[6]), __builtin_bit_cast(V, p[7])};
  for (std::size_t m = 0; m < 8; m += kQuad<V>) {
    store_across(value + m, to + m, 9);
  }
  ((to[9 * k + 8] = p[8][k]), ...);
}

/// Puts a part of each plane into packed records at `to`. Where they are streamed, they are whole
/// lines, and `to` is at a line's start.
template <bool kStreaming, typename T, std::size_t kMembers>
SIMDBEZIER_INLINE void store_records(const LinePart<T> (&p)[kMembers], T* to) {
  if constexpr (kMembers == 9 && !kNonupleLines) {
    store_pieces<T>(p, to, std::make_index_sequence<kPartLanes<T>>{});
  } else {
    LinePart<T> line[kMembers];
    form_records<T>(p, line);
    store_lines<kStreaming>(line, to, std::make_index_sequence<kMembers>{});
  }
}

/// This is store_records() where a register may be a line: streaming or not is known late.
template <typename T, std::size_t kMembers>
SIMDBEZIER_INLINE void store_records(const LinePart<T> (&p)[kMembers], T* to, bool streaming) {
  if constexpr (kPartBytes < 64) {
    store_records<false>(p, to);
  } else {
    constexpr auto kAll = std::make_index_sequence<kMembers>{};
    LinePart<T> line[kMembers];
    form_records<T>(p, line);
    if (streaming) [[unlikely]] {
      store_lines<true>(line, to, kAll);
    } else {
      store_lines<false>(line, to, kAll);
    }
  }
}

/// Stores a register of samples as triples that begin at `to`. Where they are streamed, `to` is at
/// a line's start.
template <typename V>
SIMDBEZIER_INLINE void store_triples(const V value[3], ScalarOf<V>* to, bool streaming) {
  using T = ScalarOf<V>;
#if defined(SIMDBEZIER_KERNELS_AVX512) || defined(SIMDBEZIER_KERNELS_AVX2)
  LinePart<T> part[3];
  __builtin_memcpy(&part, value, sizeof(part));
  store_records(part, to, streaming);
#else
  (void)streaming; // a register is less than a line
  alignas(64) T plane[3][kLanes<V>];
  for (std::size_t c = 0; c < 3; ++c) {
    store_vector(plane[c], value[c]);
  }
  constexpr std::size_t kN = kPartLanes<T>;
  for (std::size_t k = 0; k < kLanes<V>; k += kN, to += 3 * kN) {
    const LinePart<T> part[3] = {load_any<LinePart<T>>(plane[0] + k),
                                 load_any<LinePart<T>>(plane[1] + k),
                                 load_any<LinePart<T>>(plane[2] + k)};
    store_records<false>(part, to);
  }
#endif
}

// From memory ------------------------------------------------------------------------------------

/// Puts kDrainStep samples of kMembers planes into packed records.
template <bool kStreaming, std::size_t kMembers, typename T>
SIMDBEZIER_INLINE void interleave(const T* const plane[kMembers], std::size_t at, T* to) {
  constexpr std::size_t kN = kPartLanes<T>;
  for (std::size_t k = 0; k < 64 / sizeof(T); k += kN, to += kMembers * kN) {
    LinePart<T> p[kMembers];
    for (std::size_t m = 0; m < kMembers; ++m) {
      p[m] = load_any<LinePart<T>>(plane[m] + at + k);
    }
    store_records<kStreaming>(p, to);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
