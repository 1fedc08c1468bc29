// The single column behind a square's tile, in registers.
#pragma once

#include "kernels/grid/tile_components.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// All outputs of such a column, as ColumnBuffer has them in memory. Where stores and loads are
/// many, some have the low bits of their addresses in common, and processors let such loads wait.
template <typename V, std::size_t kSide, std::size_t kPlanes>
struct SquareColumn {
  using Plane = const ColumnLanes<V, kSide>*;
  ColumnLanes<V, kSide> planes[kPlanes];

  SIMDBEZIER_PART Plane plane(std::size_t k) const { return planes + k; }

  template <typename T, bool kAcross>
  SIMDBEZIER_PART void find_position(const SquarePiece<T, kSide, kAcross>& piece,
                                     const Component<T>& c, const SingleColumnTile<V>& tile) {
    V q[kOrder];
    tile_polynomial(c, tile, q);
    planes[0].edges = tile.edge_rows(c, 0);
    for (std::size_t row = 0; row < kSide - 2; row += kLanes<V>) {
      const auto at = RowPowers<T>::template point<kLanes<V>, V>(piece.middle.y + row);
      planes[0].middle[row / kLanes<V>] = row_value(q, at);
    }
  }
  template <typename T, bool kAcross>
  SIMDBEZIER_PART void find_derivatives(const SquarePiece<T, kSide, kAcross>& piece,
                                        const Component<T>& c, const SingleColumnTile<V>& tile) {
    JetColumns<V, false> columns;
    columns.build(c, tile);
    const Jet<V> edges = columns.edge(c, tile, 0);
    planes[0].edges = edges.p;
    planes[1].edges = edges.du;
    planes[2].edges = edges.dv;
    for (std::size_t row = 0; row < kSide - 2; row += kLanes<V>) {
      const auto at = RowPowers<T>::template point<kLanes<V>, V>(piece.middle.y + row);
      const Jet<V> jet = columns.interior(at);
      planes[0].middle[row / kLanes<V>] = jet.p;
      planes[1].middle[row / kLanes<V>] = jet.du;
      planes[2].middle[row / kLanes<V>] = jet.dv;
    }
  }
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
