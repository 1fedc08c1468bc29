// Rows of one tile that go straight to memory: each plane is a stream of whole lines
// (simd/line_stream.hpp), which goes on from patch to patch.
// They overlap with the arithmetic, as grid/streamed_planes.hpp says.
#pragma once

#include <type_traits>
#include <utility>

#include "kernels/fast/square_pieces.hpp"
#include "kernels/grid/patch_sweeps.hpp"
#include "kernels/simd/register_pair.hpp"
#include "kernels/simd/value_stream.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX2) || defined(SIMDBEZIER_KERNELS_AVX512)
/// Streams all patches of a task, whose rows are as wide as the tile and the column behind it.
/// across: the piece once more, as one whose rows lie across lines.
template <detail::OutputSet kOutputs, typename SomeTile, typename Across, typename T>
SIMDBEZIER_KERNEL void stream_tile(const GridTask<T>& shared_task, const RowPiece<T>& piece,
                                   const Across& across) {
  using V = vec<T>;
  using Stream = LineStream<V, true>;
  constexpr std::size_t kPlanes = kOutputs == detail::kPosition ? 1 : 3;
  constexpr Output kPlaneOutputs[] = {Output::position, Output::du, Output::dv};
  // A copy, because stores through vector types might change anything that others can see.
  GridTask<T> task = shared_task;
  assume<Known::no_origins>(task);
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

/// The one tile that is as wide as rows of kColumns, which are no whole registers.
template <typename V, std::size_t kColumns>
using StreamedTile =
    std::conditional_t<kColumns == kLanes<V> + 1, ColumnTile<1, true, true, V>,
                       std::conditional_t<(kColumns < kLanes<V>), ColumnTile<1, false, false, V>,
                                          ColumnTile<1, false, false, RegisterPair<V>>>>;

/// Whether rows of so many columns never come here, because staging is faster: 9 floats on AVX2.
template <typename T, std::size_t kColumns>
constexpr bool kIsStaged = !kLineWide<vec<T>> && kColumns * sizeof(T) < 40;

/// Whether squares of this side are streamed by straight code: those whose rows are a part of a
/// line, but more than half of it. AVX2 is faster in a loop for 15 x 15 derivatives. PatchKernels
/// of src/choice/kernel_choice.hpp has such squares streamed where rows of their length are not.
template <detail::OutputSet kOutputs, typename T, std::size_t kSide>
constexpr bool kStreamsSquare = (kSide * sizeof(T) > 32) && (kSide * sizeof(T) < 64) &&
                                !kIsStaged<T, kSide> &&
                                (kLineWide<vec<T>> || kSide != 15 || kOutputs == detail::kPosition);

/// Streams the patches of a task if they are squares of one of these sides, which have straight
/// code, and returns whether they are. It is up to 1.25 times as fast as loops over their few rows.
template <detail::OutputSet kOutputs, std::size_t... kSides, typename T>
SIMDBEZIER_PART bool stream_square_of(std::index_sequence<kSides...>, const GridTask<T>& task,
                                      const RowPiece<T>& piece) {
  const auto stream =
      [&]<std::size_t kSide>(std::integral_constant<std::size_t, kSide>) SIMDBEZIER_INLINE_LAMBDA {
        if constexpr (kStreamsSquare<kOutputs, T, kSide>) {
          using Square = SquarePiece<T, kSide, true>;
          if (task.watertight && Square::is(piece, task.nu)) {
            stream_tile<kOutputs, StreamedTile<vec<T>, kSide>>(task, piece, Square(piece.middle.y));
            return true;
          }
        }
        return false;
      };
  return (stream(std::integral_constant<std::size_t, kSides>{}) || ...);
}
using StreamedSides = std::index_sequence<5, 6, 7, 9, 10, 11, 12, 13, 14, 15>;

/// Streams the patches of a task if one tile is as wide as their rows, which are no whole
/// registers, and returns whether it is. Parts of a register are tiles where it is a line.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool stream_tiles(const GridTask<T>& task, const RowPiece<T>& piece) {
  using V = vec<T>;
  using W = RegisterPair<V>;
  constexpr std::size_t kL = kLanes<V>;
  const std::size_t nu = task.nu;
  if (stream_square_of<kOutputs>(StreamedSides(), task, piece)) {
    return true;
  }
  const AcrossPiece<T> across(piece);
  if constexpr (kLineWide<V>) {
    if (nu < kL) {
      stream_tile<kOutputs, ColumnTile<1, false, false, V>>(task, piece, across);
      return true;
    }
    if (nu == 2 * kL + 1) {
      stream_tile<kOutputs, ColumnTile<1, true, true, W>>(task, piece, across);
      return true;
    }
  }
  if (nu > 2 * kL) {
    return false;
  }
  if constexpr (!kIsStaged<T, kL + 1>) {
    if (nu == kL + 1) {
      stream_tile<kOutputs, ColumnTile<1, true, true, V>>(task, piece, across);
      return true;
    }
  }
  stream_tile<kOutputs, ColumnTile<1, false, false, W>>(task, piece, across);
  return true;
}
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
