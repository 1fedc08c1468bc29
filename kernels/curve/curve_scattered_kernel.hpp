// Scattered samples on curves: a run of samples of one curve fills registers, samples of different
// curves are evaluated one by one, with the same operations.
#pragma once

#include "kernels/curve/curve_outputs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::ScatteredCurveTask;

/// Samples of one curve from which on registers are worthwhile.
template <typename V>
inline constexpr std::size_t kWorthwhileRun = kLanes<V> / 4 + 1;

/// Samples [first, first + own) of a task, all of one curve.
template <typename V, std::size_t kOrder, bool kHalves, bool kRational, std::size_t kDepth,
          typename T>
SIMDBEZIER_INLINE void evaluate_samples(const ScatteredCurveTask<T>& task, const CurveShape& shape,
                                        std::size_t first, std::size_t own) {
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
  const CurvePoints<V, kHalves> points(x);
  by_cells(points, [&]<bool kMixed>() SIMDBEZIER_INLINE_LAMBDA {
    finish_samples<kOrder, kRational, kDepth, kMixed>(
        task, shape, points, CurveRange<V>{task.curve[first], first, own, own, false});
  });
}

template <typename T>
SIMDBEZIER_INLINE void prefetch_curve(const ScatteredCurveTask<T>& task, const CurveShape& shape,
                                      std::size_t k) {
  constexpr std::size_t kAhead = 12;
  if (k + kAhead < task.count) {
    // Values do not begin at lines.
    prefetch_values(task.values + task.curve[k + kAhead] * shape.values(),
                    shape.values() + 64 / sizeof(T) - 1);
  }
}

template <std::size_t kOrder, bool kHalves, bool kRational, std::size_t kDepth, typename T>
__attribute__((noinline)) void scatter_samples(const ScatteredCurveTask<T>& shared_task) {
  using V = vec<T>;
  const ScatteredCurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  if constexpr (kOrder > 0) {
    shape.degree = static_cast<int>(kOrder) - 1;
  }
  shape.rational = kRational;
  for (std::size_t k = 0; k < task.count;) {
    std::size_t run = 1;
    while (run < kLanes<V> && k + run < task.count && task.curve[k + run] == task.curve[k]) {
      ++run;
    }
    if (run < kWorthwhileRun<V>) {
      for (std::size_t i = 0; i < run; ++i) {
        if (task.prefetch) {
          prefetch_curve(task, shape, k + i);
        }
        evaluate_samples<T, kOrder, kHalves, kRational, kDepth>(task, shape, k + i, 1);
      }
    } else {
      evaluate_samples<V, kOrder, kHalves, kRational, kDepth>(task, shape, k, run);
    }
    k += run;
  }
}

template <std::size_t kOrder, bool kHalves, bool kRational, typename T>
SIMDBEZIER_INLINE void scatter_depth(const ScatteredCurveTask<T>& task) {
  if (depth_of(task) == 0) {
    scatter_samples<kOrder, kHalves, kRational, 0>(task);
  } else {
    scatter_samples<kOrder, kHalves, kRational, 2>(task);
  }
}

template <std::size_t kOrder, bool kHalves, typename T>
SIMDBEZIER_INLINE void scatter_degree(const ScatteredCurveTask<T>& task) {
  if (task.shape->rational) {
    scatter_depth<kOrder, kHalves, true>(task);
  } else {
    scatter_depth<kOrder, kHalves, false>(task);
  }
}

template <typename T>
void scattered_curve_kernel(ScatteredCurveTask<T>& task) {
  switch (task.shape->degree) {
  case 3:
    scatter_degree<4, false>(task);
    break;
  case 1:
  case 2:
  case 4:
  case 5:
    scatter_degree<0, false>(task);
    break;
  default:
    scatter_degree<0, true>(task);
  }
  task.executed = Isa::SIMDBEZIER_ISA;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
