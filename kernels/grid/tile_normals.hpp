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

  SIMDBEZIER_PART void cross() {
    const V du[3] = {jet[0].du, jet[1].du, jet[2].du};
    const V dv[3] = {jet[0].dv, jet[1].dv, jet[2].dv};
    squared = cross_product(du, dv, normal);
    normalise(normal, squared);
  }
};

/// What the rows of one tile have in common; kAny: groups with null planes are computed and
/// dropped.
///
/// Compilers may keep polynomials in memory if a loop over components indexes them. That leaves a
/// sixth of the speed in WebAssembly and, by g++ 12, for SSE2. Doubles of AVX2 lose 8 % if the loop
/// is written out.
template <std::size_t kRows, bool kWhole, bool kExtra, bool kAny, bool kAsks, typename V,
          bool kStreams>
struct NormalSweep {
  using T = ScalarOf<V>;

  const GridTask<T>& task;
  const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile;
  std::size_t status_step; ///< statuses from one sample of the planes to the next
  ColumnPlanes<T> extra;   ///< positions, then normals
  DoubtfulSamples<T>& doubts;
  Component<T> component[3];
  JetColumns<V, kAsks> columns[3];

  SIMDBEZIER_INLINE
  NormalSweep(const GridTask<T>& the_task,
              const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& the_tile, std::size_t the_patch,
              std::size_t the_status_step, ColumnPlanes<T> the_extra,
              DoubtfulSamples<T>& the_doubts)
      : task(the_task), tile(the_tile), status_step(the_status_step), extra(the_extra),
        doubts(the_doubts), component{{the_task, the_patch, 0},
                                      component[0].next(),
                                      component[1].next()} {
    for_components<kCompactShapes>(
        [&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA { columns[c].build(component[c], tile); });
  }

  SIMDBEZIER_PART void interior(const T* y, RowPlace place, std::size_t rows, V floor) const {
    const auto at = RowPowers<T>::template point<kRows, V>(y);
    Tangents tangents;
    for (std::size_t c = 0; c < 3; ++c) {
      store_jet<false>(c, columns[c].interior(at), place, rows, tangents);
    }
    finish<false>(tangents, y, place, rows, floor);
  }
  /// Sweeps kRows rows and their mirror images.
  SIMDBEZIER_PART void pair(const T* y, RowPlace place, RowPlace mirror, V floor) const {
    const auto at = RowPowers<T>::template point<kRows, V>(y);
    Tangents tangents;
    Tangents mirrored_tangents;
    for (std::size_t c = 0; c < 3; ++c) {
      Jet<V> jet;
      Jet<V> mirrored;
      columns[c].pair(at, jet, mirrored);
      store_jet<false>(c, jet, place, kRows, tangents);
      store_jet<true>(c, mirrored, mirror, kRows, mirrored_tangents);
    }
    finish<false>(tangents, y, place, kRows, floor);
    finish<true>(mirrored_tangents, y, mirror, kRows, floor);
  }

  /// Evaluates the edge v = const number `edge`, or both where they share a register.
  SIMDBEZIER_PART NormalSamples<V> edge(std::size_t edge) const {
    NormalSamples<V> s;
    for_components<kCompactShapes>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      s.jet[c] = columns[c].edge(component[c], tile, edge);
    });
    s.cross();
    return s;
  }

  SIMDBEZIER_PART void store_edge(const NormalSamples<V>& s, RowKind kind, std::size_t at,
                                  std::size_t row, V floor) const {
    for (std::size_t c = 0; c < 3; ++c) {
      if constexpr (kAny) {
        tile.store_edge_if_wanted(plane(Output::position, c), at, s.jet[c].p, kind);
        tile.store_edge_if_wanted(plane(Output::du, c), at, s.jet[c].du, kind);
        tile.store_edge_if_wanted(plane(Output::dv, c), at, s.jet[c].dv, kind);
        tile.store_edge_if_wanted(plane(Output::normal, c), at, s.normal[c], kind);
      } else {
        tile.store_edge(plane(Output::position, c) + at, s.jet[c].p, kind, extra.plane(c) + row);
        tile.store_edge(plane(Output::normal, c) + at, s.normal[c], kind, extra.plane(3 + c) + row);
      }
    }
    if (kAny && !task.out[output_index(Output::normal)].wanted()) {
      return;
    }
    if (!all_of<V>(s.squared > floor)) [[unlikely]] {
      doubts.add(UncertainNormals{tile.edge_lane(kind), tile.kColumns, tile.active, 1, at, task.nu,
                                  status_step},
                 tile.column.x, tile.edge_y(edge_of(kind)), s.squared, floor);
    }
  }

