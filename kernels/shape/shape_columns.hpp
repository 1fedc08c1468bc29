// From the packed values of a patch to a register of its columns, as polynomials in the local Y.
#pragma once

#include "kernels/shape/column_polynomials.hpp"
#include "kernels/shape/shape_edges.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename P, typename V>
class ShapeColumns {
  using T = ScalarOf<V>;
  using Powers = typename ColumnPolynomials<P, V>::Powers;
  static constexpr std::size_t kDepth = P::kDepth;

public:
  using Edges = ShapeEdges<P, V>;

  SIMDBEZIER_INLINE ShapeColumns(const NetShape& shape, const CellColumns<V>& columns,
                                 std::size_t first_component)
      : shape_(P::shape(shape)), columns_(columns), slots_(shape_, first_component),
        order_u_(shape_.order_u()), order_v_(shape_.order_v()) {}

  /// The columns in one row of cells, to which `edges` belong. room: as long as they are used.
  SIMDBEZIER_INLINE void build(const CellRow<T>& row, const Edges& edges, ColumnOrigins<V>& room) {
    origins_ = nullptr;
    if (edges.has_origins() || edges.has_points()) [[unlikely]] {
      edges.find_origins(room);
      origins_ = &room;
    }
    slots_.for_channels([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      build_slot(any_low() ? row.low : row.high, slot, polynomials_.power[slot]);
      if (any_low() && any_high()) {
        merge_slot(row.high, slot);
      }
    });
  }

  SIMDBEZIER_INLINE const ColumnPolynomials<P, V>& polynomials() const { return polynomials_; }
  SIMDBEZIER_INLINE const typename P::Slots& slots() const { return slots_; }
  SIMDBEZIER_INLINE typename P::OrderV order_v() const { return order_v_; }
  /// The origins of the set, or of edges that are points; null where there are none.
  SIMDBEZIER_INLINE const ColumnOrigins<V>* origins() const { return origins_; }

  /// Samples at the local y, off the edges v = const.
  SIMDBEZIER_INLINE void evaluate(V y, SampleJet<V>& jet) const {
    polynomials_.evaluate(slots_, order_v_, y, origins_, jet);
    if (!P::kOneCell && shape_.cells_v() == 2) {
      scale_v(jet);
    }
  }

private:
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
    if (columns_.local.on_edge) {
      const T* const edges =
          cell.edges + slots_.channel(slot) * shape_.edge_powers() * 4 + detail::kEdgeU0;
      for_coefficients(order_v_, [&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA {
        to[0][l] = columns_.local.edges.replace(to[0][l], edges + l * 4);
      });
    }
  }

  SIMDBEZIER_INLINE void put_power(Series<V>& s, std::size_t l, Powers& to) const {
    if constexpr (!P::kOneCell) {
      scale_by_cells<kDepth>(s, shape_.cells_u());
    }
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

  SIMDBEZIER_INLINE bool any_low() const { return P::kOneCell || columns_.any_low; }
  SIMDBEZIER_INLINE bool any_high() const { return !P::kOneCell && columns_.any_high; }

  NetShape shape_;
  const CellColumns<V>& columns_;
  typename P::Slots slots_;
  typename P::OrderU order_u_;
  typename P::OrderV order_v_;
  const ColumnOrigins<V>* origins_ = nullptr;
  ColumnPolynomials<P, V> polynomials_;
};

/// ShapeColumns::build() as a function, which grids and scattered samples share: for plans whose
/// loops have polynomials in memory anyway.
template <typename P, typename V>
__attribute__((noinline)) void
build_columns(ShapeColumns<P, V>& columns, const CellRow<ScalarOf<V>>& row,
              const ShapeEdges<P, V>& edges, ColumnOrigins<V>& room) {
  columns.build(row, edges, room);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
