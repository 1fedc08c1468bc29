// From the packed values of a patch to a register of its columns, as polynomials in the local Y.
#pragma once

#include <algorithm>

#include "kernels/shape/column_polynomials.hpp"
#include "kernels/shape/shape_edges.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename P, typename V>
class ShapeColumns {
  using T = ScalarOf<V>;
  using Powers = typename ColumnPolynomials<P, V>::Powers;
  static constexpr std::size_t kDepth = P::kDepth;
  /// Powers at once where the compiler does not know how many there are: enough to hide the
  /// latency of Horner's rule, few enough for 16 registers.
  static constexpr std::size_t kAbreast = 4;

public:
  using Edges = ShapeEdges<P, V>;

  SIMDBEZIER_PART ShapeColumns(const NetShape& shape, const CellColumns<V>& columns,
                               std::size_t first_component)
      : shape_(P::shape(shape)), columns_(columns), slots_(shape_, first_component),
        order_u_(shape_.order_u()), order_v_(shape_.order_v()) {}

  /// The columns in one row of cells, to which `edges` belong. room: as long as they are used.
  SIMDBEZIER_PART void build(const CellRow<T>& row, const Edges& edges, ColumnOrigins<V>& room) {
    origins_ = nullptr;
    if (edges.has_origins() || edges.has_points()) [[unlikely]] {
      edges.find_origins(room);
      origins_ = &room;
    }
    slots_.for_channels([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      if (any_low() && any_high()) {
        build_slot<true>(row.low, row.high, slot, polynomials_.power[slot]);
      } else {
        const Cell<T>& cell = any_low() ? row.low : row.high;
        build_slot<false>(cell, cell, slot, polynomials_.power[slot]);
      }
    });
  }

  /// build() of one sample (V = T) off the edges of its cell, in a set without origins: lanes are
  /// powers of Y. Reads up to a register behind the last coefficient, where the edges stand.
  SIMDBEZIER_PART void build_across(const Cell<T>& cell) {
    using Lanes = vec<T>;
    const Lanes x = broadcast<Lanes>(columns_.local.x);
    const auto load = [](const T* c) SIMDBEZIER_INLINE_LAMBDA { return load_vector<Lanes>(c); };
    slots_.for_channels([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      const T* const matrix = cell.coefficients + slots_.channel(slot) * shape_.matrix();
      for (std::size_t l = 0; l < order_v_.value(); l += kLanes<Lanes>) {
        Series<Lanes> s;
        horner_series_abreast<kDepth, 1>(order_u_, x, matrix + l, order_v_.value(), load, &s);
        Powers& power = polynomials_.power[slot];
        put_series(s, [&](std::size_t derivative, Lanes value)
                          SIMDBEZIER_INLINE_LAMBDA { store_vector(power[derivative] + l, value); });
      }
    });
  }

  SIMDBEZIER_PART const ColumnPolynomials<P, V>& polynomials() const { return polynomials_; }
  SIMDBEZIER_PART const typename P::Slots& slots() const { return slots_; }
  SIMDBEZIER_PART typename P::OrderV order_v() const { return order_v_; }
  /// The origins of the set, or of edges that are points; null where there are none.
  SIMDBEZIER_PART const ColumnOrigins<V>* origins() const { return origins_; }

