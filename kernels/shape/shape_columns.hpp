// From the packed values of a patch to a register of its columns, as polynomials in the local Y.
//
// On an edge u = const, position, dv and dvv come from the edge, du and duv from the patch; on an
// edge v = const it is position, du and duu that come from the edge; corners are stored.
#pragma once

#include "kernels/shape/column_polynomials.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename P, typename V>
class ShapeColumns {
  using T = ScalarOf<V>;
  using Powers = typename ColumnPolynomials<P, V>::Powers;
  static constexpr std::size_t kDepth = P::kDepth;

public:
  SIMDBEZIER_INLINE ShapeColumns(const NetShape& shape, const CellColumns<V>& columns,
                                 std::size_t first_component)
      : shape_(P::shape(shape)), columns_(columns), slots_(shape_, first_component),
        order_u_(shape_.order_u()), order_v_(shape_.order_v()), on_edge_(columns.local.on_edge) {}

  /// The columns in one row of cells.
  SIMDBEZIER_INLINE void build(const CellRow<T>& row) {
    row_ = &row;
    slots_.for_channels([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      if (any_low()) {
        build_slot(row.low, slot, polynomials_.power[slot]);
      }
      if (any_high()) {
        any_low() ? merge_slot(row.high, slot)
                  : build_slot(row.high, slot, polynomials_.power[slot]);
      }
    });
    around_origins_ = has_origins();
    if (around_origins_) {
      slots_.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA { build_origin(slot); });
    } else if (P::kWeighted && on_edge_ && has_points()) [[unlikely]] {
      build_points();
    }
  }

  SIMDBEZIER_INLINE const ColumnPolynomials<P, V>& polynomials() const { return polynomials_; }
  SIMDBEZIER_INLINE const typename P::Slots& slots() const { return slots_; }
  SIMDBEZIER_INLINE typename P::OrderV order_v() const { return order_v_; }
  /// Whether positions are relative to origins: of the set, or of edges that are points.
  SIMDBEZIER_INLINE bool around_origins() const { return around_origins_; }

  /// Samples at the local y, off the edges v = const.
  SIMDBEZIER_INLINE void evaluate(V y, SampleJet<V>& jet) const {
    polynomials_.evaluate(slots_, order_v_, y, around_origins_, jet);
    if (!P::kKnown && shape_.cells_v() == 2) {
      scale_v(jet);
    }
  }

  /// Replaces what an edge v = const has of its own: kEdgeV0 or kEdgeV1 of these cells.
  SIMDBEZIER_INLINE void replace_row(std::size_t edge, SampleJet<V>& jet) const {
    Series<V> weight;
    if constexpr (P::kWeighted) {
      weight = edge_series(P::Slots::kWeight, edge);
      negate_slopes(weight);
    } else {
      weight.value = columns_.local.x; // not used
    }
    const Quotient<V> quotient(weight.value);
    slots_.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      Series<V> at = edge_series(slot, edge);
      if constexpr (P::kWeighted) {
        at = divided(quotient, at, weight);
      }
      V position = at.value;
      if (has_origins()) {
        position =
            position + chosen(origin_at(slot) + detail::kEdgeOriginsAt + edge, &Cell<T>::origins);
      }
      jet.position[slot] = replaced(
          position, shape_.corners_at() + slots_.channel(slot) * 4 + detail::corner_index(0, edge),
          &Cell<T>::edges);
      if constexpr (kDepth > 0) {
        jet.du[slot] = at.first;
      }
      if constexpr (kDepth > 1) {
        jet.duu[slot] = at.second;
      }
    });
  }

