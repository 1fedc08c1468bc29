// One component of one tile: positions, positions with both first derivatives, second derivatives.
#pragma once

#include "kernels/grid/jet_columns.hpp"
#include "kernels/grid/plane_rows.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A buffered column has room for so many rows, edges among them.
constexpr std::size_t kBufferRows = kMostMiddleRows + 2;

/// A column's planes, the k-th one kPlane values behind the first: one address for all of them.
template <typename T>
struct ColumnPlanes {
  using Plane = const T*;
  static constexpr std::size_t kPlane = kBufferRows + 2 * detail::kMaxLanes;
  const T* first;

  SIMDBEZIER_PART const T* plane(std::size_t k) const { return first + k * kPlane; }
};

/// A column on its way to the rows' ends: one plane for each of `kPlanes` outputs.
template <typename T, std::size_t kPlanes>
struct ColumnBuffer {
  alignas(64) T values[kPlanes * ColumnPlanes<T>::kPlane];

  /// Returns where the first row of the piece goes. Registers of rows behind a lead are lines of
  /// the buffer.
  template <typename Piece>
  SIMDBEZIER_PART T* first(std::size_t k, const Piece& piece) {
    return values + k * ColumnPlanes<T>::kPlane + (piece.lead ? detail::kMaxLanes - 1 : 0);
  }
  /// Returns the planes to read single values from. Without own_address(), compilers would take
  /// them out of the registers that they came from, which costs more.
  template <typename Piece>
  SIMDBEZIER_PART ColumnPlanes<T> planes(const Piece& piece) {
    return {own_address(first(0, piece))};
  }
};

/// The single column behind a tile.
template <typename V>
using SingleColumnTile = ColumnTile<kLanes<V>, true, false, V>;

/// Sweeps one component's positions. extra is the column behind the tile, ColumnPlanes or
/// SquareColumn.
template <typename Piece, std::size_t kRows, bool kWhole, bool kExtra, typename V, bool kStreams,
          typename To, typename Extra>
SIMDBEZIER_INLINE void sweep_position(const Piece& piece, const Component<ScalarOf<V>>& c,
                                      const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile,
                                      std::size_t nu, To to, const Extra& extra) {
  using ThisTile = ColumnTile<kRows, kWhole, kExtra, V, kStreams>;
  using T = ScalarOf<V>;
  V q[kOrder];
  if constexpr (ThisTile::kSingle) {
    single_column_polynomial(c, tile.column, q);
  } else {
    column_polynomial(c, tile.column, q);
  }
  const LocalOrigin<V> origin = column_origin(c, tile.column);
  V shared = tile.column.x; // not used
  if constexpr (ThisTile::kShared) {
    if (tile.watertight) {
      shared = tile.edge_rows(c, 0);
    }
  }
  PlaneRows<Piece, ThisTile, typename Extra::Plane, To> plane(tile, to, nu, extra.plane(0));
  if constexpr (kSweepsLines<Piece, ThisTile>) {
    plane.borders(shared, row_value(q, piece.shared.rows[0]));
    for_inner_rows(piece, nu, [&](const T* y, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
      plane.rows(row_value(q, piece.template point<kRows, V>(y)), place, kRows);
    });
    return;
  }
  constexpr RowOrder kRowOrder{kRows, Piece::kAcross ? RowPairs::never : ThisTile::kPairs,
                               kRows == 1 ? 4 : 1};
  for_rows<kRowOrder>(
      piece, 0, nu,
      [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
        plane.edge(ThisTile::kShared ? shared : tile.edge_rows(c, edge_of(kind)), kind, place);
      },
      [&](const T* y, RowPlace place, RowPlace mirrored) SIMDBEZIER_INLINE_LAMBDA {
        const auto at = piece.template point<kRows, V>(y);
        const Parts<V> p = value_parts(q, at);
        plane.rows(origin.add_to(p.sum()), place, kRows);
        plane.mirrored(origin.add_to(p.difference()), mirrored);
      },
      [&](const T* y, RowPlace place, std::size_t rows) SIMDBEZIER_INLINE_LAMBDA {
        const V p = row_value(q, piece.template point<kRows, V>(y));
        plane.rows(origin.add_to(p), place, rows);
      });
  plane.finish();
}

