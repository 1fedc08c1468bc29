// A register of columns as polynomials in the local Y, and samples on them.
//
// On an edge u = const, position, dv and dvv come from the edge, du and duv from the patch; on an
// edge v = const it is position, du and duu that come from the edge; corners are stored. Of a
// rational patch, only all channels of one or of the other make sense together, so where a quotient
// needs derivatives the lanes on edges u = const are computed from both.
#pragma once

#include "kernels/shape_cell.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// How samples are computed: derivatives up to kOrder, with weights, of exactly three components;
/// orders in u and v that the compiler knows, or 0.
template <std::size_t kHighest, bool kRational, bool kSpace, std::size_t kU, std::size_t kV>
struct Plan {
  static constexpr std::size_t kDepth = kHighest;
  using Slots = Channels<kRational, kSpace>;
  static constexpr bool kWeighted = kRational;
  /// Whether lanes on edges u = const need polynomials of their own besides the patch's.
  static constexpr bool kTwoSets = kRational && kDepth > 0;
  static constexpr bool kInSpace = kSpace;
  using OrderU = Order<kU>;
  using OrderV = Order<kV>;
  static constexpr bool kKnown = kU != 0 && kV != 0 && kSpace;
  /// All that follows from the shape is a constant where the shape is known.
  static SIMDBEZIER_INLINE NetShape shape(const NetShape& of_set) {
    if constexpr (kKnown) {
      return {static_cast<int>(kU) - 1, static_cast<int>(kV) - 1, 3, kRational};
    } else {
      return of_set;
    }
  }
};

template <typename P, typename V>
class ShapeColumns {
  using T = ScalarOf<V>;
  static constexpr std::size_t kDepth = P::kDepth;
  static constexpr std::size_t kSlots = P::Slots::kSlots;

public:
  SIMDBEZIER_INLINE ShapeColumns(const NetShape& shape, const CellColumns<V>& columns,
                                 std::size_t first_component, bool watertight)
      : shape_(shape), columns_(columns), slots_(shape, first_component), order_u_(shape.order_u()),
        order_v_(shape.order_v()), watertight_(watertight),
        scale_u_(broadcast<V>(static_cast<T>(P::shape(shape).cells_u()))),
        scale_v_(broadcast<V>(static_cast<T>(P::shape(shape).cells_v()))) {}

  /// The columns' polynomials in one row of cells.
  SIMDBEZIER_INLINE void build(const CellRow<T>& row) {
    row_ = &row;
    on_edge_ = watertight_ && columns_.local.on_edge;
    for_slots<kSlots>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      if (any_low()) {
        build_slot(row.low, slot, power_[slot], edge_power(slot));
      }
      if (any_high()) {
        any_low() ? merge_slot(row.high, slot)
                  : build_slot(row.high, slot, power_[slot], edge_power(slot));
      }
    });
  }

  /// Samples at the local y, off the edges v = const.
  SIMDBEZIER_INLINE void evaluate(V y, SampleJet<V>& jet) const {
    if constexpr (!P::kWeighted) {
      for_slots<3>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
        const Partials<V> at = partials(power_[slot], y);
        store(jet, slot, at.value, at);
      });
    } else {
      const Partials<V> weight = negated_slopes(partials(power_[3], y));
      const Quotient<V> quotient(weight.value);
      for_slots<3>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
        divide_slot(quotient, partials(power_[slot], y), weight, jet, slot);
      });
      if constexpr (P::kTwoSets) {
        if (on_edge_) {
          replace_on_edge(y, jet);
        }
      }
    }
    finish(jet);
  }

  /// Replaces what an edge v = const has of its own: kEdgeV0 or kEdgeV1 of these cells.
  SIMDBEZIER_INLINE void replace_row(std::size_t edge, SampleJet<V>& jet) const {
    Series<V> weight;
    if constexpr (P::kWeighted) {
      weight = edge_series(3, edge);
    } else {
      weight.value = columns_.local.x; // not used
    }
    const Quotient<V> quotient = quotient_of(weight);
    for_slots<3>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      Series<V> at = edge_series(slot, edge);
      if constexpr (P::kWeighted) {
        at = divided(quotient, at, weight);
      }
      V position = at.value;
      if (row_->low.origins != nullptr) {
        position = position + chosen(slots_.channel(slot) * detail::kOriginsPerComponent +
                                         detail::kEdgeOriginsAt + edge,
                                     &Cell<T>::origins);
      }
      jet.position[slot] = replaced(
          position, shape().corners_at() + slots_.channel(slot) * 4 + detail::corner_index(0, edge),
          &Cell<T>::edges);
      if constexpr (kDepth > 0) {
        jet.du[slot] = at.first * scale_u_;
      }
      if constexpr (kDepth > 1) {
        jet.duu[slot] = at.second * (scale_u_ * scale_u_);
      }
    });
  }

  /// The polynomial of a slot, and what its values are relative to.
  SIMDBEZIER_INLINE const V* power(std::size_t slot) const { return power_[slot][0]; }
  SIMDBEZIER_INLINE V origin(std::size_t slot) const {
    if (row_->low.origins == nullptr) {
      return columns_.local.x; // not used
    }
    const std::size_t at = slots_.channel(slot) * detail::kOriginsPerComponent;
    const V inside = chosen(at, &Cell<T>::origins);
    return on_edge_
               ? replaced(inside, at + detail::kEdgeOriginsAt + detail::kEdgeU0, &Cell<T>::origins)
               : inside;
  }

