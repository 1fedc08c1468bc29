// One component of one tile: positions, positions with both first derivatives, second derivatives.
#pragma once

#include "kernels/grid/column_tile.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Rows that a buffered column has room for, edges among them.
constexpr std::size_t kBufferRows = kMostMiddleRows + 2;

/// A column's planes, the k-th one kPlane values behind the first: one address for all of them.
template <typename T>
struct ColumnPlanes {
  static constexpr std::size_t kPlane = kBufferRows + 2 * detail::kMaxLanes;
  const T* first;

  SIMDBEZIER_INLINE const T* plane(std::size_t k) const { return first + k * kPlane; }
};

/// A column on its way to the rows' ends: one plane for each of `kPlanes` outputs.
template <typename T, std::size_t kPlanes>
struct ColumnBuffer {
  alignas(64) T values[kPlanes * ColumnPlanes<T>::kPlane];

  /// Where the piece's first row goes: registers of rows behind a lead are lines of the buffer.
  template <typename Piece>
  SIMDBEZIER_INLINE T* first(std::size_t k, const Piece& piece) {
    return values + k * ColumnPlanes<T>::kPlane + (piece.lead ? detail::kMaxLanes - 1 : 0);
  }
  /// The planes to read single values from. Without own_address(), compilers would take them out of
  /// the registers that they came from, which costs more.
  template <typename Piece>
  SIMDBEZIER_INLINE ColumnPlanes<T> planes(const Piece& piece) {
    return {own_address(first(0, piece))};
  }
};

/// The single column behind a tile.
template <typename V>
using SingleColumnTile = ColumnTile<kLanes<V>, true, false, V>;

template <typename Piece, std::size_t kRows, bool kWhole, bool kExtra, typename V, bool kStreams>
SIMDBEZIER_INLINE void sweep_position(const Piece& piece, const Component<ScalarOf<V>>& c,
                                      const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile,
                                      std::size_t nu, ScalarOf<V>* to,
                                      ColumnPlanes<ScalarOf<V>> extra) {
  using Tile = ColumnTile<kRows, kWhole, kExtra, V, kStreams>;
  using T = ScalarOf<V>;
  V q[kOrder];
  if constexpr (Tile::kSingle) {
    single_column_polynomial(c, tile.column, q);
  } else {
    column_polynomial(c, tile.column, q);
  }
  const LocalOrigin<V> origin = column_origin(c, tile.column);
  V shared = tile.column.x; // not used
  if constexpr (Tile::kShared) {
    if (tile.watertight) {
      shared = tile.edge_rows(c, 0);
    }
  }
  constexpr RowOrder kRowOrder{kRows, Tile::kPairs, kRows == 1 ? 4 : 1};
  for_rows<kRowOrder>(
      piece, 0, nu,
      [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
        const V p = Tile::kShared ? shared : tile.edge_rows(c, edge_of(kind));
        tile.store_edge(to + place.at, p, kind, extra.plane(0) + place.row);
      },
      [&](const T* y, RowPlace place, RowPlace mirrored) SIMDBEZIER_INLINE_LAMBDA {
        const auto at = RowPowers<T>::template point<kRows, V>(y);
        const Parts<V> p = value_parts(q, at);
        tile.store(to + place.at, nu, origin.add_to(p.sum()), kRows, extra.plane(0) + place.row);
        tile.store_mirrored(to + mirrored.at, nu, origin.add_to(p.difference()),
                            extra.plane(0) + mirrored.row);
      },
      [&](const T* y, RowPlace place, std::size_t rows) SIMDBEZIER_INLINE_LAMBDA {
        const V p = row_value(q, RowPowers<T>::template point<kRows, V>(y));
        tile.store(to + place.at, nu, origin.add_to(p), rows, extra.plane(0) + place.row);
      });
}

/// Position and first derivatives of one component, a register of samples.
template <typename V>
struct Jet {
  V p;
  V du;
  V dv;
};

/// A register of columns as cubics in Y: one component's positions and u derivatives. kAsks:
/// whether there are origins is found out at run time; there are none otherwise.
template <typename V, bool kAsks = true>
struct JetColumns {
  V q[kOrder];
  V dq[kOrder];
  LocalOrigin<V> origin;