/// Where the samples of one component go: to values, or on with streams of lines.
template <typename T, typename To = T*>
struct JetPlanes {
  To position;
  To du;
  To dv;
};

/// The rows of one component on their way to its three planes.
template <typename Piece, typename SomeTile, typename Plane, typename To, typename V>
struct JetRows {
  using Rows = PlaneRows<Piece, SomeTile, Plane, To>;
  Rows position;
  Rows du;
  Rows dv;

  SIMDBEZIER_INLINE void borders(const Jet<V>& edges, const Jet<V>& beside) {
    position.borders(edges.p, beside.p);
    du.borders(edges.du, beside.du);
    dv.borders(edges.dv, beside.dv);
  }
  SIMDBEZIER_INLINE void rows(const Jet<V>& jet, RowPlace place, std::size_t rows) {
    position.rows(jet.p, place, rows);
    du.rows(jet.du, place, rows);
    dv.rows(jet.dv, place, rows);
  }
  SIMDBEZIER_INLINE void mirrored(const Jet<V>& jet, RowPlace place) {
    position.mirrored(jet.p, place);
    du.mirrored(jet.du, place);
    dv.mirrored(jet.dv, place);
  }
  SIMDBEZIER_INLINE void edge(const Jet<V>& jet, RowKind kind, RowPlace place) {
    position.edge(jet.p, kind, place);
    du.edge(jet.du, kind, place);
    dv.edge(jet.dv, kind, place);
  }
  SIMDBEZIER_INLINE void finish() {
    position.finish();
    du.finish();
    dv.finish();
  }
};

/// Whether a tile sweeps the planes of derivatives one after the other, each of which has fewer
/// polynomials: squares of floats whose rows are no whole registers, which one tile of at least a
/// line covers. There are no origins.
template <typename Piece, typename SomeTile>
constexpr bool kGoesPlaneByPlane = false;
template <std::size_t kSide, typename SomeTile>
constexpr bool kGoesPlaneByPlane<SquarePiece<float, kSide, false>, SomeTile> =
    SomeTile::kTileRows == 1 && kSide % kLanes<vec<float>> != 0 &&
    kSide <= SomeTile::kColumns + (SomeTile::kBuffered ? 1 : 0) &&
    SomeTile::kColumns * sizeof(float) >= 64;

/// Sweeps one plane; parts_of(y) returns the parts of the rows at y.
template <RowOrder kRowOrder, typename Piece, typename Rows, typename Edge, typename PartsOf>
SIMDBEZIER_INLINE void sweep_plane(const Piece& piece, std::size_t nu, Rows& plane,
                                   const Edge& edge, const PartsOf& parts_of) {
  for_rows<kRowOrder>(
      piece, 0, nu, edge,
      [&](const auto* y, RowPlace place, RowPlace mirror) SIMDBEZIER_INLINE_LAMBDA {
        const auto parts = parts_of(y);
        plane.rows(parts.sum(), place, kRowOrder.rows);
        plane.mirrored(parts.difference(), mirror);
      },
      [&](const auto* y, RowPlace place, std::size_t rows)
          SIMDBEZIER_INLINE_LAMBDA { plane.rows(parts_of(y).sum(), place, rows); });
}

/// Sweeps one component's positions and first derivatives; extra is the column behind the tile, as
/// in sweep_position().
template <typename Piece, std::size_t kRows, bool kWhole, bool kExtra, typename V, bool kStreams,
          typename To, typename Extra>