private:
  SIMDBEZIER_INLINE bool has_origins() const { return row_->low.origins != nullptr; }

  SIMDBEZIER_INLINE void build_slot(const Cell<T>& cell, std::size_t slot, Powers& to) const {
    const T* const matrix = cell.coefficients + slots_.channel(slot) * shape_.matrix();
    const V x = columns_.local.x;
    if constexpr (P::kKnown) {
      constexpr std::size_t kV = P::OrderV::kMost;
      Series<V> s[kV];
      horner_series_abreast<kDepth, kV>(order_u_, x, matrix, s);
      repeat<kV>([&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA { put_power(s[l], l, to); });
    } else {
      const std::size_t order_v = order_v_.value();
      for (std::size_t l = 0; l < order_v; ++l) {
        const auto coefficient = [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
          return broadcast<V>(matrix[k * order_v + l]);
        };
        Series<V> s = horner_series<kDepth>(order_u_, x, coefficient);
        put_power(s, l, to);
      }
    }
    if (on_edge_) {
      const T* const edges =
          cell.edges + slots_.channel(slot) * shape_.edge_powers() * 4 + detail::kEdgeU0;
      for_coefficients(order_v_, [&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA {
        to[0][l] = columns_.local.edges.replace(to[0][l], edges + l * 4);
      });
    }
  }

  SIMDBEZIER_INLINE void put_power(Series<V>& s, std::size_t l, Powers& to) const {
    scale_u(s);
    to[0][l] = s.value;
    if constexpr (kDepth > 0) {
      to[1][l] = s.first;
    }
    if constexpr (kDepth > 1) {
      to[2][l] = s.second;
    }
  }

  /// As build_slot(), for the lanes of the higher cell only. Rare, and only with loops.
  SIMDBEZIER_INLINE void merge_slot(const Cell<T>& cell, std::size_t slot) {
    Powers high;
    build_slot(cell, slot, high);
    Powers& power = polynomials_.power[slot];
    for (std::size_t d = 0; d <= kDepth; ++d) {
      for_coefficients(order_v_, [&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA {
        power[d][l] = select_where<V>(columns_.low, power[d][l], high[d][l]);
      });
    }
  }

  SIMDBEZIER_INLINE void build_origin(std::size_t slot) {
    const std::size_t at = origin_at(slot);
    const V inside = chosen(at, &Cell<T>::origins);
    V& origin = polynomials_.origin[slot];
    origin = inside;
    if (on_edge_) {
      origin = replaced(inside, at + detail::kEdgeOriginsAt + detail::kEdgeU0, &Cell<T>::origins);
    }
    if constexpr (P::kWeighted && kDepth > 0) {
      const V zero = broadcast<V>(T(0));
      polynomials_.to_patch[slot] =
          on_edge_ ? replaced(zero, at + detail::kRelativeOriginsAt, &Cell<T>::origins) : zero;
    }
  }
  /// Whether an edge u = const of this row of cells has the mark of a point.
  SIMDBEZIER_INLINE bool has_points() const {
    const std::size_t marks = shape_.corners_at() + slots_.channel(P::Slots::kWeight) * 4;
    return row_->low.edges[marks] != T(0) || row_->high.edges[marks + 1] != T(0);
  }
  /// Lanes on edges u = const that are points, in sets without origins: their numerators are zero,
  /// and their points stand in the corners. To all others, -0 adds nothing.
  SIMDBEZIER_INLINE void build_points() {
    const V zero = broadcast<V>(T(0));
    const std::size_t corners = shape_.corners_at();
    const V marks =
        replaced(zero, corners + slots_.channel(P::Slots::kWeight) * 4, &Cell<T>::edges);
    const MaskOf<V> points = marks > zero;
    around_origins_ = true;
    slots_.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      const V point = replaced(zero, corners + slots_.channel(slot) * 4, &Cell<T>::edges);
      polynomials_.origin[slot] = polynomials_.to_patch[slot] =
          select_where<V>(points, point, broadcast<V>(T(-0.0)));
    });
  }
  SIMDBEZIER_INLINE std::size_t origin_at(std::size_t slot) const {
    return slots_.channel(slot) * detail::kOriginsPerComponent;
  }

  /// From derivatives by the local X to those by u: factors 1, or 2 and 4.
  SIMDBEZIER_INLINE void scale_u(Series<V>& s) const {
    if (!P::kKnown && shape_.cells_u() == 2) {
      if constexpr (kDepth > 0) {
        s.first = s.first + s.first;
      }
      if constexpr (kDepth > 1) {
        s.second = s.second * broadcast<V>(T(4));
      }
    }
  }
  SIMDBEZIER_INLINE void scale_v(SampleJet<V>& jet) const {
    slots_.for_components([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      if constexpr (kDepth > 0) {
        jet.dv[slot] = jet.dv[slot] + jet.dv[slot];
      }
      if constexpr (kDepth > 1) {
        jet.duv[slot] = jet.duv[slot] + jet.duv[slot];
        jet.dvv[slot] = jet.dvv[slot] * broadcast<V>(T(4));
      }
    });
  }

  static SIMDBEZIER_INLINE void negate_slopes(Series<V>& w) {
    if constexpr (kDepth > 0) {
      w.first = negated(w.first);
    }
    if constexpr (kDepth > 1) {
      w.second = negated(w.second);
    }
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

  SIMDBEZIER_INLINE Series<V> edge_series(std::size_t slot, std::size_t edge) const {
    const std::size_t at = slots_.channel(slot) * shape_.edge_powers() * 4 + edge;
    Series<V> s = horner_series<kDepth>(order_u_, columns_.local.x,
                                        [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
                                          return chosen(at + 4 * k, &Cell<T>::edges);
                                        });
    scale_u(s);
    return s;
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

  SIMDBEZIER_INLINE bool any_low() const { return P::kKnown || columns_.any_low; }
  SIMDBEZIER_INLINE bool any_high() const { return !P::kKnown && columns_.any_high; }

  NetShape shape_;
  const CellColumns<V>& columns_;
  typename P::Slots slots_;
  typename P::OrderU order_u_;
  typename P::OrderV order_v_;
  bool on_edge_;
  bool around_origins_ = false;
  const CellRow<T>* row_ = nullptr;
  ColumnPolynomials<P, V> polynomials_;
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