private:
  /// The tangents of one register of samples.
  struct Tangents {
    V du[3];
    V dv[3];
  };

  /// Stores one component. kMirrored says that rows come from `place` back.
  template <bool kMirrored>
  SIMDBEZIER_PART void store_jet(std::size_t c, const Jet<V>& jet, RowPlace place, std::size_t rows,
                                 Tangents& tangents) const {
    tangents.du[c] = jet.du;
    tangents.dv[c] = jet.dv;
    store_rows<kMirrored>(Output::position, c, 0, jet.p, place, rows);
    if constexpr (kAny) {
      store_rows<kMirrored>(Output::du, c, 0, jet.du, place, rows);
      store_rows<kMirrored>(Output::dv, c, 0, jet.dv, place, rows);
    }
  }

  /// Stores the normals of rows whose other outputs have been stored.
  template <bool kMirrored>
  SIMDBEZIER_PART void finish(const Tangents& tangents, const T* y, RowPlace place,
                              std::size_t rows, V floor) const {
    if (kAny && !task.out[output_index(Output::normal)].wanted()) {
      return;
    }
    V n[3];
    const V squared = cross_product(tangents.du, tangents.dv, n);
    normalise(n, squared);
    for (std::size_t c = 0; c < 3; ++c) {
      store_rows<kMirrored>(Output::normal, c, 3, n[c], place, rows);
    }
    if (!all_of<V>(squared > floor)) [[unlikely]] {
      const std::size_t row_step = kMirrored ? std::size_t{0} - task.nu : task.nu;
      const V row_y = RowPowers<T>::template parameters<kRows, V>(y);
      doubts.add(
          UncertainNormals{0, tile.kColumns, tile.active, rows, place.at, row_step, status_step},
          tile.column.x, kMirrored ? -row_y : row_y, squared, floor);
    }
  }

  /// first is the plane of the column behind the tile that belongs to component 0.
  template <bool kMirrored>
  SIMDBEZIER_PART void store_rows(Output output, std::size_t c, std::size_t first, V value,
                                  RowPlace place, std::size_t rows) const {
    T* const to = plane(output, c);
    if (kAny && to == nullptr) {
      return;
    }
    const T* const behind = extra.plane(first + c) + place.row;
    if constexpr (kMirrored) {
      tile.store_mirrored(to + place.at, task.nu, value, behind);
    } else {
      tile.store(to + place.at, task.nu, value, rows, behind);
    }
  }

  SIMDBEZIER_PART T* plane(Output output, std::size_t c) const {
    return task.out[output_index(output)].component[c];
  }
};

/// shared_task: the task, whose address may leave.
template <bool kAny, bool kAsks, typename Piece, std::size_t kRows, bool kWhole, bool kExtra,
          typename V, bool kStreams>
SIMDBEZIER_PART void sweep_normals(const GridTask<ScalarOf<V>>& task,
                                   const GridTask<ScalarOf<V>>& shared_task, const Piece& piece,
                                   const ColumnTile<kRows, kWhole, kExtra, V, kStreams>& tile,
                                   std::size_t patch, std::size_t first, std::size_t status_step,
                                   ColumnPlanes<ScalarOf<V>> extra) {
  using ThisTile = ColumnTile<kRows, kWhole, kExtra, V, kStreams>;
  using T = ScalarOf<V>;
  DoubtfulSamples<T> doubts(shared_task, patch);
  const NormalSweep<kRows, kWhole, kExtra, kAny, kAsks, V, kStreams> sweep(
      task, tile, patch, status_step, extra, doubts);
  const V floor = floor_inside(tile.column.x, broadcast<V>(task.normal_floor[patch]));
  const V middle_floor = piece.middle.kind == RowKind::outside ? no_floor<V>() : floor;
  NormalSamples<V> shared;
  if constexpr (ThisTile::kShared) {
    if (tile.watertight) {
      shared = sweep.edge(0);
    }
  }
  constexpr RowOrder kRowOrder{kRows, ThisTile::kNormalPairs ? RowPairs::always : RowPairs::never,
                               1};
  for_rows<kRowOrder>(
      piece, first, task.nu,
      [&](RowKind kind, RowPlace place) SIMDBEZIER_INLINE_LAMBDA {
        if constexpr (ThisTile::kShared) {
          sweep.store_edge(shared, kind, place.at, place.row, floor);
        } else {
          sweep.store_edge(sweep.edge(edge_of(kind)), kind, place.at, place.row, floor);
        }
      },
      [&](const T* y, RowPlace place, RowPlace mirrored)
          SIMDBEZIER_INLINE_LAMBDA { sweep.pair(y, place, mirrored, middle_floor); },
      [&](const T* y, RowPlace place, std::size_t rows)
          SIMDBEZIER_INLINE_LAMBDA { sweep.interior(y, place, rows, middle_floor); });
  if (doubts.any()) [[unlikely]] {
    doubts.resolve();
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
