// All three components of one tile and their cross product.
#pragma once

#include "kernels/grid/tile_components.hpp"
#include "kernels/poly/normal_lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// One register of samples.
template <typename V>
struct NormalSamples {
  Jet<V> jet[3];
  V normal[3];
  V squared;

  SIMDBEZIER_INLINE void cross() {
    const V du[3] = {jet[0].du, jet[1].du, jet[2].du};
    const V dv[3] = {jet[0].dv, jet[1].dv, jet[2].dv};
    squared = cross_product(du, dv, normal);
    normalise(normal, squared);
  }
};

/// What the rows of one tile have in common; kAny: groups with null planes are computed and
/// dropped.
template <std::size_t kRows, bool kWhole, bool kExtra, bool kAny, bool kAsks, typename V,
          bool kStreams>
struct NormalSweep {
  using T = ScalarOf<V>;

  const GridTask<T>& task;
  const GridTask<T>& shared_task; ///< the same, whose address may leave
  const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile;
  std::size_t patch;
  std::size_t status_step; ///< statuses from one sample of the planes to the next
  ColumnPlanes<T> extra;   ///< positions, then normals
  Component<T> component[3];
  JetColumns<V, kAsks> columns[3];

  SIMDBEZIER_INLINE
  NormalSweep(const GridTask<T>& the_task, const GridTask<T>& the_shared_task,
              const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& the_tile, std::size_t the_patch,
              std::size_t the_status_step, ColumnPlanes<T> the_extra)
      : task(the_task), shared_task(the_shared_task), tile(the_tile), patch(the_patch),
        status_step(the_status_step),
        extra(the_extra), component{
                              {the_task, the_patch, 0}, component[0].next(), component[1].next()} {
    for (std::size_t c = 0; c < 3; ++c) {
      columns[c].build(component[c], tile);
    }
  }

  SIMDBEZIER_INLINE void interior(const T* y, std::size_t at, std::size_t row, std::size_t rows,
                                  V floor) const {
    const V row_y = RowGroups<kRows, V>::spread(y);
    V du[3];
    V dv[3];
    for (std::size_t c = 0; c < 3; ++c) {
      const Jet<V> jet = columns[c].interior(row_y);
      du[c] = jet.du;
      dv[c] = jet.dv;
      if constexpr (kAny) {
        tile.store_if_wanted(plane(detail::kPositionGroup, c), at, task.nu, jet.p, rows);
        tile.store_if_wanted(plane(detail::kDuGroup, c), at, task.nu, du[c], rows);
        tile.store_if_wanted(plane(detail::kDvGroup, c), at, task.nu, dv[c], rows);
      } else {
        tile.store(plane(detail::kPositionGroup, c) + at, task.nu, jet.p, rows,
                   extra.plane(c) + row);
      }
    }
    if (kAny && !task.out[detail::kNormalGroup].wanted()) {
      return;
    }
    V n[3];
    const V squared = cross_product(du, dv, n);
    normalise(n, squared);
    for (std::size_t c = 0; c < 3; ++c) {
      tile.store(plane(detail::kNormalGroup, c) + at, task.nu, n[c], rows,
                 extra.plane(3 + c) + row);
    }
    if (!all_of<V>(squared > floor)) [[unlikely]] {
      resolve_normals(shared_task, patch,
                      Suspects{0, tile.kColumns, tile.active, rows, at, task.nu, status_step},
                      tile.column.x, row_y, squared, floor);
    }
  }

  /// On the edge v = const number `edge`, or on both where they share a register.
  SIMDBEZIER_INLINE NormalSamples<V> edge(std::size_t edge) const {
    NormalSamples<V> s;
    for (std::size_t c = 0; c < 3; ++c) {
      s.jet[c] = columns[c].edge(component[c], tile, edge);
    }
    s.cross();
    return s;
  }

  SIMDBEZIER_INLINE void store_edge(const NormalSamples<V>& s, RowKind kind, std::size_t at,
                                    std::size_t row, V floor) const {
    for (std::size_t c = 0; c < 3; ++c) {
      if constexpr (kAny) {
        tile.store_edge_if_wanted(plane(detail::kPositionGroup, c), at, s.jet[c].p, kind);
        tile.store_edge_if_wanted(plane(detail::kDuGroup, c), at, s.jet[c].du, kind);
        tile.store_edge_if_wanted(plane(detail::kDvGroup, c), at, s.jet[c].dv, kind);
        tile.store_edge_if_wanted(plane(detail::kNormalGroup, c), at, s.normal[c], kind);
      } else {
        tile.store_edge(plane(detail::kPositionGroup, c) + at, s.jet[c].p, kind,
                        extra.plane(c) + row);
        tile.store_edge(plane(detail::kNormalGroup, c) + at, s.normal[c], kind,
                        extra.plane(3 + c) + row);
      }
    }
    if (kAny && !task.out[detail::kNormalGroup].wanted()) {
      return;
    }
    if (!all_of<V>(s.squared > floor)) [[unlikely]] {
      resolve_normals(
          shared_task, patch,
          Suspects{tile.edge_lane(kind), tile.kColumns, tile.active, 1, at, task.nu, status_step},
          tile.column.x, tile.edge_y(edge_of(kind)), s.squared, floor);
    }
  }

private:
  SIMDBEZIER_INLINE T* plane(std::size_t group, std::size_t c) const {
    return task.out[group].component[c];
  }
};

template <bool kAny, bool kAsks, typename Piece, std::size_t kRows, bool kWhole, bool kExtra,
          typename V, bool kStreams>
SIMDBEZIER_INLINE void sweep_normals(const GridTask<ScalarOf<V>>& task,
                                     const GridTask<ScalarOf<V>>& shared_task, const Piece& piece,
                                     const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile,
                                     std::size_t patch, std::size_t first, std::size_t status_step,
                                     ColumnPlanes<ScalarOf<V>> extra) {
  using T = ScalarOf<V>;
  const NormalSweep<kRows, kWhole, kExtra, kAny, kAsks, V, kStreams> sweep(
      task, shared_task, tile, patch, status_step, extra);
  const V floor = floor_inside(tile.column.x, broadcast<V>(task.normal_floor[patch]));
  const V middle_floor = piece.middle.kind == RowKind::outside ? no_floor<V>() : floor;
  NormalSamples<V> shared;
  if constexpr (ColumnTile<kRows, kWhole, kExtra, V, kStreams>::kShared) {
    if (tile.watertight) {
      shared = sweep.edge(0);
    }
  }
  for_rows<kRows>(
      piece, first, task.nu,
      [&](RowKind kind, std::size_t at, std::size_t row) SIMDBEZIER_INLINE_LAMBDA {
        if constexpr (ColumnTile<kRows, kWhole, kExtra, V, kStreams>::kShared) {
          sweep.store_edge(shared, kind, at, row, floor);
        } else {
          sweep.store_edge(sweep.edge(edge_of(kind)), kind, at, row, floor);
        }
      },
      [&](const T* y, std::size_t at, std::size_t row, std::size_t rows)
          SIMDBEZIER_INLINE_LAMBDA { sweep.interior(y, at, row, rows, middle_floor); });
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
