// A register of samples as records: triples of each group, or one vertex of all; and the one column
// that whole registers leave over in grids of records, lanes being its rows.
#pragma once

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/registers_to_records.hpp"
#include "src/tables/sample_record.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The outputs of kOutputs that kernels put together, in the order of a record. Loops over them are
/// written out: an index that is no constant would keep addresses in memory.
template <detail::OutputSet kOutputs>
struct RecordGroups {
  static constexpr bool kNormals = kOutputs == detail::kPositionNormal;
  static constexpr std::size_t kCount = kOutputs == detail::kPosition ? 1 : kNormals ? 2 : 3;
  static constexpr Output kOutput[3] = {Output::position, kNormals ? Output::normal : Output::du,
                                        Output::dv};
};

/// Where the records of the next row go.
template <detail::OutputSet kOutputs, typename T>
struct RecordPlaces {
  using Groups = RecordGroups<kOutputs>;
  T* to[Groups::kCount]; ///< of each group
  std::size_t record;    ///< as in GridTask
  std::size_t step;      ///< values from one row to the next
  bool streaming;
  const T* column_values; ///< of the register, null where records have none
  const T* row_value;     ///< of the row

  /// The records from sample `at` of the task on, which is at (column, row).
  SIMDBEZIER_PART RecordPlaces(const GridTask<T>& task, std::size_t at, std::size_t column,
                               std::size_t row)
      : record(task.record), step(task.nu * task.record), streaming(task.streaming),
        column_values(nullptr), row_value(nullptr) {
    if (Groups::kNormals && record == detail::kVertexRecord) {
      column_values = task.column_values + column;
      row_value = task.row_values + row;
    }
    repeat<Groups::kCount>([&](std::size_t g) SIMDBEZIER_INLINE_LAMBDA {
      to[g] = task.out[output_index(Groups::kOutput[g])].component[0] + at * record;
    });
  }

  /// Stores a register of samples, `at` values further on. value[3 g + c] is component c of group
  /// g.
  template <typename V>
  SIMDBEZIER_PART void store(const V* value, std::size_t at) const {
    if constexpr (Groups::kNormals) {
      if (column_values != nullptr) {
        V vertex[detail::kVertexRecord] = {value[0],
                                           value[1],
                                           value[2],
                                           value[3],
                                           value[4],
                                           value[5],
                                           load_vector<V>(column_values),
                                           broadcast<V>(*row_value)};
        store_values_across<detail::kVertexRecord>(vertex, to[0] + at, record);
        return;
      }
    }
    if constexpr (Groups::kCount > 1) {
      if (record > 3) {
        LinePart<T> part[3 * Groups::kCount];
        __builtin_memcpy(&part, value, sizeof(part));
        store_records(part, to[0] + at, streaming);
        return;
      }
    }
    repeat<Groups::kCount>([&](std::size_t g) SIMDBEZIER_INLINE_LAMBDA {
      store_triples(value + 3 * g, to[g] + at, streaming);
    });
  }
  SIMDBEZIER_PART void next_row() {
    repeat<Groups::kCount>([&](std::size_t g) SIMDBEZIER_INLINE_LAMBDA { to[g] += step; });
    row_value += column_values != nullptr ? 1 : 0;
  }
};

/// What the rows of one tile have in common.
template <detail::OutputSet kOutputs, typename SomeTile>
struct RecordSweep {
  using V = typename SomeTile::Vector;
  using T = ScalarOf<V>;
  using Groups = RecordGroups<kOutputs>;

  const SomeTile& tile;
  Component<T> component[3];
  JetColumns<V, false> columns[3];

  SIMDBEZIER_PART RecordSweep(const GridTask<T>& task, const SomeTile& the_tile, std::size_t patch)
      : tile(the_tile), component{{task, patch, 0}, component[0].next(), component[1].next()} {
    for (std::size_t c = 0; c < 3; ++c) {
      columns[c].build(component[c], tile);
    }
  }

  /// The values of a register of samples, and what their normals depend on.
  struct RecordValues {
    Jet<V> jet[3];
    V value[3 * Groups::kCount];
    V squared;

    /// Assigns all values, except that normals do not have unit length yet.
    SIMDBEZIER_PART void assign() {
      for (std::size_t c = 0; c < 3; ++c) {
        value[c] = jet[c].p;
        if constexpr (kOutputs == detail::kPositionDerivatives) {
          value[3 + c] = jet[c].du;
          value[6 + c] = jet[c].dv;
        }
      }
      if constexpr (Groups::kNormals) {
        const V du[3] = {jet[0].du, jet[1].du, jet[2].du};
        const V dv[3] = {jet[0].dv, jet[1].dv, jet[2].dv};
        squared = cross_product(du, dv, value + 3);
      }
    }
    SIMDBEZIER_PART void finish() {
      assign();
      if constexpr (Groups::kNormals) {
        normalise(value + 3, squared);
      }
    }
  };
  SIMDBEZIER_PART void interior(const RowPoint<V>& at, RecordValues& s) const {
    for (std::size_t c = 0; c < 3; ++c) {
      s.jet[c] = columns[c].interior(at);
    }
  }
  /// This is interior() at y and at -y.
  SIMDBEZIER_PART void pair(const RowPoint<V>& at, RecordValues& s, RecordValues& mirrored) const {
    for (std::size_t c = 0; c < 3; ++c) {
      columns[c].pair(at, s.jet[c], mirrored.jet[c]);
    }
  }
  SIMDBEZIER_PART void edge(std::size_t edge, RecordValues& s) const {
    for (std::size_t c = 0; c < 3; ++c) {
      s.jet[c] = columns[c].edge(component[c], tile, edge);
    }
  }

  [[nodiscard]] static SIMDBEZIER_PART bool unusual(const RecordValues& s, V floor) {
    if constexpr (Groups::kNormals) {
      return !all_of<V>(s.squared > floor);
    }
    return false;
  }
  /// Takes the second look at unusual normals, after they have been stored.
  SIMDBEZIER_PART void resolve(const GridTask<T>& task, std::size_t patch,
                               const UncertainNormals& which, const RecordValues& s, V y,
                               V floor) const {
    if constexpr (Groups::kNormals) {
      resolve_normals(task, patch, which, tile.column.x, y, s.squared, floor);
    }
  }
};

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
    repeat<Groups::kCount>([&](std::size_t g) SIMDBEZIER_INLINE_LAMBDA {
      store_triples(value + 3 * g, triple[g] + 3 * at, false);
    });
  }
  /// Copies what stands at `row` in here to behind the register `at` values further on than
  /// `places`: the row's last sample.
  SIMDBEZIER_PART void move_to(const RecordPlaces<kOutputs, T>& places, std::size_t at,
                               std::size_t row) const {
    repeat<Groups::kCount>([&](std::size_t g) SIMDBEZIER_INLINE_LAMBDA {
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
