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
  /// This is the plan for origins, which depend neither on degrees nor on how far derivatives go.
  using ForOrigins = ShapePlan<1, kRational, kComponents == 1 ? 1 : 0, 0, 0>;
  static_assert(kOneCell || !kKnown);

  /// Returns the shape of a set with constants for what the plan says.
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
  /// Copies piece by piece, so that a copy can live in registers.
  SIMDBEZIER_INLINE ColumnPolynomials(const ColumnPolynomials& from) {
    repeat<kSlots>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      repeat<(kDepth + 1) * kMostPowers>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
        power[slot][k / kMostPowers][k % kMostPowers] =
            from.power[slot][k / kMostPowers][k % kMostPowers];
      });
    });
  }

  /// Evaluates kRows rows at once. origins is null where there are none.
  template <std::size_t kRows>
  SIMDBEZIER_INLINE void evaluate(const typename P::Slots& slots, typename P::OrderV order,
                                  const V* y, const ColumnOrigins<V>* origins,
                                  SampleJet<V>* jet) const {
    if constexpr (P::kWeighted) {
      quotients<kRows>(slots, order, y, origins, jet);
    } else {
      slots.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
        evaluate_slot<kRows>(slot, order, y, origins, jet);
      });
    }
  }
  /// This is evaluate() of one component, which needs no weights.
  template <std::size_t kRows>
  SIMDBEZIER_INLINE void evaluate_slot(std::size_t slot, typename P::OrderV order, const V* y,
                                       const ColumnOrigins<V>* origins, SampleJet<V>* jet) const {
    static_assert(!P::kWeighted);
    Partials<V> at[kRows];
    partials<kRows>(order, power[slot], y, at);
    repeat<kRows>([&](std::size_t r)
                      SIMDBEZIER_INLINE_LAMBDA { store(jet[r], slot, at[r], origins); });
  }

  /// Evaluates samples at y and -y, which share most of their arithmetic, of an order that is known
  /// and takes even and odd parts. There are first derivatives where there are no weights.
  SIMDBEZIER_INLINE void evaluate_pair(const typename P::Slots& slots, V y,
                                       const ColumnOrigins<V>* origins, SampleJet<V>& jet,
                                       SampleJet<V>& mirrored) const {
    static_assert(kDepth == 0 || !P::kWeighted);
    constexpr std::size_t kRowOrder = P::OrderV::kMost;
    V even;
    V odd;
    if constexpr (P::kWeighted) {
      even_odd_parts<kRowOrder>(y, coefficients(power[P::Slots::kWeight][0]), even, odd);
      jet.inverse_weight = Quotient<V>::by(even + odd).inverse;
      mirrored.inverse_weight = Quotient<V>::by(even - odd).inverse;
    }
    slots.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      even_odd_parts<kRowOrder>(y, coefficients(power[slot][0]), even, odd);
      jet.position[slot] = even + odd;
      mirrored.position[slot] = even - odd;
      if constexpr (P::kWeighted) {
        jet.position[slot] = jet.position[slot] * jet.inverse_weight;
        mirrored.position[slot] = mirrored.position[slot] * mirrored.inverse_weight;
      }
      if (origins != nullptr) [[unlikely]] {
        jet.position[slot] = jet.position[slot] + origins->position[slot];
        mirrored.position[slot] = mirrored.position[slot] + origins->position[slot];
      }
      if constexpr (kDepth > 0) {
        even_odd_slope_parts<kRowOrder>(y, coefficients(power[slot][0]), even, odd);
        jet.dv[slot] = even + odd;
        mirrored.dv[slot] = even - odd;
        even_odd_parts<kRowOrder>(y, coefficients(power[slot][1]), even, odd);
        jet.du[slot] = even + odd;
        mirrored.du[slot] = even - odd;
      }
    });
  }

private:
  static SIMDBEZIER_INLINE auto coefficients(const V* c) {
    return [c](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return c[k]; };
  }

  template <std::size_t kRows>
  SIMDBEZIER_INLINE void quotients(const typename P::Slots& slots, typename P::OrderV order,
                                   const V* y, const ColumnOrigins<V>* origins,
                                   SampleJet<V>* jet) const {
    Partials<V> weight[kRows];
    partials<kRows>(order, power[P::Slots::kWeight], y, weight);
    repeat<kRows>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
      negate_slopes(weight[r]);
      jet[r].inverse_weight = Quotient<V>::by(weight[r].value).inverse;
    });
    slots.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      Partials<V> at[kRows];
      partials<kRows>(order, power[slot], y, at);
      repeat<kRows>([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
        divide_slot(at[r], weight[r], origins, slot, jet[r]);
      });
    });
  }

  template <std::size_t kRows>
  static SIMDBEZIER_INLINE void partials(typename P::OrderV order, const Powers& p, const V* y,
                                         Partials<V>* at) {
    const auto each = [](const auto& f) SIMDBEZIER_INLINE_LAMBDA { repeat<kRows>(f); };
    if constexpr (kRows > 1 && kDepth > 1) { // even and odd parts fill the registers by themselves
      if (takes_even_odd(order.value())) {
        each([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA { partials<1>(order, p, y + r, at + r); });
        return;
      }
    }
    Series<V> s[kRows];
    rows_series<kDepth, kRows>(order, y, coefficients(p[0]), s);
    each([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
      at[r].value = s[r].value;
      if constexpr (kDepth > 0) {
        at[r].y = s[r].first;
      }
      if constexpr (kDepth > 1) {
        at[r].yy = s[r].second;
      }
    });
    if constexpr (kDepth > 0) {
      rows_series<kDepth - 1, kRows>(order, y, coefficients(p[1]), s);
      each([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA {
        at[r].x = s[r].value;
        if constexpr (kDepth > 1) {
          at[r].xy = s[r].first;
        }
      });
    }
    if constexpr (kDepth > 1) {
      rows_series<0, kRows>(order, y, coefficients(p[2]), s);
      each([&](std::size_t r) SIMDBEZIER_INLINE_LAMBDA { at[r].xx = s[r].value; });
    }
  }

  static SIMDBEZIER_INLINE void store(SampleJet<V>& jet, std::size_t slot, const Partials<V>& at,
                                      const ColumnOrigins<V>* origins) {
    jet.position[slot] = at.value;
    if (origins != nullptr) [[unlikely]] {
      jet.position[slot] = at.value + origins->position[slot];
    }
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

  SIMDBEZIER_INLINE void divide_slot(const Partials<V>& h, const Partials<V>& w,
                                     const ColumnOrigins<V>* origins, std::size_t slot,
                                     SampleJet<V>& jet) const {
    const Quotient<V> q{jet.inverse_weight};
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
    store(jet, slot, at, origins);
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
