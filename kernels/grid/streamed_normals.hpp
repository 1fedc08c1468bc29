// Positions and normals that go straight to memory in order, where grid/streamed_planes.hpp does so
// for other outputs: all six planes at once, since a normal takes all components.
//
// Copies from staging add their time to that of the arithmetic, while streaming stores of registers
// overlap with it, which is worth more than what pairs of mirrored rows save.
#pragma once

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/value_stream.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether kernels stream such rows. Shorter registers are faster by way of staging, and leave no
/// room for six streams.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kStreamsNormals = kLineWide<vec<T>>&& kOutputs == detail::kPositionNormal;

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// A register of a patch's columns. Lanes behind the last column repeat it.
template <typename T>
struct NormalColumns {
  using V = vec<T>;
  JetColumns<V, false> component[3];
  V floor;

  SIMDBEZIER_PART void build(const GridTask<T>& task, std::size_t patch, std::size_t k) {
    const ColumnTile<1, true, false, V> tile = tile_of(task, k);
    Component<T> given(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, given = given.next()) {
      component[c].build(given, tile);
    }
    floor = floor_inside(tile.column.x, broadcast<V>(task.normal_floor[patch]));
  }
  SIMDBEZIER_PART NormalSamples<V> interior(const RowPoint<V>& y) const {
    NormalSamples<V> s;
    for (std::size_t c = 0; c < 3; ++c) {
      s.jet[c] = component[c].interior(y);
    }
    s.cross();
    return s;
  }
  /// build() has had the same arguments.
  SIMDBEZIER_PART NormalSamples<V> edge(const GridTask<T>& task, std::size_t patch, std::size_t k,
                                        std::size_t edge) const {
    const ColumnTile<1, true, false, V> tile = tile_of(task, k);
    NormalSamples<V> s;
    Component<T> given(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, given = given.next()) {
      s.jet[c] = component[c].edge(given, tile, edge);
    }
    s.cross();
    return s;
  }

private:
  static SIMDBEZIER_PART ColumnTile<1, true, false, V> tile_of(const GridTask<T>& task,
                                                               std::size_t k) {
    return {task.x, k * kLanes<V>, kLanes<V>, task.watertight};
  }
};

/// A row of a piece that is streamed.
template <typename T>
struct StreamedRow {
  std::size_t edge; ///< v = const that it is on, or kEdges
  const T* y;       ///< of a row that is on none, of RowPowers

  SIMDBEZIER_PART StreamedRow(const RowPiece<T>& piece, std::size_t row)
      : edge(piece.lead && row == 0                   ? edge_of(piece.lead_kind)
             : piece.trail && row + 1 == piece.rows() ? edge_of(piece.trail_kind)
                                                      : kEdges),
        y(edge < kEdges ? nullptr : piece.middle.y + (row - (piece.lead ? 1 : 0))) {}

  [[nodiscard]] SIMDBEZIER_PART bool is_edge() const { return edge < kEdges; }
};

/// The registers of a patch with normals that take a second look: bit k of a row is its k-th
/// register.
struct UncertainRegisters {
  static_assert(detail::kMostStreamedRegisters <= 16);
  std::uint16_t row[kMostMiddleRows + 2];
};

