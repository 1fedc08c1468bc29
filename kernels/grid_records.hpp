// Grids past the caches whose samples are records: triples of each group, or one vertex of all.
//
// A register of samples is computed with all its components, put together in registers and streamed
// in whole lines. Staging and a drain would cost a fifth to a third of memory's speed; here
// shuffles and arithmetic take less time than the lines.
#pragma once

#include "kernels/grid_components.hpp"
#include "kernels/grid_prefetch.hpp"
#include "kernels/isa/interleave.hpp"
#include "kernels/normal_lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Of the groups that kernels put together, those of kOutputs, as in a record.
template <detail::OutputSet kOutputs>
struct RecordGroups {
  static constexpr bool kNormals = kOutputs == detail::kPositionNormal;
  static constexpr std::size_t kCount = kOutputs == detail::kPosition ? 1 : kNormals ? 2 : 3;
  static constexpr detail::Group kGroup[3] = {
      detail::kPositionGroup, kNormals ? detail::kNormalGroup : detail::kDuGroup, detail::kDvGroup};
};

/// A register of samples from sample `at` on: value[3 g + c] is component c of group g.
template <detail::OutputSet kOutputs, typename V>
SIMDBEZIER_INLINE void stream_samples(const GridTask<ScalarOf<V>>& task, std::size_t at,
                                      const V* value) {
  using T = ScalarOf<V>;
  using Groups = RecordGroups<kOutputs>;
  const auto first = [&](std::size_t g) SIMDBEZIER_INLINE_LAMBDA {
    return task.out[Groups::kGroup[g]].component[0] + at * task.record;
  };
  if constexpr (Groups::kCount > 1) {
    if (task.record > 3) {
      LinePart<T> part[3 * Groups::kCount];
      __builtin_memcpy(&part, value, sizeof(part));
      store_records<true>(part, first(0));
      return;
    }
  }
  for (std::size_t g = 0; g < Groups::kCount; ++g) {
    LinePart<T> part[3];
    __builtin_memcpy(&part, value + 3 * g, sizeof(part));
    store_records<true>(part, first(g));
  }
}

/// What the rows of one register of columns have in common.
template <detail::OutputSet kOutputs, Scheme kScheme, typename V>
struct RecordSweep {
  using T = ScalarOf<V>;
  using Groups = RecordGroups<kOutputs>;

  const GridTask<T>& task;
  const GridTask<T>& shared_task; ///< the same, whose address may leave
  const Tile<1, true, false, V>& tile;
  std::size_t patch;
  Component<T> component[3];
  JetColumns<kScheme, V> columns[3];

  SIMDBEZIER_INLINE RecordSweep(const GridTask<T>& the_task, const GridTask<T>& the_shared_task,
                                const Tile<1, true, false, V>& the_tile, std::size_t the_patch)
      : task(the_task), shared_task(the_shared_task), tile(the_tile),
        patch(the_patch), component{{the_task, the_patch, 0},
                                    {the_task, the_patch, 1},
                                    {the_task, the_patch, 2}} {
    for (std::size_t c = 0; c < 3; ++c) {
      columns[c].build(component[c], tile);
    }
  }

  SIMDBEZIER_INLINE void interior(V y, Jet<V> jet[3]) const {
    for (std::size_t c = 0; c < 3; ++c) {
      jet[c] = columns[c].interior(y);
    }
  }
  SIMDBEZIER_INLINE void edge(std::size_t edge, Jet<V> jet[3]) const {
    for (std::size_t c = 0; c < 3; ++c) {
      jet[c] = columns[c].edge(component[c], tile, edge);
    }
  }

  /// The samples from `at` on, which lie in row y.
  SIMDBEZIER_INLINE void put(const Jet<V> jet[3], V y, V floor, std::size_t at) const {
    V value[3 * Groups::kCount];
    for (std::size_t c = 0; c < 3; ++c) {
      value[c] = jet[c].p;
      if constexpr (kOutputs == detail::kPositionDerivatives) {
        value[3 + c] = jet[c].du;
        value[6 + c] = jet[c].dv;
      }
    }
    if constexpr (!Groups::kNormals) {
      stream_samples<kOutputs>(task, at, value);
    } else {
      const V du[3] = {jet[0].du, jet[1].du, jet[2].du};
      const V dv[3] = {jet[0].dv, jet[1].dv, jet[2].dv};
      const V squared = cross_product(du, dv, value + 3);
      normalise(value + 3, squared);
      stream_samples<kOutputs>(task, at, value);
      if (!all_of<V>(squared > floor)) [[unlikely]] {
        resolve_normals(shared_task, patch,
                        Suspects{0, kLanes<V>, kLanes<V>, 1, at, 0, 1, task.record}, tile.column.x,
                        y, du[0], du[1], du[2], dv[0], dv[1], dv[2], squared, floor);
      }
    }
  }
};

/// The rows of one patch. One loop for edges and what lies between them: putting records together
/// is most of its code.
template <detail::OutputSet kOutputs, Scheme kScheme, typename V>
SIMDBEZIER_INLINE void
sweep_record_rows(const GridTask<ScalarOf<V>>& task, const GridTask<ScalarOf<V>>& shared_task,
                  const RowPiece<ScalarOf<V>>& piece, const Tile<1, true, false, V>& tile,
                  std::size_t patch, std::size_t at) {
  const RecordSweep<kOutputs, kScheme, V> sweep(task, shared_task, tile, patch);
  const V floor = floor_inside(tile.column.x, broadcast<V>(task.normal_floor[patch]));
  const V middle_floor = piece.middle.kind == RowKind::outside ? no_floor<V>() : floor;
  const ScalarOf<V>* y = piece.middle.y;
  const std::size_t rows = piece.rows();
  for (std::size_t row = 0; row < rows; ++row, at += task.nu) {
    const bool lead = piece.lead && row == 0;
    const bool on_edge = is_watertight(kScheme) && (lead || (piece.trail && row + 1 == rows));
    Jet<V> jet[3];
    V row_y;
    if (on_edge) {
      const std::size_t edge = edge_of(lead ? piece.lead_kind : piece.trail_kind);
      row_y = tile.edge_y(edge);
      sweep.edge(edge, jet);
    } else {
      row_y = broadcast<V>(*y++);
      sweep.interior(row_y, jet);
    }
    sweep.put(jet, row_y, on_edge ? floor : middle_floor, at);
  }
}

/// A register of columns of consecutive patches; as sweep_tile().
template <detail::OutputSet kOutputs, Scheme kScheme, typename T>
__attribute__((noinline)) void
sweep_records(const GridTask<T>& shared_task, const RowPiece<T>& shared_piece,
              std::size_t first_column, std::size_t patch, std::size_t last_patch) {
  using V = vec<T>;
  const GridTask<T> task = shared_task;
  const RowPiece<T> piece = shared_piece;
  const Tile<1, true, false, V> tile(task.x, first_column, kLanes<V>, is_watertight(kScheme));
  const bool prefetch = task.prefetch && first_column == 0;
  for (; patch < last_patch; ++patch) {
    if (prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * task.nu + first_column;
    sweep_record_rows<kOutputs, kScheme>(task, shared_task, piece, tile, patch, at);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
