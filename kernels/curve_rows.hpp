// Where positions of curves go: rows of n samples, in x y z triples or in three planes.
#pragma once

#include "kernels/curve_outputs.hpp"
#include "kernels/isa/interleave.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::CurveTask;

/// One stream of triples, or three of planes; curve k's row begins k * row(n) values later.
template <bool kTriples, typename T>
struct CurveRows {
  static constexpr std::size_t kStreams = kTriples ? 1 : 3;
  T* first[kStreams];

  static constexpr std::size_t row(std::size_t n) { return kTriples ? 3 * n : n; }
  SIMDBEZIER_INLINE CurveRows at(std::size_t values) const {
    CurveRows rows;
    for (std::size_t k = 0; k < kStreams; ++k) {
      rows.first[k] = first[k] + values;
    }
    return rows;
  }
};

/// A register of samples, to triples that begin at `to`. Streaming: `to` is at a line's start.
template <typename V>
SIMDBEZIER_INLINE void store_triples(const V value[3], ScalarOf<V>* to, bool streaming) {
  using T = ScalarOf<V>;
#if defined(SIMDBEZIER_KERNELS_AVX512)
  LinePart<T> part[3];
  __builtin_memcpy(&part, value, sizeof(part));
  streaming ? store_records<true>(part, to) : store_records<false>(part, to);
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

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
