// Grid kernels: a task is a small grid, or its rows are cut into pieces (grid/row_pieces.hpp), and
// the table of strategies (grid/strategies.hpp) says how each piece is evaluated.
#pragma once

#include "kernels/grid/strategies.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Evaluates a task as a whole, if there is a strategy for it, and returns whether there is.
template <typename T, detail::OutputSet kOutputs>
SIMDBEZIER_PART bool run_whole(GridTask<T>& task) {
  using Strategies = TaskStrategies<kOutputs, T>;
  const GridStrategy strategy = Strategies::find(task, GridStrategy::tiles);
  if (strategy == GridStrategy::tiles) {
    return false;
  }
  task.taken.add(strategy);
  Strategies::with(strategy,
                   [&]<typename Strategy>() SIMDBEZIER_INLINE_LAMBDA { Strategy::run(task); });
  return true;
}

/// Evaluates a piece: all patches in order, or so many at a time as stay in the first-level cache.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void run_piece(GridTask<T>& task, const RowPiece<T>& piece) {
  using InOrder = StreamedOrder<kOutputs, T>;
  using Strategies = PieceStrategies<kOutputs, T>;
  if constexpr (InOrder::kExists) {
    if (task.allowed.has(InOrder::kName) && InOrder::applies(task)) {
      task.taken.add(InOrder::kName);
      return InOrder::sweep(task, piece);
    }
  }
  const GridStrategy strategy = Strategies::find(task, GridStrategy::tiles, piece);
  task.taken.add(strategy);
  const std::size_t cached = kUsual<kOutputs> ? task.cached_bytes : kCachedBytes;
  const std::size_t together = cached / bytes_of<kOutputs>(task, piece) + 1;
  PagesAhead<T> pages(task, piece);
  for (std::size_t patch = 0; patch < task.patch_count; patch += together) {
    const std::size_t left = task.patch_count - patch;
    const std::size_t end = patch + (left < together ? left : together);
    pages.come_to(end - 1);
    Strategies::with(strategy, [&]<typename Strategy>() SIMDBEZIER_INLINE_LAMBDA {
      Strategy::sweep(task, piece, patch, end);
    });
  }
}

template <typename T, detail::OutputSet kOutputs>
SIMDBEZIER_KERNEL void grid_kernel(GridTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  task.taken = {};
  if (run_whole<T, kOutputs>(task)) {
    return;
  }
  RowPowers<T> powers;
  for (RowPieces<T> pieces(task); pieces.more();) {
    run_piece<kOutputs>(task, pieces.next(powers));
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
