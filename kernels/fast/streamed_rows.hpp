// Rows of whole cache lines that go straight to memory, where two registers are a line.
//
// Streaming stores overlap with arithmetic; copies from staging take their own time. But a line has
// to be stored at once, and memory takes lines at a third to a half of its rate where they leave
// others out, or where several planes come by turns that lie at the same place within a page. So
// the tiles of a row are a band (fast/row_bands.hpp), which is swept plane by plane.
#pragma once

#include "kernels/fast/row_bands.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether there are such rows. Registers of a line stream tile by tile. Normals take so much
/// arithmetic, and six planes at once, that staging is faster.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kStreamsRows = kLineWide<RegisterPair<vec<T>>> &&
                              (kOutputs == detail::kPosition ||
                               kOutputs == detail::kPositionDerivatives);

/// Streams all rows of patches [patch, end), which are whole lines, in groups of two or three
/// lines: one alone would leave out lines.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void stream_rows(const GridTask<T>& task, const RowPiece<T>& piece,
                                 std::size_t patch, std::size_t end) {
  constexpr std::size_t kLine = 64 / sizeof(T);
  if (task.nu == kLine) {
    return sweep_band<kOutputs, 1, false, true>(task, piece, 0, kLine, patch, end);
  }
  std::size_t first = 0;
  if (task.nu / kLine % 2 != 0) {
    sweep_band<kOutputs, 3, false, true>(task, piece, 0, 3 * kLine, patch, end);
    first = 3 * kLine;
  }
  for (; first < task.nu; first += 2 * kLine) {
    sweep_band<kOutputs, 2, false, true>(task, piece, first, first + 2 * kLine, patch, end);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
