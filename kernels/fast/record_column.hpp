// Computes the one column that whole registers leave over in grids of records: lanes are its rows.
#pragma once

#include "kernels/fast/record_samples.hpp"
#include "kernels/grid/patch_sweeps.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The single column behind whole registers on its way to the rows' ends, in triples of each group:
/// the edges v = const, which share a register, then the rows between them.
template <detail::OutputSet kOutputs, typename V>
struct RecordColumn {
  using T = ScalarOf<V>;
  using Groups = RecordGroups<kOutputs>;
  static constexpr std::size_t kRows = kBufferRows + 2 * kLanes<V>;
  alignas(64) T triple[Groups::kCount][3 * kRows];

  /// These two return where a row stands in here.
  static SIMDBEZIER_PART std::size_t edge(std::size_t edge) {
    return edge == detail::kEdgeV0 ? 0 : kLanes<V> / 2;
  }
  static SIMDBEZIER_PART std::size_t middle(std::size_t row) { return kLanes<V> + row; }

  SIMDBEZIER_PART void store(const V* value, std::size_t at) {
    Groups::for_each([&](std::size_t g) SIMDBEZIER_INLINE_LAMBDA {
      store_triples(value + 3 * g, triple[g] + 3 * at, false);
    });
  }
  /// Copies what stands at `row` in here to behind the register `at` values further on than
  /// `places`: the row's last sample.
  SIMDBEZIER_PART void move_to(const RecordPlaces<kOutputs, T>& places, std::size_t at,
                               std::size_t row) const {
    Groups::for_each([&](std::size_t g) SIMDBEZIER_INLINE_LAMBDA {
      __builtin_memcpy(places.to[g] + at + kLanes<V> * places.record, triple[g] + 3 * row,
                       3 * sizeof(T));
    });
    if (places.column_values != nullptr) {
      T* const behind = places.to[0] + at + kLanes<V> * places.record + 6;
      behind[0] = places.column_values[kLanes<V>];
      behind[1] = *places.row_value;
    }
  }

  /// Sweeps the rows of `piece`, whose first one begins with sample `at` of the task.
  SIMDBEZIER_KERNEL void sweep(const GridTask<T>& task, const RowPiece<T>& piece,
                               const SingleColumnTile<V>& tile, std::size_t patch, std::size_t at) {
    using Sweep = RecordSweep<kOutputs, SingleColumnTile<V>>;
    const Sweep sweep(task, tile, patch);
    const V floor = floor_inside(tile.column.x, broadcast<V>(task.normal_floor[patch]));
    const auto resolve = [&](const typename Sweep::RecordValues& s, V y, V limit, std::size_t row,
                             std::size_t lane, std::size_t stored,
                             std::size_t rows) SIMDBEZIER_INLINE_LAMBDA {
      if (Sweep::unusual(s, limit)) [[unlikely]] {
        GridTask<T> part = task;
        part.status = task.status == nullptr ? nullptr : task.status + at + row * task.nu;
        for (std::size_t c = 0; c < 3; ++c) {
          part.out[output_index(Output::normal)].component[c] =
              triple[Groups::kCount - 1] + 3 * stored + c;
        }
        sweep.resolve(part, patch, UncertainNormals{lane, 1, 1, rows, 0, 1, task.nu, 3}, s, y,
                      limit);
      }
    };
    typename Sweep::RecordValues s;
    if (piece.lead || piece.trail) {
      const V y = tile.edge_y(0);
      sweep.edge(0, s);
      s.finish();
      store(s.value, 0);
      const auto look = [&](RowKind kind, std::size_t row) SIMDBEZIER_INLINE_LAMBDA {
        resolve(s, y, floor, row, edge(edge_of(kind)), edge(edge_of(kind)), 1);
      };
      if (piece.lead) {
        look(piece.lead_kind, 0);
      }
      if (piece.trail) {
        look(piece.trail_kind, piece.rows() - 1);
      }
    }
    const V limit = piece.middle.kind == RowKind::outside ? no_floor<V>() : floor;
    for (std::size_t row = 0; row < piece.middle.rows; row += kLanes<V>) {
      const std::size_t left = piece.middle.rows - row;
      const V y = RowGroups<kLanes<V>, V>::spread(piece.middle.y + row);
      sweep.interior(RowPoint<V>(y), s);
      s.finish();
      store(s.value, middle(row));
      resolve(s, y, limit, row + (piece.lead ? 1 : 0), 0, middle(row),
              left < kLanes<V> ? left : kLanes<V>);
    }
  }
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
