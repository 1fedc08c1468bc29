// Two registers as one value: a row's next lanes along with its first ones.
//
// Rows of 17 to 32 columns, swept a register at a time, would come to each of their cache lines
// twice, and the first-level cache may have passed it on in between.
#pragma once

#include "kernels/simd/interleave.hpp"
#include "kernels/simd/lanes.hpp"
#include "kernels/simd/operands.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename V>
struct RegisterPair {
  V low;
  V high;

  RegisterPair() = default;
  SIMDBEZIER_INLINE RegisterPair(V first, V second) : low(first), high(second) {}
  /// Has the value in all lanes.
  explicit SIMDBEZIER_INLINE RegisterPair(ScalarOf<V> value)
      : low(broadcast<V>(value)), high(low) {}

  static SIMDBEZIER_INLINE RegisterPair load_unaligned(const ScalarOf<V>* from) {
    return {load_vector<V>(from), load_vector<V>(from + kLanes<V>)};
  }
  SIMDBEZIER_INLINE void store_unaligned(ScalarOf<V>* to) const {
    store_vector(to, low);
    store_vector(to + kLanes<V>, high);
  }
};

template <typename V>
struct TwiceMask {
  MaskOf<V> low;
  MaskOf<V> high;
};

template <typename V>
struct Traits<RegisterPair<V>> {
  using Scalar = ScalarOf<V>;
  using Mask = TwiceMask<V>;
  static constexpr std::size_t kLanes = 2 * Traits<V>::kLanes;
};

/// Whether a register or two are a line.
template <typename V>
constexpr bool kMakesLines = kLineWide<V> || kLineWide<RegisterPair<V>>;

/// Stores the first n lanes, more than those of one register.
template <typename V>
SIMDBEZIER_INLINE void masked_store(ScalarOf<V>* to, RegisterPair<V> value, std::size_t n) {
  store_vector(to, value.low);
  masked_store(to + kLanes<V>, value.high, n - kLanes<V>);
}

/// Streams one half right after the other: they are a line, or two of them.
template <typename V>
SIMDBEZIER_INLINE void store_streaming(ScalarOf<V>* to, RegisterPair<V> value) {
  using Part = LinePart<ScalarOf<V>>;
  store_any<true>(to, __builtin_bit_cast(Part, value.low));
  store_any<true>(to + kLanes<V>, __builtin_bit_cast(Part, value.high));
}

template <typename V>
SIMDBEZIER_INLINE TwiceMask<V> operator==(RegisterPair<V> a, RegisterPair<V> b) {
  return {a.low == b.low, a.high == b.high};
}

template <typename V>
SIMDBEZIER_INLINE RegisterPair<V> operator+(RegisterPair<V> a, RegisterPair<V> b) {
  return {a.low + b.low, a.high + b.high};
}

template <typename V>
SIMDBEZIER_INLINE RegisterPair<V> operator-(RegisterPair<V> a, RegisterPair<V> b) {
  return {a.low - b.low, a.high - b.high};
}
template <typename V>
SIMDBEZIER_INLINE RegisterPair<V> operator*(RegisterPair<V> a, RegisterPair<V> b) {
  return {a.low * b.low, a.high * b.high};
}

template <typename V>
SIMDBEZIER_INLINE RegisterPair<V> vector_fma(RegisterPair<V> a, RegisterPair<V> b,
                                             RegisterPair<V> c) {
  return {madd(a.low, b.low, c.low), madd(a.high, b.high, c.high)};
}

#if defined(SIMDBEZIER_KERNELS_SSE2)
template <typename V>
SIMDBEZIER_INLINE unsigned lane_bits(TwiceMask<V> mask) {
  return lane_bits(mask.low) | lane_bits(mask.high) << kLanes<V>;
}
template <std::size_t kLane, typename V>
SIMDBEZIER_INLINE RegisterPair<V> with_lane(RegisterPair<V> v, const ScalarOf<V>* value) {
  if constexpr (kLane < kLanes<V>) {
    return {with_lane<kLane>(v.low, value), v.high};
  } else {
    return {v.low, with_lane<kLane - kLanes<V>>(v.high, value)};
  }
}
#endif

template <typename V>
class PairSelector<RegisterPair<V>> {
public:
  SIMDBEZIER_INLINE PairSelector(TwiceMask<V> first, TwiceMask<V> second)
      : low_(first.low, second.low), high_(first.high, second.high) {}
  SIMDBEZIER_INLINE bool worthwhile() const { return low_.worthwhile() || high_.worthwhile(); }
  SIMDBEZIER_INLINE RegisterPair<V> replace(RegisterPair<V> inside, const ScalarOf<V>* pair) const {
    return {low_.replace(inside.low, pair), high_.replace(inside.high, pair)};
  }

private:
  PairSelector<V> low_;
  PairSelector<V> high_;
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
