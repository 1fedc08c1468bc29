// Puts planes into packed records of three, six or nine members, and these to memory.
//
// form_records() makes a register of each plane as many registers of records, in the order of
// memory. Processors have one or two places for shuffles, so their number counts.
#pragma once

#include <utility>

#include "kernels/simd/structures_across.hpp"
#if defined(SIMDBEZIER_KERNELS_AVX2)
#include "kernels/simd/registers_to_records_256.hpp"
#endif

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if !defined(SIMDBEZIER_KERNELS_AVX2)
// Shuffles of two registers across all lanes: 6, 18 and 38 of them where registers have 512 bits.
// Members are joined in units (one member, pairs, fours), whose registers hold whole runs of
// samples; the lines are then merged from those units of which they have a part.

/// Values that are joined first.
template <std::size_t kMembers>
inline constexpr std::size_t kUnit = kMembers == 9   ? 4
                                     : kMembers == 6 ? 2
                                                     : 1;

/// Says where the values of lines are among the sources: there are kUnit registers for each unit of
/// members, one for a member that is left over.
template <std::size_t kMembers, std::size_t kN>
struct RecordLines {
  static constexpr std::size_t kU = kUnit<kMembers>;

  /// Returns the lane of `source` that lane `lane` of a line comes from, kN where it comes from
  /// another.
  static constexpr std::size_t place(std::size_t line, std::size_t source, std::size_t lane) {
    const std::size_t e = line * kN + lane;
    const std::size_t record = e / kMembers;
    const std::size_t member = e % kMembers;
    if (source >= kMembers / kU * kU) {
      return member == source ? record : kN;
    }
    const std::size_t run = kN / kU; // samples
    const bool here = member / kU == source / kU && record / run == source % kU;
    return here ? record % run * kU + member % kU : kN;
  }
  static constexpr bool has(std::size_t line, std::size_t source) {
    for (std::size_t lane = 0; lane < kN; ++lane) {
      if (place(line, source, lane) < kN) {
        return true;
      }
    }
    return false;
  }
  /// Returns how many sources before this one the line has values of.
  static constexpr std::size_t before(std::size_t line, std::size_t source) {
    std::size_t count = 0;
    for (std::size_t s = 0; s < source; ++s) {
      count += has(line, s) ? 1 : 0;
    }
    return count;
  }
  static constexpr std::size_t first(std::size_t line) {
    std::size_t source = 0;
    while (!has(line, source)) {
      ++source;
    }
    return source;
  }
  /// Returns the index of the shuffle that adds `source` to a line. With the second source, values
  /// of the first take their places, too.
  static constexpr int index(std::size_t line, std::size_t source, std::size_t lane) {
    const std::size_t own = place(line, source, lane);
    if (own < kN) {
      return static_cast<int>(kN + own);
    }
    const std::size_t other =
        before(line, source) == 1 ? place(line, first(line), lane) : std::size_t{kN};
    return static_cast<int>(other < kN ? other : lane);
  }
};

template <std::size_t kMembers, std::size_t kLine, std::size_t kSource, typename Part,
          std::size_t... kLane>
SIMDBEZIER_INLINE void add_source(Part& line, Part source, std::index_sequence<kLane...>) {
  using Lines = RecordLines<kMembers, sizeof...(kLane)>;
  if constexpr (Lines::has(kLine, kSource)) {
    if constexpr (Lines::before(kLine, kSource) == 0) {
      line = source;
    } else {
      line = __builtin_shufflevector(line, source, Lines::index(kLine, kSource, kLane)...);
    }
  }
}

template <std::size_t kLine, typename T, std::size_t kMembers, std::size_t... kSource>
SIMDBEZIER_INLINE LinePart<T> merge_line(const LinePart<T> (&source)[kMembers],
                                         std::index_sequence<kSource...>) {
  constexpr auto kLanes = std::make_index_sequence<kPartLanes<T>>{};
  LinePart<T> line;
  (add_source<kMembers, kLine, kSource>(line, source[kSource], kLanes), ...);
  return line;
}

template <typename T, std::size_t kMembers, std::size_t... kLine>
SIMDBEZIER_INLINE void merge_lines(const LinePart<T> (&source)[kMembers],
                                   LinePart<T> (&line)[kMembers],
                                   std::index_sequence<kLine...> all) {
  ((line[kLine] = merge_line<kLine, T>(source, all)), ...);
}

/// Puts a part of each plane into packed records.
template <typename T, std::size_t kMembers>
SIMDBEZIER_INLINE void form_records(const LinePart<T> (&p)[kMembers],
                                    LinePart<T> (&line)[kMembers]) {
  constexpr auto kAll = std::make_index_sequence<kMembers>{};
  if constexpr (kMembers == 3 && kPartLanes<T> == 4) { // SSE2 shuffles two lanes of each at once
    const LinePart<T> xy = __builtin_shufflevector(p[0], p[1], 0, 2, 4, 6);
    const LinePart<T> yz = __builtin_shufflevector(p[1], p[2], 1, 3, 5, 7);
    const LinePart<T> zx = __builtin_shufflevector(p[2], p[0], 0, 2, 5, 7);
    line[0] = __builtin_shufflevector(xy, zx, 0, 2, 4, 6);
    line[1] = __builtin_shufflevector(yz, xy, 0, 2, 5, 7);
    line[2] = __builtin_shufflevector(zx, yz, 1, 3, 5, 7);
  } else if constexpr (kMembers == 3) {
    merge_lines<T>(p, line, kAll);
  } else if constexpr (kMembers == 6) {
    LinePart<T> source[kMembers];
    repeat<3>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
      source[2 * k] = zip<T, 1, false, kPartLanes<T>>(p[2 * k], p[2 * k + 1]);
      source[2 * k + 1] = zip<T, 1, true, kPartLanes<T>>(p[2 * k], p[2 * k + 1]);
    });
    merge_lines<T>(source, line, kAll);
  } else {
    LinePart<T> source[kMembers];
    repeat<kMembers>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { source[k] = p[k]; });
    transpose_four<T, kPartLanes<T>>(source);
    transpose_four<T, kPartLanes<T>>(source + 4);
    merge_lines<T>(source, line, kAll);
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
    store_across(value + m, to + m, std::size_t{9});
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
  static_assert(sizeof(V) == kPartBytes);
  LinePart<T> part[3];
  __builtin_memcpy(&part, value, sizeof(part));
  store_records(part, to, streaming);
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