  template <typename SomeTile>
  SIMDBEZIER_INLINE void build(const Component<ScalarOf<V>>& c, const SomeTile& tile) {
    if constexpr (SomeTile::kSingle) {
      single_column_polynomial(c, tile.column, q, dq);
    } else {
      column_polynomial(c, tile.column, q, dq);
    }
    if constexpr (kAsks) {
      origin = column_origin(c, tile.column);
    }
  }
  SIMDBEZIER_INLINE Jet<V> interior(const RowPoint<V>& at) const {
    Jet<V> jet;
    jet.p = row_value(q, at, jet.dv);
    jet.du = row_value(dq, at);
    if constexpr (kAsks) {
      jet.p = origin.add_to(jet.p);
    }
    return jet;
  }
  /// The same at -y as well.
  SIMDBEZIER_INLINE void pair(const RowPoint<V>& at, Jet<V>& jet, Jet<V>& mirrored) const {
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
  /// On the edge v = const number `edge`, or on both where they share a register.
  template <typename SomeTile>
  SIMDBEZIER_INLINE Jet<V> edge(Component<ScalarOf<V>> c, const SomeTile& tile,
                                std::size_t edge) const {
    if constexpr (!kAsks) {
      c.origins = nullptr;
    }
    Jet<V> jet;
    jet.dv = row_slope(q, RowPoint<V>(tile.edge_y(edge)));
    jet.p = tile.edge_rows(c, edge, jet.du);
    return jet;
  }
};

/// Where the samples of one component go.
template <typename T>
struct JetPlanes {
  T* position;
  T* du;
  T* dv;
};

template <typename Piece, std::size_t kRows, bool kWhole, bool kExtra, typename V, bool kStreams>
SIMDBEZIER_INLINE void sweep_derivatives(const Piece& piece, const Component<ScalarOf<V>>& c,
                                         const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile,
                                         std::size_t nu, const JetPlanes<ScalarOf<V>>& to,
                                         ColumnPlanes<ScalarOf<V>> extra) {
  using Tile = ColumnTile<kRows, kWhole, kExtra, V, kStreams>;
  using T = ScalarOf<V>;
  JetColumns<V> columns;
  columns.build(c, tile);
  Jet<V> shared;
  if constexpr (Tile::kShared) {
    if (tile.watertight) {
      shared = columns.edge(c, tile, 0);
    }
  }
  constexpr RowOrder kRowOrder{kRows, Tile::kPairs, Piece::kKnown ? 2 : 1};
  for_rows<kRowOrder>(
      piece, 0, nu,
      [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
        const Jet<V> jet = Tile::kShared ? shared : columns.edge(c, tile, edge_of(kind));
        tile.store_edge(to.position + place.at, jet.p, kind, extra.plane(0) + place.row);
        tile.store_edge(to.du + place.at, jet.du, kind, extra.plane(1) + place.row);
        tile.store_edge(to.dv + place.at, jet.dv, kind, extra.plane(2) + place.row);
      },
      [&](const T* y, RowPlace place, RowPlace mirror) SIMDBEZIER_INLINE_LAMBDA {
        Jet<V> jet;
        Jet<V> mirrored;
        columns.pair(RowPowers<T>::template point<kRows, V>(y), jet, mirrored);
        tile.store(to.position + place.at, nu, jet.p, kRows, extra.plane(0) + place.row);
        tile.store(to.du + place.at, nu, jet.du, kRows, extra.plane(1) + place.row);
        tile.store(to.dv + place.at, nu, jet.dv, kRows, extra.plane(2) + place.row);
        tile.store_mirrored(to.position + mirror.at, nu, mirrored.p, extra.plane(0) + mirror.row);
        tile.store_mirrored(to.du + mirror.at, nu, mirrored.du, extra.plane(1) + mirror.row);
        tile.store_mirrored(to.dv + mirror.at, nu, mirrored.dv, extra.plane(2) + mirror.row);
      },
      [&](const T* y, RowPlace place, std::size_t rows) SIMDBEZIER_INLINE_LAMBDA {
        const Jet<V> jet = columns.interior(RowPowers<T>::template point<kRows, V>(y));
        tile.store(to.position + place.at, nu, jet.p, rows, extra.plane(0) + place.row);
        tile.store(to.du + place.at, nu, jet.du, rows, extra.plane(1) + place.row);
        tile.store(to.dv + place.at, nu, jet.dv, rows, extra.plane(2) + place.row);
      });
}

/// Groups with null planes are computed and dropped.
template <std::size_t kRows, bool kWhole, bool kExtra, typename V, bool kStreams>
SIMDBEZIER_INLINE void sweep_second(const GridTask<ScalarOf<V>>& task,
                                    const RowPiece<ScalarOf<V>>& piece,
                                    const Component<ScalarOf<V>>& c,
                                    const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile,
                                    std::size_t component, std::size_t first) {
  using Tile = ColumnTile<kRows, kWhole, kExtra, V, kStreams>;
  using T = ScalarOf<V>;
  SecondColumns<V> columns;
  columns.build(c, tile.column);
  T* const duu = task.out[detail::kDuuGroup].component[component];
  T* const duv = task.out[detail::kDuvGroup].component[component];
  T* const dvv = task.out[detail::kDvvGroup].component[component];
  const std::size_t nu = task.nu;
  constexpr RowOrder kRowOrder{kRows, Tile::kPairs, 1};
  for_rows<kRowOrder>(
      piece, first, nu,
      [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
        const std::size_t edge = edge_of(kind);
        const RowPoint<V> y(tile.edge_y(edge));
        tile.store_edge_if_wanted(duu, place.at, tile.edge_rows_second(c, edge), kind);
        tile.store_edge_if_wanted(duv, place.at, columns.duv(y), kind);
        tile.store_edge_if_wanted(dvv, place.at, columns.dvv(y), kind);
      },
      [&](const T* y, RowPlace place, RowPlace mirrored) SIMDBEZIER_INLINE_LAMBDA {
        const auto at = RowPowers<T>::template point<kRows, V>(y);
        const auto put = [&](T* plane, V here, V there) SIMDBEZIER_INLINE_LAMBDA {
          tile.store_if_wanted(plane, place.at, nu, here, kRows);
          tile.store_mirrored_if_wanted(plane, mirrored.at, nu, there);
        };
        const Parts<V> uu = columns.duu_parts(at);
        const Parts<V> uv = columns.duv_parts(at);
        const Parts<V> vv = columns.half_dvv_parts(at);
        put(duu, uu.sum(), uu.difference());
        put(duv, uv.sum(), uv.difference());
        put(dvv, vv.sum() + vv.sum(), vv.difference() + vv.difference());
      },
      [&](const T* y, RowPlace place, std::size_t rows) SIMDBEZIER_INLINE_LAMBDA {
        const auto at = RowPowers<T>::template point<kRows, V>(y);
        tile.store_if_wanted(duu, place.at, nu, columns.duu(at), rows);
        tile.store_if_wanted(duv, place.at, nu, columns.duv(at), rows);
        tile.store_if_wanted(dvv, place.at, nu, columns.dvv(at), rows);
      });
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