  /// Samples at kRows local y, off the edges v = const.
  template <std::size_t kRows>
  SIMDBEZIER_PART void evaluate(const V* y, SampleJet<V>* jet) const {
    polynomials_.template evaluate<kRows>(slots_, order_v_, y, origins_, jet);
    if (!P::kOneCell && shape_.cells_v() == 2) {
      for (std::size_t r = 0; r < kRows; ++r) {
        scale_v(jet[r]);
      }
    }
  }

private:
  /// kMixed: some lanes are in the low cell, and some in the high one; else all are in `low`.
  template <bool kMixed>
  SIMDBEZIER_PART void build_slot(const Cell<T>& low, const Cell<T>& high, std::size_t slot,
                                  Powers& to) const {
    const std::size_t first = slots_.channel(slot) * shape_.matrix();
    const T* const matrix = low.coefficients + first;
    const std::ptrdiff_t to_high = high.coefficients - low.coefficients;
    const auto load = [&](const T* c) SIMDBEZIER_INLINE_LAMBDA {
      return chosen<kMixed>(broadcast<V>(c[0]),
                            [&]() SIMDBEZIER_INLINE_LAMBDA { return broadcast<V>(c[to_high]); });
    };
    build_all_powers(matrix, load, to);
    if (columns_.local.on_edge) {
      const std::size_t edges = slots_.channel(slot) * shape_.edge_powers() * 4 + detail::kEdgeU0;
      for_coefficients(order_v_, [&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA {
        const auto on_edge = [&](const Cell<T>& cell) SIMDBEZIER_INLINE_LAMBDA {
          return columns_.local.edges.replace(to[0][l], cell.edges + edges + l * 4);
        };
        to[0][l] =
            chosen<kMixed>(on_edge(low), [&]() SIMDBEZIER_INLINE_LAMBDA { return on_edge(high); });
      });
    }
  }

  /// Gives each lane the value of its own cell; high() is called only where lanes may be in either.
  template <bool kMixed, typename High>
  SIMDBEZIER_INLINE V chosen(V low, const High& high) const {
    if constexpr (kMixed) {
      return select_where<V>(columns_.low, low, high());
    } else {
      return low;
    }
  }

  template <typename Load>
  SIMDBEZIER_INLINE void build_all_powers(const T* matrix, const Load& load, Powers& to) const {
    if constexpr (P::kKnown) {
      build_powers<P::OrderV::kMost>(matrix, 0, load, to);
    } else {
      const std::size_t order_v = order_v_.value();
      if (order_v < kAbreast) {
        for (std::size_t l = 0; l < order_v; ++l) {
          build_powers<1>(matrix, l, load, to);
        }
      } else { // the last ones may be computed twice
        for (std::size_t l = 0; l < order_v; l += kAbreast) {
          build_powers<kAbreast>(matrix, std::min(l, order_v - kAbreast), load, to);
        }
      }
    }
  }

  /// The powers [first, first + kCount) of Y.
  template <std::size_t kCount, typename Load>
  SIMDBEZIER_INLINE void build_powers(const T* matrix, std::size_t first, const Load& load,
                                      Powers& to) const {
    Series<V> s[kCount];
    horner_series_abreast<kDepth, kCount>(order_u_, columns_.local.x, matrix + first,
                                          order_v_.value(), load, s);
    repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
      put_series(s[i], [&](std::size_t derivative, V value)
                           SIMDBEZIER_INLINE_LAMBDA { to[derivative][first + i] = value; });
    });
  }

  /// put(derivative, value) for each power's value and derivatives by u.
  template <typename W, typename Put>
  SIMDBEZIER_INLINE void put_series(Series<W>& s, const Put& put) const {
    if constexpr (!P::kOneCell) {
      scale_by_cells<kDepth>(s, shape_.cells_u());
    }
    put(0, s.value);
    if constexpr (kDepth > 0) {
      put(1, s.first);
    }
    if constexpr (kDepth > 1) {
      put(2, s.second);
    }
  }

  SIMDBEZIER_PART void scale_v(SampleJet<V>& jet) const {
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

  SIMDBEZIER_PART bool any_low() const { return P::kOneCell || columns_.any_low; }
  SIMDBEZIER_PART bool any_high() const { return !P::kOneCell && columns_.any_high; }

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
SIMDBEZIER_KERNEL void build_columns(ShapeColumns<P, V>& columns, const CellRow<ScalarOf<V>>& row,
                                     const ShapeEdges<P, V>& edges, ColumnOrigins<V>& room) {
  columns.build(row, edges, room);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
