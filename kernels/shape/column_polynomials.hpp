// A register of columns as polynomials in the local Y, and samples on them away from the edges
// v = const.
#pragma once

#include "kernels/shape/shape_cell.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// How samples are computed: derivatives up to kHighest, with or without weights, and what the
/// compiler knows (else 0): how many components go at once (one of any number, or all three), and
/// the orders of a patch that is one cell. Sweeps run along v, so the order in u matters only where
/// there is little else to do.
template <std::size_t kHighest, bool kRational, std::size_t kComponents, std::size_t kU,
          std::size_t kV>
struct ShapePlan {
  static constexpr std::size_t kDepth = kHighest;
  static constexpr bool kWeighted = kRational;
  static constexpr bool kKnown = kV != 0;
  static constexpr bool kOneCell = kComponents != 0;
  static constexpr bool kSingle = kComponents == 1;
  using Slots = Channels<kRational, kComponents>;
  using OrderU = Order<kU>;
  using OrderV = Order<kV>;
  /// The same for all degrees: for functions that do not depend on them.
  using AnyDegree = ShapePlan<kHighest, kRational, kComponents, 0, 0>;
  static_assert(kOneCell || !kKnown);

  /// The same shape, with constants for what the plan says.
  static SIMDBEZIER_INLINE NetShape shape(NetShape of_set) {
    of_set.rational = kRational;
    if constexpr (kComponents == 3) {
      of_set.components = 3;
    }
    if constexpr (kU != 0) {
      of_set.degree_u = static_cast<int>(kU) - 1;
    }
    if constexpr (kV != 0) {
      of_set.degree_v = static_cast<int>(kV) - 1;
    }
    return of_set;
  }
};

/// The polynomials of value (homogeneous where there are weights) and derivatives by u.
template <typename P, typename V>
struct ColumnPolynomials {
  static constexpr std::size_t kDepth = P::kDepth;
  static constexpr std::size_t kSlots = P::Slots::kSlots;
  static constexpr std::size_t kMostPowers = P::OrderV::kMost;
  using Powers = V[kDepth + 1][kMostPowers];

  Powers power[kSlots]; ///< [slot][derivative][power of Y]

  ColumnPolynomials() = default;
  /// Piece by piece, so that a copy can live in registers.
  SIMDBEZIER_INLINE ColumnPolynomials(const ColumnPolynomials& from) {
    repeat<kSlots>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      repeat<(kDepth + 1) * kMostPowers>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
        power[slot][k / kMostPowers][k % kMostPowers] =
            from.power[slot][k / kMostPowers][k % kMostPowers];
      });
    });
  }

  /// origins: null where there are none.
  SIMDBEZIER_INLINE void evaluate(const typename P::Slots& slots, typename P::OrderV order, V y,
                                  const ColumnOrigins<V>* origins, SampleJet<V>& jet) const {
    if constexpr (kDepth == 0) {
      positions(slots, order, y, jet.position);
    } else if constexpr (P::kWeighted) {
      Partials<V> weight = partials(order, power[P::Slots::kWeight], y);
      negate_slopes(weight);
      const Quotient<V> quotient(weight.value);
      jet.inverse_weight = quotient.inverse;
      slots.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
        divide_slot(quotient, partials(order, power[slot], y), weight, origins, slot, jet);
      });
    } else {
      slots.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
        const Series<V> along_v = row_series<kDepth>(order, y, coefficients(power[slot][0]));
        jet.position[slot] = along_v.value;
        jet.dv[slot] = along_v.first;
        const Series<V> of_slopes = row_series<kDepth - 1>(order, y, coefficients(power[slot][1]));
        jet.du[slot] = of_slopes.value;
        if constexpr (kDepth > 1) {
          jet.dvv[slot] = along_v.second;
          jet.duv[slot] = of_slopes.first;
          jet.duu[slot] = row_series<0>(order, y, coefficients(power[slot][2])).value;
        }
      });
    }
    if (origins != nullptr) {
      slots.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
        jet.position[slot] = jet.position[slot] + origins->position[slot];
      });
    }
  }

private:
  static SIMDBEZIER_INLINE auto coefficients(const V* c) {
    return [c](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return c[k]; };
  }

  /// Nothing but values, so that no compiler keeps room for the rest of a jet.
  SIMDBEZIER_INLINE void positions(const typename P::Slots& slots, typename P::OrderV order, V y,
                                   V p[3]) const {
    const auto value = [&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      return row_series<0>(order, y, coefficients(power[slot][0])).value;
    };
    if constexpr (P::kWeighted) {
      const Quotient<V> quotient(value(P::Slots::kWeight));
      slots.for_components([&](std::size_t slot)
                               SIMDBEZIER_INLINE_LAMBDA { p[slot] = quotient.value(value(slot)); });
    } else {
      slots.for_components([&](std::size_t slot)
                               SIMDBEZIER_INLINE_LAMBDA { p[slot] = value(slot); });
    }
  }

  static SIMDBEZIER_INLINE Partials<V> partials(typename P::OrderV order, const Powers& p, V y) {
    Partials<V> at;
    const Series<V> s = row_series<kDepth>(order, y, coefficients(p[0]));
    at.value = s.value;
    if constexpr (kDepth > 0) {
      at.y = s.first;
      const Series<V> x = row_series<kDepth - 1>(order, y, coefficients(p[1]));
      at.x = x.value;
      if constexpr (kDepth > 1) {
        at.yy = s.second;
        at.xy = x.first;
        at.xx = row_series<0>(order, y, coefficients(p[2])).value;
      }
    }
    return at;
  }

  static SIMDBEZIER_INLINE void store(SampleJet<V>& jet, std::size_t slot, const Partials<V>& at) {
    jet.position[slot] = at.value;
    if constexpr (kDepth > 0) {
      jet.du[slot] = at.x;
      jet.dv[slot] = at.y;
    }
    if constexpr (kDepth > 1) {
      jet.duu[slot] = at.xx;
      jet.duv[slot] = at.xy;
      jet.dvv[slot] = at.yy;
    }
  }

  SIMDBEZIER_INLINE void divide_slot(const Quotient<V>& q, const Partials<V>& h,
                                     const Partials<V>& w, const ColumnOrigins<V>* origins,
                                     std::size_t slot, SampleJet<V>& jet) const {
    Partials<V> at;
    at.value = q.value(h.value);
    if constexpr (kDepth > 0) {
      const V s = origins != nullptr ? at.value + origins->to_patch[slot] : at.value;
      at.x = q.first(h.x, s, w.x);
      at.y = q.first(h.y, at.value, w.y);
      if constexpr (kDepth > 1) {
        at.xx = q.second(h.xx, s, at.x, at.x, w.x, w.x, w.xx);
        at.xy = q.second(h.xy, s, at.x, at.y, w.x, w.y, w.xy);
        at.yy = q.second(h.yy, at.value, at.y, at.y, w.y, w.y, w.yy);
      }
    }
    store(jet, slot, at);
  }

  static SIMDBEZIER_INLINE void negate_slopes(Partials<V>& w) {
    if constexpr (kDepth > 0) {
      w.x = negated(w.x);
      w.y = negated(w.y);
    }
    if constexpr (kDepth > 1) {
      w.xx = negated(w.xx);
      w.xy = negated(w.xy);
      w.yy = negated(w.yy);
    }
  }
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