SIMDBEZIER_INLINE void sweep_derivatives(const Piece& piece, const Component<ScalarOf<V>>& c,
                                         const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile,
                                         std::size_t nu, const JetPlanes<ScalarOf<V>, To>& to,
                                         const Extra& extra) {
  using ThisTile = ColumnTile<kRows, kWhole, kExtra, V, kStreams>;
  using T = ScalarOf<V>;
  JetColumns<V> columns;
  columns.build(c, tile);
  Jet<V> shared;
  if constexpr (ThisTile::kShared) {
    if (tile.watertight) {
      shared = columns.edge(c, tile, 0);
    }
  }
  JetRows<Piece, ThisTile, typename Extra::Plane, To, V> to_planes{
      {tile, to.position, nu, extra.plane(0)},
      {tile, to.du, nu, extra.plane(1)},
      {tile, to.dv, nu, extra.plane(2)}};
  if constexpr (kSweepsLines<Piece, ThisTile>) {
    to_planes.borders(shared, columns.interior(piece.shared.rows[0]));
    for_inner_rows(piece, nu, [&](const T* y, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
      to_planes.rows(columns.interior(piece.template point<kRows, V>(y)), place, kRows);
    });
    return;
  }
  constexpr RowOrder kRowOrder{kRows, Piece::kAcross ? RowPairs::never : ThisTile::kPairs,
                               Piece::kKnown ? 2 : 1};
  if constexpr (kGoesPlaneByPlane<Piece, ThisTile>) {
    const auto put_edge = [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
      to_planes.edge(columns.edge(c, tile, edge_of(kind)), kind, place);
    };
    const auto stored = [](RowKind /*kind*/, RowPlace /*place*/) SIMDBEZIER_INLINE_LAMBDA {};
    sweep_plane<kRowOrder>(piece, nu, to_planes.position, put_edge,
                           [&](const T* y) SIMDBEZIER_INLINE_LAMBDA {
                             return value_parts(columns.q, piece.template point<kRows, V>(y));
                           });
    sweep_plane<kRowOrder>(piece, nu, to_planes.du, stored,
                           [&](const T* y) SIMDBEZIER_INLINE_LAMBDA {
                             return value_parts(columns.dq, piece.template point<kRows, V>(y));
                           });
    sweep_plane<kRowOrder>(piece, nu, to_planes.dv, stored,
                           [&](const T* y) SIMDBEZIER_INLINE_LAMBDA {
                             return slope_parts(columns.q, piece.template point<kRows, V>(y));
                           });
    return;
  }
  for_rows<kRowOrder>(
      piece, 0, nu,
      [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
        to_planes.edge(ThisTile::kShared ? shared : columns.edge(c, tile, edge_of(kind)), kind,
                       place);
      },
      [&](const T* y, RowPlace place, RowPlace mirror) SIMDBEZIER_INLINE_LAMBDA {
        Jet<V> jet;
        Jet<V> mirrored;
        columns.pair(piece.template point<kRows, V>(y), jet, mirrored);
        to_planes.rows(jet, place, kRows);
        to_planes.mirrored(mirrored, mirror);
      },
      [&](const T* y, RowPlace place, std::size_t rows) SIMDBEZIER_INLINE_LAMBDA {
        to_planes.rows(columns.interior(piece.template point<kRows, V>(y)), place, rows);
      });
  to_planes.finish();
}

/// Sweeps one component's second derivatives; those with null planes are computed and dropped.
template <std::size_t kRows, bool kWhole, bool kExtra, typename V, bool kStreams>
SIMDBEZIER_PART void sweep_second(const GridTask<ScalarOf<V>>& task,
                                  const RowPiece<ScalarOf<V>>& piece,
                                  const Component<ScalarOf<V>>& c,
                                  const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile,
                                  std::size_t component, std::size_t first) {
  using ThisTile = ColumnTile<kRows, kWhole, kExtra, V, kStreams>;
  using T = ScalarOf<V>;
  SecondColumns<V> columns;
  columns.build(c, tile.column);
  T* const duu = task.out[output_index(Output::duu)].component[component];
  T* const duv = task.out[output_index(Output::duv)].component[component];
  T* const dvv = task.out[output_index(Output::dvv)].component[component];
  const std::size_t nu = task.nu;
  constexpr RowOrder kRowOrder{kRows, ThisTile::kOwnLines ? RowPairs::always : RowPairs::never, 1};
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
        const auto at = piece.template point<kRows, V>(y);
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
        const auto at = piece.template point<kRows, V>(y);
        tile.store_if_wanted(duu, place.at, nu, columns.duu(at), rows);
        tile.store_if_wanted(duv, place.at, nu, columns.duv(at), rows);
        tile.store_if_wanted(dvv, place.at, nu, columns.dvv(at), rows);
      });
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
