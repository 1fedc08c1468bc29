// Rows of one tile that go straight to memory: each plane is a stream of whole lines
// (simd/line_stream.hpp), which goes on from patch to patch.
// They overlap with the arithmetic, as fast/streamed_planes.hpp says.
#pragma once

#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/register_pair.hpp"
#include "kernels/simd/value_stream.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_AVX512)
/// Streams all patches of a task, whose rows are as wide as the tile and the column behind it.
template <detail::OutputSet kOutputs, typename SomeTile, typename T>
SIMDBEZIER_KERNEL void stream_tile(const GridTask<T>& shared_task, const RowPiece<T>& piece) {
  using V = vec<T>;
  using Stream = LineStream<V, true>;
  constexpr std::size_t kPlanes = kOutputs == detail::kPosition ? 1 : 3;
  constexpr Output kPlaneOutputs[] = {Output::position, Output::du, Output::dv};
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
  const AcrossPiece<T> across(piece);
  const std::size_t columns = task.nu - (SomeTile::kBuffered ? 1 : 0);
  const SomeTile tile(task.x, 0, columns, task.watertight);
  const SingleColumnTile<V> column(task.x, columns, 1, task.watertight);
  ColumnBuffer<T, kPlanes> buffer;
  const ColumnPlanes<T> behind = buffer.planes(piece);
  const bool goes_on = piece.rows() * task.nu == task.patch_step;
  Stream streams[3 * kPlanes];
  PagesAhead<T> pages(shared_task, piece);
  for (std::size_t patch = 0; patch < task.patch_count; ++patch) {
    pages.come_to(patch);
    if (task.prefetch) {
      prefetch_patch(task, patch);
    }
    const std::size_t at = patch * task.patch_step + piece.first * task.nu;
    Component<T> given(task, patch, 0);
    for (std::size_t c = 0; c < 3; ++c, given = given.next()) {
      Stream* const stream = streams + kPlanes * c;
      if (!goes_on || patch == 0) {
        for (std::size_t k = 0; k < kPlanes; ++k) {
          stream[k] = Stream(task.out[output_index(kPlaneOutputs[k])].component[c] + at);
        }
      }
      if constexpr (kPlanes == 1) {
        if constexpr (SomeTile::kBuffered) {
          sweep_position(piece, given, column, 1, buffer.first(0, piece), behind);
        }
        sweep_position(across, given, tile, task.nu, stream, behind);
      } else {
        if constexpr (SomeTile::kBuffered) {
          const JetPlanes<T> there{buffer.first(0, piece), buffer.first(1, piece),
                                   buffer.first(2, piece)};
          sweep_derivatives(piece, given, column, 1, there, behind);
        }
        const JetPlanes<T, Stream*> to{stream, stream + 1, stream + 2};
        sweep_derivatives(across, given, tile, task.nu, to, behind);
      }
      if (!goes_on || patch + 1 == task.patch_count) {
        for (std::size_t k = 0; k < kPlanes; ++k) {
          stream[k].finish();
        }
      }
    }
  }
}

/// Streams the patches of a task if one tile is as wide as their rows, which are no whole
/// registers, and returns whether it is. Parts of a register are tiles where it is a line.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool stream_tiles(const GridTask<T>& task, const RowPiece<T>& piece) {
  using V = vec<T>;
  using W = RegisterPair<V>;
  constexpr std::size_t kL = kLanes<V>;
  const std::size_t nu = task.nu;
  if constexpr (kLineWide<V>) {
    if (nu < kL) {
      stream_tile<kOutputs, ColumnTile<1, false, false, V>>(task, piece);
      return true;
    }
    if (nu == 2 * kL + 1) {
      stream_tile<kOutputs, ColumnTile<1, true, true, W>>(task, piece);
      return true;
    }
  }
  if (nu > 2 * kL) {
    return false;
  }
  if constexpr (kLineWide<V> || (kL + 1) * sizeof(T) >= 40) { // 9 floats on AVX2 are staged
    if (nu == kL + 1) {
      stream_tile<kOutputs, ColumnTile<1, true, true, V>>(task, piece);
      return true;
    }
  }
  stream_tile<kOutputs, ColumnTile<1, false, false, W>>(task, piece);
  return true;
}
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
