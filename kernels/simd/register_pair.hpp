// Two registers as one value: a row's next lanes along with its first ones.
//
// Rows of 17 to 32 columns, swept a register at a time, would come to each of their cache lines
// twice, and the first-level cache may have passed it on in between.
#pragma once

#include "kernels/simd/lanes.hpp"
#include "kernels/simd/operands.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename V>
struct Twice {
  V low;
  V high;

  Twice() = default;
  SIMDBEZIER_INLINE Twice(V first, V second) : low(first), high(second) {}
  /// In all lanes.
  explicit SIMDBEZIER_INLINE Twice(ScalarOf<V> value) : low(broadcast<V>(value)), high(low) {}

  static SIMDBEZIER_INLINE Twice load_unaligned(const ScalarOf<V>* from) {
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
struct Traits<Twice<V>> {
  using Scalar = ScalarOf<V>;
  using Mask = TwiceMask<V>;
  static constexpr std::size_t kLanes = 2 * Traits<V>::kLanes;
};

/// The first n lanes, more than those of one register.
template <typename V>
SIMDBEZIER_INLINE void masked_store(ScalarOf<V>* to, Twice<V> value, std::size_t n) {
  store_vector(to, value.low);
  masked_store(to + kLanes<V>, value.high, n - kLanes<V>);
}

template <typename V>
SIMDBEZIER_INLINE TwiceMask<V> operator==(Twice<V> a, Twice<V> b) {
  return {a.low == b.low, a.high == b.high};
}

template <typename V>
SIMDBEZIER_INLINE Twice<V> operator+(Twice<V> a, Twice<V> b) {
  return {a.low + b.low, a.high + b.high};
}

template <typename V>
SIMDBEZIER_INLINE Twice<V> vector_fma(Twice<V> a, Twice<V> b, Twice<V> c) {
  return {madd(a.low, b.low, c.low), madd(a.high, b.high, c.high)};
}

template <typename V>
SIMDBEZIER_INLINE Twice<V> madd_by(Twice<V> a, const ScalarOf<V>* t, Twice<V> c) {
  return {madd_by(a.low, t, c.low), madd_by(a.high, t, c.high)};
}

template <typename V>
class PairSelector<Twice<V>> {
public:
  SIMDBEZIER_INLINE PairSelector(TwiceMask<V> first, TwiceMask<V> second)
      : low_(first.low, second.low), high_(first.high, second.high) {}
  SIMDBEZIER_INLINE bool worthwhile() const { return low_.worthwhile() || high_.worthwhile(); }
  SIMDBEZIER_INLINE Twice<V> replace(Twice<V> inside, const ScalarOf<V>* pair) const {
    return {low_.replace(inside.low, pair), high_.replace(inside.high, pair)};
  }

private:
  PairSelector<V> low_;
  PairSelector<V> high_;
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
