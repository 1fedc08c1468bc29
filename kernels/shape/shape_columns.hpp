// Turns the packed values of a patch into a register of its columns, as polynomials in the local Y.
#pragma once

#include <algorithm>

#include "kernels/shape/column_polynomials.hpp"
#include "kernels/shape/shape_edges.hpp"
#include "kernels/simd/quads.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename P, typename V>
class ShapeColumns {
  using T = ScalarOf<V>;
  using Powers = typename ColumnPolynomials<P, V>::Powers;
  static constexpr std::size_t kDepth = P::kDepth;
  /// Powers at once where the compiler does not know how many there are: enough to hide the latency
  /// of Horner's rule, few enough for 16 registers. Positions have code for every number up to 8,
  /// since columns of high degrees are most of their work, as far as the number of columns makes
  /// it usual: 16 of them are two registers or one.
  template <bool kMixed>
  static constexpr bool kAnyNumber =
      kDepth == 0 && !P::kWeighted && !kCompactShapes && (!kMixed || kLanes<V> == 16);

public:
  using Edges = ShapeEdges<P, V>;

  SIMDBEZIER_PART ShapeColumns(const NetShape& shape, const CellColumns<V>& columns,
                               std::size_t first_component)
      : shape_(P::shape(shape)), columns_(columns), slots_(shape_, first_component),
        order_u_(shape_.order_u()), order_v_(shape_.order_v()),
        abreast_(shape_.order_v() < 4 ? 2 : even_share(shape_.order_v(), 8)) {}

  /// Builds the columns in one row of cells, to which `edges` belong. room lives as long as they
  /// are used.
  SIMDBEZIER_PART void build(const CellRow<T>& row, const Edges& edges, ColumnOrigins<V>& room) {
    origins_ = nullptr;
    if (edges.has_origins() || edges.has_points()) [[unlikely]] {
      edges.find_origins(room);
      origins_ = &room;
    }
    if (any_low() && any_high()) {
      build_slots<true>(row.low, row.high);
    } else {
      const Cell<T>& cell = any_low() ? row.low : row.high;
      build_slots<false>(cell, cell);
    }
  }

  /// build() of lanes in any cells of any patches, off the edges u = const: those of lane i have
  /// coefficients from from[i] on. Lanes are powers of Y first, those of a sample side by side in
  /// 128 bits, which are then turned. Reads up to so many bits behind the last coefficient, where
  /// the edges stand. origins may be null. Calls built(slot) for each channel that is there.
  template <typename Built>
  SIMDBEZIER_INLINE void build_mixed(const T* const from[kLanes<V>],
                                     const ColumnOrigins<V>* origins, const Built& built) {
    constexpr std::size_t kN = kQuad<V>;
    static_assert(P::OrderV::kMost % kN == 0);
    origins_ = origins;
    V x[kN];
    split_groups<kQuad<V>>(columns_.local.x, x);
    slots_.for_channels([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      Powers& power = polynomials_.power[slot];
      const auto put = [&](Series<V>& s, std::size_t l) SIMDBEZIER_INLINE_LAMBDA {
        put_series(s, [&](std::size_t derivative, V value)
                          SIMDBEZIER_INLINE_LAMBDA { power[derivative][l] = value; });
      };
      const auto turn = [&](std::size_t l) SIMDBEZIER_INLINE_LAMBDA {
        repeat<kDepth + 1>([&](std::size_t derivative)
                               SIMDBEZIER_INLINE_LAMBDA { lane_transpose(power[derivative] + l); });
      };
      const std::size_t matrix = slots_.channel(slot) * shape_.matrix();
      if constexpr (P::OrderU::kMost == 4 && P::OrderV::kMost == 4) { // lines of 64 bytes
        constexpr std::size_t kParts = 4 / kN;
        repeat<kN>([&](std::size_t group) SIMDBEZIER_INLINE_LAMBDA {
          V c[kParts][4];
          repeat<kParts>([&](std::size_t line) SIMDBEZIER_INLINE_LAMBDA {
            const T* at[kQuads<V>];
            repeat<kQuads<V>>([&](std::size_t q) SIMDBEZIER_INLINE_LAMBDA {
              at[q] = from[q * kN + group] + matrix + line * 4 * kN;
            });
            load_quads<V>(at, c[line]);
          });
          repeat<kParts>([&](std::size_t part) SIMDBEZIER_INLINE_LAMBDA {
            Series<V> s;
            horner_rows<kDepth, 1>(
                order_u_, x + group,
                [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
                  const std::size_t at = k * kParts + part;
                  return c[at / 4][at % 4];
                },
                &s);
            put(s, part * kN + group);
          });
        });
        repeat<kParts>([&](std::size_t part) SIMDBEZIER_INLINE_LAMBDA { turn(part * kN); });
      } else {
        for (std::size_t l = 0; l < order_v_.value(); l += kN) {
          repeat<kN>([&](std::size_t group) SIMDBEZIER_INLINE_LAMBDA {
            const T* const first = from[group];
            const auto load = [&](const T* c, std::size_t /*i*/) SIMDBEZIER_INLINE_LAMBDA {
              return quads_at<V>([&](std::size_t q) SIMDBEZIER_INLINE_LAMBDA {
                return from[q * kN + group] + (c - first);
              });
            };
            Series<V> s;
            horner_series_abreast<kDepth, 1>(order_u_, x[group], first + matrix + l,
                                             order_v_.value(), load, &s);
            put(s, l + group);
          });
          turn(l);
        }
      }
      built(slot);
    });
  }