private:
  /// Polynomials in y: of the value, and of the first and second derivative in x.
  using Powers = V[kDepth + 1][P::OrderV::kMost];
  using EdgePowers = V[P::OrderV::kMost];

  /// Unrolled only where that keeps the polynomials in registers: it is much code.
  template <std::size_t kCount, typename F>
  SIMDBEZIER_INLINE void for_slots(const F& f) const {
    if constexpr (P::kKnown) {
      repeat<kCount>(f);
    } else {
      for (std::size_t slot = 0; slot < kCount; ++slot) {
        if (slots_.used(slot)) {
          f(slot);
        }
      }
    }
  }

  SIMDBEZIER_INLINE EdgePowers& edge_power(std::size_t slot) {
    return edge_power_[P::kTwoSets ? slot : 0];
  }

  SIMDBEZIER_INLINE void build_slot(const Cell<T>& cell, std::size_t slot, Powers& to,
                                    EdgePowers& edge) const {
    const T* const matrix = cell.coefficients + slots_.channel(slot) * shape().matrix();
    for_coefficients(order_v_, [&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA {
      const Series<V> s = series_at(matrix + l, order_v_.value());
      to[0][l] = s.value;
      if constexpr (kDepth > 0) {
        to[1][l] = s.first;
      }
      if constexpr (kDepth > 1) {
        to[2][l] = s.second;
      }
    });
    replace_edges(cell, slot, P::kTwoSets ? edge : to[0], to[0]);
  }

  /// As above, for the lanes of the higher cell only.
  SIMDBEZIER_INLINE void merge_slot(const Cell<T>& cell, std::size_t slot) {
    Powers high;
    EdgePowers high_edge;
    build_slot(cell, slot, high, high_edge);
    for (std::size_t l = 0; l < order_v_.value(); ++l) {
      for (std::size_t d = 0; d <= kDepth; ++d) {
        power_[slot][d][l] = select_where<V>(columns_.low, power_[slot][d][l], high[d][l]);
      }
      if (P::kTwoSets && on_edge_) {
        edge_power(slot)[l] = select_where<V>(columns_.low, edge_power(slot)[l], high_edge[l]);
      }
    }
  }

  SIMDBEZIER_INLINE Series<V> series_at(const T* first, std::size_t stride) const {
    return horner_series<kDepth>(
        order_u_, columns_.local.x,
        [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return broadcast<V>(first[k * stride]); });
  }

  SIMDBEZIER_INLINE void replace_edges(const Cell<T>& cell, std::size_t slot, V* to,
                                       const V* inside) const {
    if (!on_edge_) {
      return;
    }
    const T* const edges = cell.edges + slots_.channel(slot) * shape().edge_powers() * 4;
    for_coefficients(order_v_, [&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA {
      to[l] = columns_.local.edges.replace(inside[l], edges + l * 4 + detail::kEdgeU0);
    });
  }

  SIMDBEZIER_INLINE Partials<V> partials(const Powers& power, V y) const {
    Partials<V> at;
    const Series<V> s = horner_series<kDepth>(order_v_, y, coefficients(power[0]));
    at.value = s.value;
    if constexpr (kDepth > 0) {
      at.y = s.first;
      const Series<V> x =
          horner_series<(kDepth > 1 ? 1 : 0)>(order_v_, y, coefficients(power[kDepth > 0 ? 1 : 0]));
      at.x = x.value;
      if constexpr (kDepth > 1) {
        at.yy = s.second;
        at.xy = x.first;
        at.xx = horner_series<0>(order_v_, y, coefficients(power[kDepth > 1 ? 2 : 0])).value;
      }
    }
    return at;
  }
  static SIMDBEZIER_INLINE auto coefficients(const V* c) {
    return [c](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return c[k]; };
  }

  SIMDBEZIER_INLINE void store(SampleJet<V>& jet, std::size_t slot, V position,
                               const Partials<V>& at) const {
    jet.position[slot] = position;
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
                                     const Partials<V>& w, SampleJet<V>& jet,
                                     std::size_t slot) const {
    const V s = q.value(h.value);
    Partials<V> at;
    if constexpr (kDepth > 0) {
      at.x = q.first(h.x, s, w.x);
      at.y = q.first(h.y, s, w.y);
    }
    if constexpr (kDepth > 1) {
      at.xx = q.second(h.xx, s, at.x, at.x, w.x, w.x, w.xx);
      at.xy = q.second(h.xy, s, at.x, at.y, w.x, w.y, w.xy);
      at.yy = q.second(h.yy, s, at.y, at.y, w.y, w.y, w.yy);
    }
    store(jet, slot, s, at);
  }

  static SIMDBEZIER_INLINE Partials<V> negated_slopes(Partials<V> w) {
    if constexpr (kDepth > 0) {
      w.x = negated(w.x);
      w.y = negated(w.y);
    }
    if constexpr (kDepth > 1) {
      w.xx = negated(w.xx);
      w.xy = negated(w.xy);
      w.yy = negated(w.yy);
    }
    return w;
  }

  /// The quotient by a weight along one direction, whose derivatives are negated in passing.
  static SIMDBEZIER_INLINE Quotient<V> quotient_of(Series<V>& w) {
    if constexpr (P::kWeighted && kDepth > 0) {
      w.first = negated(w.first);
    }
    if constexpr (P::kWeighted && kDepth > 1) {
      w.second = negated(w.second);
    }
    return Quotient<V>(w.value);
  }

  static SIMDBEZIER_INLINE Series<V> divided(const Quotient<V>& q, const Series<V>& h,
                                             const Series<V>& w) {
    Series<V> s;
    s.value = q.value(h.value);
    if constexpr (kDepth > 0) {
      s.first = q.first(h.first, s.value, w.first);
    }
    if constexpr (kDepth > 1) {
      s.second = q.second(h.second, s.value, s.first, s.first, w.first, w.first, w.second);
    }
    return s;
  }

  SIMDBEZIER_INLINE void replace_on_edge(V y, SampleJet<V>& jet) const {
    const MaskOf<V> on =
        (columns_.local.x == broadcast<V>(T(-0.5))) | (columns_.local.x == broadcast<V>(T(0.5)));
    Series<V> w = horner_series<kDepth>(order_v_, y, coefficients(edge_power_[kSlots - 1]));
    const Quotient<V> quotient = quotient_of(w);
    for_slots<3>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      const Series<V> s =
          divided(quotient, horner_series<kDepth>(order_v_, y, coefficients(edge_power_[slot])), w);
      jet.position[slot] = select_where<V>(on, s.value, jet.position[slot]);
      if constexpr (kDepth > 0) {
        jet.dv[slot] = select_where<V>(on, s.first, jet.dv[slot]);
      }
      if constexpr (kDepth > 1) {
        jet.dvv[slot] = select_where<V>(on, s.second, jet.dvv[slot]);
      }
    });
  }

  /// Origins, and from local derivatives to those by u and v: factors 1, 2 or 4.
  SIMDBEZIER_INLINE void finish(SampleJet<V>& jet) const {
    for_slots<3>([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      if (row_->low.origins != nullptr) {
        jet.position[slot] = jet.position[slot] + origin(slot);
      }
      if constexpr (kDepth > 0) {
        jet.du[slot] = jet.du[slot] * scale_u_;
        jet.dv[slot] = jet.dv[slot] * scale_v_;
      }
      if constexpr (kDepth > 1) {
        jet.duu[slot] = jet.duu[slot] * (scale_u_ * scale_u_);
        jet.duv[slot] = jet.duv[slot] * (scale_u_ * scale_v_);
        jet.dvv[slot] = jet.dvv[slot] * (scale_v_ * scale_v_);
      }
    });
  }

  SIMDBEZIER_INLINE Series<V> edge_series(std::size_t slot, std::size_t edge) const {
    const std::size_t at = slots_.channel(slot) * shape().edge_powers() * 4 + edge;
    return horner_series<kDepth>(order_u_, columns_.local.x,
                                 [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
                                   return chosen(at + 4 * k, &Cell<T>::edges);
                                 });
  }

  /// A value of each lane's cell.
  SIMDBEZIER_INLINE V chosen(std::size_t at, const T* Cell<T>::*values) const {
    const V high = broadcast<V>((row_->high.*values)[at]);
    return any_low() && any_high()
               ? select_where<V>(columns_.low, broadcast<V>((row_->low.*values)[at]), high)
           : any_low() ? broadcast<V>((row_->low.*values)[at])
                       : high;
  }
  /// The lanes on edges u = const get a value of their cell's: of the pair at `at`.
  SIMDBEZIER_INLINE V replaced(V inside, std::size_t at, const T* Cell<T>::*values) const {
    const PairSelector<V>& edges = columns_.local.edges;
    const V high = any_high() ? edges.replace(inside, row_->high.*values + at) : inside;
    return !any_low() ? high
           : any_high()
               ? select_where<V>(columns_.low, edges.replace(inside, row_->low.*values + at), high)
               : edges.replace(inside, row_->low.*values + at);
  }

  SIMDBEZIER_INLINE NetShape shape() const { return P::shape(shape_); }
  /// Which cells the columns are in, by a constant where there is one.
  SIMDBEZIER_INLINE bool any_low() const { return shape().cells_u() == 1 || columns_.any_low; }
  SIMDBEZIER_INLINE bool any_high() const { return shape().cells_u() == 2 && columns_.any_high; }

  const NetShape& shape_;
  const CellColumns<V>& columns_;
  typename P::Slots slots_;
  typename P::OrderU order_u_;
  typename P::OrderV order_v_;
  bool watertight_;
  bool on_edge_ = false;
  V scale_u_;
  V scale_v_;
  const CellRow<T>* row_ = nullptr;
  Powers power_[kSlots];
  EdgePowers edge_power_[P::kTwoSets ? kSlots : 1];
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
