// Positions and first derivatives of one component, for a register of columns.
#pragma once

#include <type_traits>

#include "kernels/grid/column_tile.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The position and the first derivatives of one component, a register of samples.
template <typename V>
struct Jet {
  V p;
  V du;
  V dv;
};

/// Evaluates the edge v = const number `edge`, or both where they share a register; q: the tile's
/// columns.
template <typename V, typename SomeTile>
SIMDBEZIER_PART Jet<V> edge_jet(const Component<ScalarOf<V>>& c, const SomeTile& tile,
                                const V (&q)[kOrder], std::size_t edge) {
  Jet<V> jet;
  jet.dv = row_slope(q, RowPoint<V>(tile.edge_y(edge)));
  jet.p = tile.edge_rows(c, edge, jet.du);
  return jet;
}

/// A register of columns as cubics in Y: one component's positions and u derivatives. kAsks says
/// that origins are asked for at run time; there are none otherwise.
template <typename V, bool kAsks = true>
struct JetColumns {
  V q[kOrder];
  V dq[kOrder];
  std::conditional_t<kAsks, LocalOrigin<V>, Nothing> origin;

  template <typename SomeTile>
  SIMDBEZIER_PART void build(const Component<ScalarOf<V>>& c, const SomeTile& tile) {
    if constexpr (SomeTile::kSingle) {
      single_column_polynomial(c, tile.column, q, dq);
    } else {
      column_polynomial(c, tile.column, q, dq);
    }
    if constexpr (kAsks) {
      origin = column_origin(c, tile.column);
    }
  }
  SIMDBEZIER_PART Jet<V> interior(const RowPoint<V>& at) const {
    Jet<V> jet;
    jet.p = row_value(q, at, jet.dv);
    jet.du = row_value(dq, at);
    if constexpr (kAsks) {
      jet.p = origin.add_to(jet.p);
    }
    return jet;
  }
  /// This is interior() at y and at -y.
  SIMDBEZIER_PART void pair(const RowPoint<V>& at, Jet<V>& jet, Jet<V>& mirrored) const {
    Parts<V> slope;
    const Parts<V> value = value_parts(q, at, slope);
    jet.p = value.sum();
    mirrored.p = value.difference();
    jet.dv = slope.sum();
    mirrored.dv = slope.difference();
    const Parts<V> du = value_parts(dq, at);
    jet.du = du.sum();
    mirrored.du = du.difference();
    if constexpr (kAsks) {
      jet.p = origin.add_to(jet.p);
      mirrored.p = origin.add_to(mirrored.p);
    }
  }
  template <typename SomeTile>
  SIMDBEZIER_PART Jet<V> edge(Component<ScalarOf<V>> c, const SomeTile& tile,
                              std::size_t edge) const {
    if constexpr (!kAsks) {
      c.origins = nullptr;
    }
    return edge_jet(c, tile, q, edge);
  }
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
