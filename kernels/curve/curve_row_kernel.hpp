// Positions of curves straight to the caller's layout: planes or x y z triples, through the caches
// or past them, at any place in memory. Past the caches, cubics leave from registers, as lines of
// whole curves (lines_of_curves.hpp) or joined (joined_rows.hpp); others go through staging.
#pragma once

#include "kernels/curve/joined_rows.hpp"
#include "kernels/curve/lanes_are_curves.hpp"
#include "kernels/curve/lanes_are_samples.hpp"
#include "kernels/curve/lines_of_curves.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Writes rows of a register of samples and more, so many values of them at a time that their lines
/// are still in the first-level cache when the next register of samples comes to them.
template <std::size_t kKnownOrder, bool kTriples, typename T>
SIMDBEZIER_KERNEL void write_along(const CurveTask<T>& shared_task,
                                   const CurveRows<kTriples, T>& shared_rows) {
  constexpr std::size_t kBatch = 2048 / sizeof(T);
  // Copies, because stores through vector types might change anything that others can see.
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  const CurveRows<kTriples, T> rows = shared_rows;
  const std::size_t batch = std::max<std::size_t>(kBatch / (3 * task.n), 1);
  for (std::size_t first = 0; first < task.curve_count; first += batch) {
    fill_along<kKnownOrder>(task, shape, first, std::min(first + batch, task.curve_count),
                            rows.at(first * rows.row(task.n)));
  }
}

/// Writes rows of fewer samples, in registers of curves. Those too few for a register go through
/// memory.
template <std::size_t kKnownOrder, bool kTriples, typename T>
SIMDBEZIER_KERNEL void write_across(const CurveTask<T>& shared_task,
                                    const CurveRows<kTriples, T>& shared_rows) {
  constexpr std::size_t kAll = kLanes<vec<T>>;
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  const CurveRows<kTriples, T> rows = shared_rows;
  const std::size_t row = rows.row(task.n);
  const std::size_t whole = task.curve_count / kAll * kAll;
  fill_across<kKnownOrder>(task, shape, 0, whole, rows);
  if (whole < task.curve_count) {
    alignas(64) T memory[3 * kAll * kAll];
    CurveRows<kTriples, T> last;
    for (std::size_t k = 0; k < rows.kStreams; ++k) {
      last.first[k] = memory + k * kAll * row;
    }
    fill_across<kKnownOrder>(task, shape, whole, task.curve_count, last);
    for (std::size_t k = 0; k < rows.kStreams; ++k) {
      __builtin_memcpy(rows.first[k] + whole * row, last.first[k],
                       (task.curve_count - whole) * row * sizeof(T));
    }
  }
}

/// Chooses how rows are written. Cubics of few samples go by lines, but for planes that stay in the
/// caches; what else is streamed is joined. Other rows have curves in their lanes if they are
/// shorter than a register, and samples otherwise.
template <bool kTriples, typename T>
SIMDBEZIER_KERNEL void evaluate_rows(const CurveTask<T>& task) {
  constexpr std::size_t kAll = kLanes<vec<T>>;
  CurveRows<kTriples, T> out;
  for (std::size_t k = 0; k < out.kStreams; ++k) {
    out.first[k] =
        kTriples ? task.triples : task.out[output_index(CurveOutput::position)].component[k];
  }
  const bool cubic = task.shape->degree == 3;
  if constexpr (kAll * sizeof(T) >= 32) {
    const bool by_lines = task.streaming || (kTriples && cubic && !task.shape->origins);
    const std::size_t curves = by_lines ? curves_in_register<T>(task.n) : 0;
    if constexpr (kMostCurves<T> >= 4) {
      if (curves == 4) {
        return fill_lines<4>(task, out);
      }
    }
    if constexpr (kMostCurves<T> >= 2) {
      if (curves == 2) {
        return fill_lines<2>(task, out);
      }
    }
    if (task.streaming) {
      return curves == 1 ? fill_lines<1>(task, out) : stream_joined(task, out);
    }
  }
  if constexpr (kAll > detail::kLeastRow) {
    if (task.n < kAll) {
      return cubic ? write_across<4>(task, out) : write_across<0>(task, out);
    }
  }
  cubic ? write_along<4>(task, out) : write_along<0>(task, out);
}

template <typename T>
SIMDBEZIER_PART void evaluate_rows(const CurveTask<T>& task) {
  task.triples != nullptr ? evaluate_rows<true>(task) : evaluate_rows<false>(task);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
