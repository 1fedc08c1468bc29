// Positions and normals that go straight to memory in order, where fast/streamed_planes.hpp does so
// for other outputs: all six planes at once, since a normal takes all components.
//
// Copies from staging add their time to that of the arithmetic, while streaming stores of registers
// overlap with it, which is worth more than what pairs of mirrored rows save.
#pragma once

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/line_stream.hpp"

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

/// The registers of a patch with normals that take a second look: bit k of a row is its k-th
/// register.
struct UncertainRegisters {
  static_assert(detail::kMostStreamedRegisters <= 16);
  std::uint16_t row[kMostMiddleRows + 2];
};

/// Streams one patch, and returns whether all of its normals are certain. behind: the single column
/// behind its registers. kOneRegister: there is no more before it, which the compiler knows.
template <bool kOneRegister, typename T>
SIMDBEZIER_KERNEL bool stream_patch(const GridTask<T>& task, const RowPiece<T>& piece,
                                    std::size_t patch, const ColumnPlanes<T>& behind,
                                    LineStream<vec<T>, true, 6>& streams,
                                    UncertainRegisters& uncertain) {
  using V = vec<T>;
  const ColumnSplit<V> split(kOneRegister ? kLanes<V> + 1 : task.nu); // known, if so
  NormalColumns<T> columns[kOneRegister ? 1 : detail::kMostStreamedRegisters];
  for (std::size_t k = 0; k < split.registers(); ++k) {
    columns[k].build(task, patch, k);
  }
  LineStream<V, true, 6> stream = streams; // in registers
  unsigned any_doubts = 0;
  // samples(k): the k-th register of a row.
  const auto put_row = [&](std::size_t row, bool doubtful,
                           const auto& samples) SIMDBEZIER_INLINE_LAMBDA {
    unsigned doubts = 0;
    const auto find = [&](std::size_t k, V(&values)[6]) SIMDBEZIER_INLINE_LAMBDA {
      const NormalSamples<V> s = samples(k);
      const bool passed = all_of<V>(s.squared > columns[k].floor);
      doubts |= (passed && !doubtful ? 0U : 1U) << k;
      for (std::size_t c = 0; c < 3; ++c) {
        values[c] = s.jet[c].p;
        values[3 + c] = s.normal[c];
      }
    };
    V values[6];
    for (std::size_t k = 0; k < split.whole_registers(); ++k) {
      find(k, values);
      stream.put(values);
    }
    if (split.rest > 0) {
      find(split.whole_registers(), values);
      stream.put_first(values, split.rest);
    }
    if (split.single) {
      stream.put_value(behind.first + row, ColumnPlanes<T>::kPlane);
    }
    uncertain.row[row] = static_cast<std::uint16_t>(doubts);
    any_doubts |= doubts;
  };
  const auto put_edge = [&](std::size_t row, RowKind kind) SIMDBEZIER_INLINE_LAMBDA {
    put_row(row, false, [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
      return columns[k].edge(task, patch, k, edge_of(kind));
    });
  };
  std::size_t row = 0;
  if (piece.lead) {
    put_edge(row++, piece.lead_kind);
  }
  const bool outside = piece.middle.kind == RowKind::outside;
  for (std::size_t j = 0; j < piece.middle.rows; ++j) {
    const RowPoint<V> y = piece.template point<1, V>(piece.middle.y + j);
    put_row(row++, outside,
            [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return columns[k].interior(y); });
  }
  if (piece.trail) {
    put_edge(row, piece.trail_kind);
  }
  streams = stream;
  return any_doubts == 0;
}

/// Looks again at the normals of a patch that has been streamed.
template <typename T>
SIMDBEZIER_RARE void resolve_streamed(const GridTask<T>& task, const RowPiece<T>& piece,
                                      std::size_t patch, const UncertainRegisters& uncertain) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  GridTask<T> plain = task;
  assume<Known::no_origins>(plain);
  for (std::size_t k = 0; k < ColumnSplit<V>(task.nu).registers(); ++k) {
    NormalColumns<T> columns;
    columns.build(plain, patch, k);
    for (std::size_t j = 0; j < piece.rows(); ++j) {
      if ((uncertain.row[j] >> k & 1U) == 0) {
        continue;
      }
      const bool leads = piece.lead && j == 0;
      const bool is_edge = leads || (piece.trail && j + 1 == piece.rows());
      const bool outside = !is_edge && piece.middle.kind == RowKind::outside;
      V y;
      NormalSamples<V> s;
      if (is_edge) {
        const std::size_t edge = edge_of(leads ? piece.lead_kind : piece.trail_kind);
        y = ColumnTile<1, true, false, V>::edge_y(edge);
        s = columns.edge(plain, patch, k, edge);
      } else {
        const T* const at = piece.middle.y + (j - (piece.lead ? 1 : 0));
        y = broadcast<V>(*at);
        s = columns.interior(piece.template point<1, V>(at));
      }
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
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const bool goes_on = piece.rows() * task.nu == task.patch_step;
  GridTask<T> column_task = task;
  ColumnBuffer<T, 6> buffer;
  put_into_buffer(column_task, piece, buffer);
  const ColumnPlanes<T> behind = buffer.planes(piece);
  const ColumnSplit<vec<T>> split(task.nu);
  const SingleColumnTile<vec<T>> column(task.x, task.nu - 1, 1, task.watertight);
  const auto stream =
      split.single && split.whole_registers() == 1 ? stream_patch<true, T> : stream_patch<false, T>;
  T* first[6];
  LineStream<vec<T>, true, 6> streams;
  UncertainRegisters uncertain;
  bool begun = false;
  PagesAhead<T> pages(shared_task, piece);
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    pages.come_to(patch);
    if (task.prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * task.nu;
    if (!begun) {
      for (std::size_t c = 0; c < 3; ++c) {
        first[c] = task.out[output_index(Output::position)].component[c] + at;
        first[3 + c] = task.out[output_index(Output::normal)].component[c] + at;
      }
      streams.begin(first);
    }
    if (split.single) {
      if (task.status != nullptr) {
        column_task.status = task.status + at + task.nu - 1;
      }
      sweep_normals<false, false>(column_task, column_task, piece, column, patch, 0, task.nu,
                                  behind);
    }
    const bool certain = stream(task, piece, patch, behind, streams, uncertain);
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
