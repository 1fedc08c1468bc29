// Scattered samples on curves: a run of samples of one curve fills registers. A sample whose curve
// no other one follows takes a register, too: code for single values would be as much again. So
// would code for known degrees.
#pragma once

#include "kernels/curve/curve_outputs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::ScatteredCurveTask;

/// Evaluates samples [first, first + own) of a task, all of one curve.
template <bool kRational, std::size_t kDepth, typename T>
SIMDBEZIER_PART void evaluate_samples(const ScatteredCurveTask<T>& task, const CurveShape& shape,
                                      std::size_t first, std::size_t own) {
  using V = vec<T>;
  V t;
  if (own < kLanes<V>) {
    alignas(64) T lanes[kLanes<V>];
    for (std::size_t i = 0; i < kLanes<V>; ++i) {
      lanes[i] = task.t[first + (i < own ? i : own - 1)];
    }
    t = load_vector<V>(lanes);
  } else {
    t = load_vector<V>(task.t + first);
  }
  V x = (t - broadcast<V>(task.shift)) * broadcast<V>(task.scale);
  x = x + (x - x); // infinite becomes nan, all else stays
  const CurvePoints<V, true> points(x, shape);
  by_cells<kDepth>(points, [&]<bool kMixed>() SIMDBEZIER_INLINE_LAMBDA {
    finish_samples<0, kRational, kDepth, kMixed>(
        task, shape, points, CurveRange<V>{task.curve[first], first, own, own, false});
  });
}

template <typename T>
SIMDBEZIER_PART void prefetch_curve(const ScatteredCurveTask<T>& task, const CurveShape& shape,
                                    std::size_t k) {
  constexpr std::size_t kAhead = 12;
  if (k + kAhead < task.count) {
    // Values do not begin at lines.
    prefetch_values(task.values + task.curve[k + kAhead] * shape.values(),
                    shape.values() + 64 / sizeof(T) - 1);
  }
}

template <bool kRational, std::size_t kDepth, typename T>
SIMDBEZIER_KERNEL void scatter_samples(const ScatteredCurveTask<T>& shared_task) {
  const ScatteredCurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  shape.rational = kRational;
  for (std::size_t k = 0; k < task.count;) {
    std::size_t run = 1;
    while (run < kLanes<vec<T>> && k + run < task.count && task.curve[k + run] == task.curve[k]) {
      ++run;
    }
    if (task.prefetch) {
      for (std::size_t i = 0; i < run; ++i) {
        prefetch_curve(task, shape, k + i);
      }
    }
    evaluate_samples<kRational, kDepth>(task, shape, k, run);
    k += run;
  }
}

template <typename T>
SIMDBEZIER_KERNEL void scattered_curve_kernel(ScatteredCurveTask<T>& task) {
  const auto run = [&]<bool kRational>() SIMDBEZIER_INLINE_LAMBDA {
    depth_of(task) == 0 ? scatter_samples<kRational, 0>(task) : scatter_samples<kRational, 2>(task);
  };
  task.shape->rational ? run.template operator()<true>() : run.template operator()<false>();
  task.executed = Isa::SIMDBEZIER_ISA;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
