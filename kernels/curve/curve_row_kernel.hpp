// Positions of curves straight to the caller's layout: planes or x y z triples, through the caches
// or past them, at any place in memory. Past the caches, cubics leave from registers, as lines of
// whole curves (lines_of_curves.hpp) or joined (joined_rows.hpp); others go through staging.
#pragma once

#include "kernels/curve/joined_rows.hpp"
#include "kernels/curve/lanes_are_samples.hpp"
#include "kernels/curve/lines_of_curves.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Chooses how rows are written: as lines if a register holds several curves, and joined if they
/// are streamed. The others are triples.
template <bool kTriples, typename T>
SIMDBEZIER_KERNEL void evaluate_rows(const CurveTask<T>& task) {
  CurveRows<kTriples, T> out;
  for (std::size_t k = 0; k < out.kStreams; ++k) {
    out.first[k] =
        kTriples ? task.triples : task.out[output_index(CurveOutput::position)].component[k];
  }
  const bool cubic = task.shape->degree == 3;
  if constexpr (kLanes<vec<T>> * sizeof(T) >= 32) {
    const bool lines = detail::rows_fill_lines<T>(*task.shape, task.n);
    const std::size_t curves = lines ? curves_in_register<T>(task.n) : 0;
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
  if constexpr (kTriples) {
    cubic ? write_triples<4>(task) : write_triples<0>(task);
  }
}

template <typename T>
SIMDBEZIER_PART void evaluate_rows(const CurveTask<T>& task) {
  task.triples != nullptr ? evaluate_rows<true>(task) : evaluate_rows<false>(task);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