/// Streams one patch, and returns whether all of its normals are certain.
template <typename T>
SIMDBEZIER_KERNEL bool stream_normals(const GridTask<T>& task, const RowPiece<T>& piece,
                                      std::size_t patch, PlaneStreams<vec<T>, 6>& streams,
                                      UncertainRegisters& uncertain) {
  using V = vec<T>;
  NormalColumns<T> columns[detail::kMostStreamedRegisters];
  for (std::size_t k = 0; k * kLanes<V> < task.nu; ++k) {
    columns[k].build(task, patch, k);
  }
  const bool outside = piece.middle.kind == RowKind::outside;
  PlaneStreams<V, 6> stream = streams; // in registers
  bool certain = true;
  for (std::size_t j = 0; j < piece.rows(); ++j) {
    const StreamedRow<T> row(piece, j);
    const RowPoint<V> y =
        row.is_edge() ? RowPoint<V>(broadcast<V>(T(0))) : piece.template point<1, V>(row.y);
    unsigned doubts = 0;
    stream.put(task.nu, [&](std::size_t k, V(&values)[6]) SIMDBEZIER_INLINE_LAMBDA {
      const NormalSamples<V> s =
          row.is_edge() ? columns[k].edge(task, patch, k, row.edge) : columns[k].interior(y);
      const bool passed = all_of<V>(s.squared > columns[k].floor);
      doubts |= (passed && (!outside || row.is_edge()) ? 0U : 1U) << k;
      for (std::size_t c = 0; c < 3; ++c) {
        values[c] = s.jet[c].p;
        values[3 + c] = s.normal[c];
      }
    });
    uncertain.row[j] = static_cast<std::uint16_t>(doubts);
    certain = certain && doubts == 0;
  }
  streams = stream;
  return certain;
}

/// Looks again at the normals of a patch that has been streamed.
template <typename T>
SIMDBEZIER_RARE void resolve_streamed(const GridTask<T>& task, const RowPiece<T>& piece,
                                      std::size_t patch, const UncertainRegisters& uncertain) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  GridTask<T> plain = task;
  assume<Known::no_origins>(plain);
  for (std::size_t k = 0; k * kL < task.nu; ++k) {
    NormalColumns<T> columns;
    columns.build(plain, patch, k);
    for (std::size_t j = 0; j < piece.rows(); ++j) {
      if ((uncertain.row[j] >> k & 1U) == 0) {
        continue;
      }
      const StreamedRow<T> row(piece, j);
      const bool outside = !row.is_edge() && piece.middle.kind == RowKind::outside;
      const V y =
          row.is_edge() ? ColumnTile<1, true, false, V>::edge_y(row.edge) : broadcast<V>(*row.y);
      const NormalSamples<V> s = row.is_edge()
                                     ? columns.edge(plain, patch, k, row.edge)
                                     : columns.interior(piece.template point<1, V>(row.y));
      const std::size_t at = patch * task.patch_step + (piece.first + j) * task.nu + k * kL;
      const std::size_t active = task.nu - k * kL < kL ? task.nu - k * kL : kL;
      resolve_normals(task, patch, UncertainNormals{0, kL, active, 1, at, task.nu, 1},
                      load_vector<V>(task.x + k * kL), y, s.squared,
                      outside ? no_floor<V>() : columns.floor);
    }
  }
}

/// Streams all patches of a task, whose rows have a register and more, and at most
/// kMostStreamedRegisters; its planes begin at the same place within a line. Streams go on from one
/// patch to the next one where a piece is whole patches, but end behind patches with uncertain
/// normals, whose second look stores them once more.
template <typename T>
SIMDBEZIER_KERNEL void stream_normals(const GridTask<T>& shared_task, const RowPiece<T>& piece) {
  // A copy, because stores through vector types might change anything that others can see.
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const bool goes_on = piece.rows() * task.nu == task.patch_step;
  PlaneStreams<vec<T>, 6> streams;
  UncertainRegisters uncertain;
  bool begun = false;
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    if (task.prefetch) {
      prefetch_patch(task, patch);
    }
    if (!begun) {
      const std::size_t at = patch * task.patch_step + piece.first * task.nu;
      T* first[6];
      for (std::size_t c = 0; c < 3; ++c) {
        first[c] = task.out[output_index(Output::position)].component[c] + at;
        first[3 + c] = task.out[output_index(Output::normal)].component[c] + at;
      }
      streams.begin(first);
    }
    const bool certain = stream_normals(task, piece, patch, streams, uncertain);
    begun = goes_on && certain && patch + 1 < task.patch_count;
    if (!begun) {
      streams.finish();
    }
    if (!certain) [[unlikely]] {
      resolve_streamed(shared_task, piece, patch, uncertain);
    }
  }
}
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
