// Grid kernels: a task is a small grid, or its rows are cut into pieces (grid/row_pieces.hpp), and
// the table of strategies (grid/strategies.hpp) says how each piece is evaluated.
#pragma once

#include "kernels/grid/strategies.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Evaluates a piece: all patches in order, or so many at a time as stay in the first-level cache.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void run_piece(GridTask<T>& task, const RowPiece<T>& piece) {
  if (StrategyList<StreamedOrder<kOutputs, T>>::with_first(
          task,
          [&]<typename InOrder>() SIMDBEZIER_INLINE_LAMBDA { InOrder::sweep(task, piece); })) {
    return;
  }
  const std::size_t cached = kUsual<kOutputs> ? task.cached_bytes : kCachedBytes;
  const std::size_t together = cached / bytes_of<kOutputs>(task, piece) + 1;
  PagesAhead<T> pages(task, piece);
  const auto sweep = [&]<typename Strategy>() SIMDBEZIER_INLINE_LAMBDA {
    for (std::size_t patch = 0; patch < task.patch_count; patch += together) {
      const std::size_t left = task.patch_count - patch;
      const std::size_t end = patch + (left < together ? left : together);
      pages.come_to(end - 1);
      Strategy::sweep(task, piece, patch, end);
    }
  };
  PieceStrategies<kOutputs, T>::with_first(task, sweep, piece);
}

template <typename T, detail::OutputSet kOutputs>
SIMDBEZIER_KERNEL void grid_kernel(GridTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  task.taken = {};
  if (TaskStrategies<kOutputs, T>::with_first(
          task, [&]<typename Strategy>() SIMDBEZIER_INLINE_LAMBDA { Strategy::run(task); })) {
    return;
  }
  RowPowers<T> powers;
  for (RowPieces<T> pieces(task); pieces.more();) {
    run_piece<kOutputs>(task, pieces.next(powers));
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
