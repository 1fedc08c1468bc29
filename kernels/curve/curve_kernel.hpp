// Curves on common parameters: lanes = samples of one curve. The kernel for a task is chosen here.
//
// Polynomial curves are swept component by component (curve_components.hpp). Where components meet
// (weights, tangents, curvatures) a register of samples is finished at once. Positions may go
// straight to the caller's layout, planes or x y z triples, through the caches or past them, at any
// place in memory: past the caches, cubics leave from registers, as lines of whole curves
// (lines_of_curves.hpp) or joined (joined_rows.hpp); others go through staging.
#pragma once

#include "kernels/curve/curve_components.hpp"
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

template <std::size_t kKnownOrder, bool kRational, std::size_t kDepth, typename T>
SIMDBEZIER_KERNEL void sweep_samples(const CurveTask<T>& shared_task) {
  using V = vec<T>;
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  shape.rational = kRational;
  for_curve_blocks(task, values_per_sample(task), [&](CurveBlock block) SIMDBEZIER_INLINE_LAMBDA {
    for_registers<V>(task.n, [&](std::size_t first) SIMDBEZIER_INLINE_LAMBDA {
      const CurvePoints<V, kKnownOrder == 0> points(load_vector<V>(task.x + first), shape);
      by_cells<kDepth>(points, [&]<bool kMixed>() SIMDBEZIER_INLINE_LAMBDA {
        for_curves<V>(task, block, first, [&](const CurveRange<V>& range) SIMDBEZIER_INLINE_LAMBDA {
          finish_samples<kKnownOrder, kRational, kDepth, kMixed>(task, shape, points, range);
        });
      });
    });
  });
}

/// Where components meet, few degrees are compiled on their own: lines, circles and cubics, and
/// tangents of polynomial cubics. First derivatives are rarely wanted without second ones
/// elsewhere.
template <bool kRational, typename T>
SIMDBEZIER_PART void sweep_joint(const CurveTask<T>& task) {
  const std::size_t depth = depth_of(task);
  if constexpr (kRational && !kCompact) {
    if (depth == 0 && task.shape->degree <= 3) {
      return with_one_of<2, 3, 4>(
          task.shape->order(), [&]<std::size_t kOrder>() { sweep_samples<kOrder, true, 0>(task); });
    }
  }
  if constexpr (!kRational && !kCompact) {
    if (depth == 1 && task.shape->degree == 3) {
      return sweep_samples<4, false, 1>(task);
    }
  }
  if constexpr (kRational || kCompact) { // others that want positions alone sweep components
    if (depth == 0) {
      return sweep_samples<0, kRational, 0>(task);
    }
  }
  sweep_samples<0, kRational, 2>(task);
}

/// Components that do not need each other. Positions have code for every degree of one cell, which
/// is up to twice as fast; of derivatives cubics have.
template <std::size_t kDepth, typename T>
SIMDBEZIER_PART void sweep_apart(const CurveTask<T>& task) {
  const int degree = task.shape->degree;
  if constexpr (kDepth == 0) {
    if (degree > 5) {
      return sweep_components<0, 0>(task);
    }
    return with_one_of<2, 3, 4, 5, 6>(
        task.shape->order(), [&]<std::size_t kOrder>() { sweep_components<kOrder, 0>(task); });
  }
  degree == 3 ? sweep_components<4, kDepth>(task) : sweep_components<0, kDepth>(task);
}

template <typename T>
SIMDBEZIER_KERNEL void curve_grid_kernel(CurveTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  if (task.shape->rational) {
    return sweep_joint<true>(task);
  }
  if constexpr (!kCompact) {
    if (task.rows) {
      return evaluate_rows(task);
    }
    if (task.curvature == nullptr && !task.out[output_index(CurveOutput::tangent)].wanted()) {
      return task.out[output_index(CurveOutput::d2)].wanted()   ? sweep_apart<2>(task)
             : task.out[output_index(CurveOutput::d1)].wanted() ? sweep_apart<1>(task)
                                                                : sweep_apart<0>(task);
    }
  }
  sweep_joint<false>(task);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