  /// This is build_mixed() of lanes in one patch, which is one cell.
  template <typename Built>
  SIMDBEZIER_INLINE void build_inside(const T* coefficients, const ColumnOrigins<V>* origins,
                                      const Built& built) {
    origins_ = origins;
    const auto load = [](const T* c, std::size_t i)
                          SIMDBEZIER_INLINE_LAMBDA { return broadcast<V>(c[i]); };
    slots_.for_channels([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
      const T* const matrix = coefficients + slots_.channel(slot) * shape_.matrix();
      build_powers<P::OrderV::kMost>(
          matrix, load, [](Series<V>*) SIMDBEZIER_INLINE_LAMBDA {}, polynomials_.power[slot][0]);
      built(slot);
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
  /// Builds all slots. kMixed says that some lanes are in the low cell, and some in the high one;
  /// else all are in `low`.
  template <bool kMixed>
  SIMDBEZIER_PART void build_slots(const Cell<T>& low, const Cell<T>& high) {
    const auto run = [&]<std::size_t kCount>()
                         SIMDBEZIER_INLINE_LAMBDA { build_runs<kMixed, kCount>(low, high); };
    if constexpr (P::kKnown) {
      run.template operator()<P::OrderV::kMost>();
    } else if constexpr (kAnyNumber<kMixed>) {
      with_one_of<2, 4, 5, 6, 7, 8>(abreast_, run);
    } else {
      with_one_of<2, 4>(abreast_ < 4 ? 2 : 4, run);
    }
  }

  /// Builds all powers of Y, kCount at once; the last ones may be computed twice.
  template <bool kMixed, std::size_t kCount>
  SIMDBEZIER_INLINE void build_runs(const Cell<T>& low, const Cell<T>& high) {
    const std::size_t order_v = order_v_.value();
    const std::size_t matrix = shape_.matrix();
    const std::size_t edges = shape_.edge_powers() * 4;
    for (std::size_t l = 0; l < order_v; l += kCount) {
      const std::size_t first = std::min(l, order_v - kCount);
      slots_.for_channels([&](std::size_t slot) SIMDBEZIER_INLINE_LAMBDA {
        const std::size_t channel = slots_.channel(slot);
        build_slot<kMixed, kCount>(low, high, channel * matrix + first, channel * edges + first * 4,
                                   first, polynomials_.power[slot]);
      });
    }
  }

  /// Builds the powers [first, first + kCount) of Y of one slot, of which coefficients and edges
  /// stand at these places of its cells.
  template <bool kMixed, std::size_t kCount>
  SIMDBEZIER_INLINE void build_slot(const Cell<T>& low, const Cell<T>& high, std::size_t matrix_at,
                                    std::size_t edges_at, std::size_t first, Powers& to) const {
    const T* const matrix = low.coefficients + matrix_at;
    const T* const edges = low.edges + edges_at;
    const std::ptrdiff_t matrix_to_high = high.coefficients - low.coefficients;
    const std::ptrdiff_t edges_to_high = high.edges - low.edges;
    const auto load = [&](const T* c, std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
      if constexpr (kMixed) {
        // Behind the last coefficient stand the edges, so that whole tables can be read.
        return select_entry<V>(columns_.low, c, c + matrix_to_high, i);
      } else {
        return broadcast<V>(c[i]);
      }
    };
    const auto replace = [&](Series<V>* s) SIMDBEZIER_INLINE_LAMBDA {
      if constexpr (kMixed) {
        replace_each<kCount>(s, [&](V inside, std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
          const T* const pair = edges + i * 4 + detail::kEdgeU0;
          const PairSelector<V>& selector = columns_.local.edges;
          return select_where<V>(columns_.low, selector.replace(inside, pair),
                                 selector.replace(inside, pair + edges_to_high));
        });
      } else {
        replace_each<kCount>(s, [&](V inside, std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
          return columns_.local.edges.replace(inside, edges + i * 4 + detail::kEdgeU0);
        });
      }
    };
    build_powers<kCount>(matrix, load, replace, to[0] + first);
  }

  /// Puts in replaced(value, i) where lanes are on an edge.
  template <std::size_t kCount, typename Replaced>
  SIMDBEZIER_INLINE void replace_each(Series<V>* s, const Replaced& replaced) const {
    if (columns_.local.on_edge) {
      repeat<kCount>([&](std::size_t i)
                         SIMDBEZIER_INLINE_LAMBDA { s[i].value = replaced(s[i].value, i); });
    }
  }
  /// Builds kCount powers of Y. replace(s) puts in what is on an edge.
  template <std::size_t kCount, typename Load, typename Replace>
  SIMDBEZIER_INLINE void build_powers(const T* matrix, const Load& load, const Replace& replace,
                                      V* at) const {
    Series<V> s[kCount];
    horner_series_abreast<kDepth, kCount>(order_u_, columns_.local.x, matrix, order_v_.value(),
                                          load, s);
    replace(s);
    if constexpr (!P::kKnown) { // else they would not be in registers
      at = own_address(at);
    }
    repeat<kCount>([&](std::size_t i) SIMDBEZIER_INLINE_LAMBDA {
      put_series(s[i], [&](std::size_t derivative, V value) SIMDBEZIER_INLINE_LAMBDA {
        at[derivative * P::OrderV::kMost + i] = value;
      });
    });
  }

  /// Calls put(derivative, value) for each power's value and derivatives by u.
  template <typename Put>
  SIMDBEZIER_INLINE void put_series(Series<V>& s, const Put& put) const {
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
  std::size_t abreast_; ///< equal parts of the powers, 2 or 4 to 8 of them
  const ColumnOrigins<V>* origins_ = nullptr;
  ColumnPolynomials<P, V> polynomials_;
};

/// This is ShapeColumns::build() as a function, which grids and scattered samples share: for plans
/// whose loops have polynomials in memory anyway.
template <typename P, typename V>
SIMDBEZIER_KERNEL void build_columns(ShapeColumns<P, V>& columns, const CellRow<ScalarOf<V>>& row,
                                     const ShapeEdges<P, V>& edges, ColumnOrigins<V>& room) {
  columns.build(row, edges, room);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
