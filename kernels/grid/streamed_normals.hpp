// Positions and normals that go straight to memory in rows that are no whole registers, or lie
// across lines: as in grid/streamed_planes.hpp, but all six planes at once, since a normal takes
// all components.
//
// Copies from staging take their time beside the arithmetic, while streaming stores of registers
// overlap with it, which outweighs rows one by one, without their mirror images.
#pragma once

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/value_stream.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether kernels stream such rows. Shorter registers are faster by way of staging, and leave no
/// room for six streams.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kStreamsNormals = kLineWide<vec<T>>&& kOutputs == detail::kPositionNormal;

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// One patch, register by register of its columns. Lanes behind the last column repeat it.
template <typename T>
struct StreamedNormals {
  using V = vec<T>;
  static constexpr std::size_t kMost = detail::kMostStreamedRegisters;
  JetColumns<V, false> columns[kMost][3];
  V floor[kMost];
  NormalSamples<V> lead[kMost];
  NormalSamples<V> trail[kMost];

  SIMDBEZIER_PART void build(const GridTask<T>& task, const RowPiece<T>& piece, std::size_t patch) {
    for (std::size_t k = 0; k * kLanes<V> < task.nu; ++k) {
      const ColumnTile<1, true, false, V> tile(task.x, k * kLanes<V>, kLanes<V>, task.watertight);
      Component<T> component(task, patch, 0);
      for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
        columns[k][c].build(component, tile);
        if (piece.lead) {
          lead[k].jet[c] = columns[k][c].edge(component, tile, edge_of(piece.lead_kind));
        }
        if (piece.trail) {
          trail[k].jet[c] = columns[k][c].edge(component, tile, edge_of(piece.trail_kind));
        }
      }
      if (piece.lead) {
        lead[k].cross();
      }
      if (piece.trail) {
        trail[k].cross();
      }
      floor[k] = floor_inside(tile.column.x, broadcast<V>(task.normal_floor[patch]));
    }
  }

  /// Returns the k-th register of a row that is on no edge.
  SIMDBEZIER_PART NormalSamples<V> interior(std::size_t k, const RowPoint<V>& y) const {
    NormalSamples<V> s;
    for (std::size_t c = 0; c < 3; ++c) {
      s.jet[c] = columns[k][c].interior(y);
    }
    s.cross();
    return s;
  }
};

/// The planes of positions, then those of normals, from sample `at` on.
template <typename T>
struct NormalPlanes {
  T* first[6];

  SIMDBEZIER_PART NormalPlanes(const GridTask<T>& task, std::size_t at) {
    for (std::size_t c = 0; c < 3; ++c) {
      first[c] = task.out[output_index(Output::position)].component[c] + at;
      first[3 + c] = task.out[output_index(Output::normal)].component[c] + at;
    }
  }
};

/// Streams all patches of a task, whose rows have a register and more, and at most
/// kMostStreamedRegisters; its planes begin at the same place within a line. Streams go on from one
/// patch to the next one where a piece is whole patches. A patch with a normal that takes a second
/// look is rare: its streams end behind it, and evaluate(patch) evaluates it anew.
template <typename T, typename Evaluate>
SIMDBEZIER_KERNEL void stream_normals(const GridTask<T>& shared_task, const RowPiece<T>& piece,
                                      const Evaluate& evaluate) {
  using V = vec<T>;
  // A copy, because stores through vector types might change anything that others can see.
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const std::size_t nu = task.nu;
  const std::size_t rows = piece.rows();
  const bool goes_on = rows * nu == task.patch_step;
  const bool outside = piece.middle.kind == RowKind::outside;
  PlaneStreams<V, 6> streams;
  StreamedNormals<T> given;
  bool begun = false;
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    if (task.prefetch) {
      prefetch_patch(task, patch);
    }
    if (!begun) {
      const std::size_t at = patch * task.patch_step + piece.first * nu;
      streams.begin(NormalPlanes<T>(task, at).first);
    }
    given.build(task, piece, patch);
    bool certain = !outside || piece.middle.rows == 0;
    const T* y = piece.middle.y;
    for (std::size_t row = 0; row < rows; ++row) {
      const NormalSamples<V>* const edge = piece.lead && row == 0           ? given.lead
                                           : piece.trail && row + 1 == rows ? given.trail
                                                                            : nullptr;
      const RowPoint<V> point =
          edge == nullptr ? piece.template point<1, V>(y++) : RowPoint<V>(broadcast<V>(T(0)));
      streams.put(nu, [&](std::size_t k, V(&values)[6]) SIMDBEZIER_INLINE_LAMBDA {
        const NormalSamples<V> s = edge == nullptr ? given.interior(k, point) : edge[k];
        certain &= all_of<V>(s.squared > given.floor[k]);
        for (std::size_t c = 0; c < 3; ++c) {
          values[c] = s.jet[c].p;
          values[3 + c] = s.normal[c];
        }
      });
    }
    begun = goes_on && certain && patch + 1 < task.patch_count;
    if (!begun) {
      streams.finish();
    }
    if (!certain) [[unlikely]] {
      evaluate(patch);
    }
  }
}
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
