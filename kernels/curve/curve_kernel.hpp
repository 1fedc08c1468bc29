// Curves on common parameters: lanes = samples of one curve.
//
// A curve of n samples takes whole registers, the last of which may repeat samples of the one
// before. Where n is less than a register, its idle lanes are written all the same, into the place
// of the next curve, which comes later; only the end of the task is masked. Neither costs what a
// masked store would, and lanes are independent, so the bits are those of any other arrangement.
//
// Polynomial curves are swept component by component, a few of them at a time: long streams to one
// plane, out of coefficients that stay in the first-level cache. Where components meet (weights,
// tangents, curvatures) a register of samples is finished at once.
#pragma once

#include "kernels/curve/curve_row_kernel.hpp"
#include "kernels/drain/drain_kernel.hpp"
#include "kernels/simd/row_groups.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Samples of the curves that are swept together: enough for long stores to one plane, and so few
/// that draining what was staged before, in between, overlaps with computing.
inline constexpr std::size_t kBlockSamples = 256;

/// How far ahead values are asked for.
inline constexpr std::size_t kCurvesAhead = 32;

/// Consecutive curves of a task.
struct CurveBlock {
  std::size_t begin;
  std::size_t end;
};

template <typename T, typename Body>
SIMDBEZIER_INLINE void for_curve_blocks(const CurveTask<T>& task, std::size_t values, Body body) {
  const std::size_t most = task.n < kBlockSamples ? kBlockSamples / task.n : 1;
  for (std::size_t begin = 0; begin < task.curve_count; begin += most) {
    const std::size_t left = task.curve_count - begin;
    const CurveBlock block{begin, begin + (left < most ? left : most)};
    body(block);
    drain_some(task.drain, values * task.n * (block.end - begin));
  }
}

/// Calls body(first) for each register of a curve of n samples, n being at least 1. The last one
/// may begin within the one before it.
template <typename V, typename Body>
SIMDBEZIER_INLINE void for_registers(std::size_t n, Body body) {
  std::size_t first = 0;
  for (; first + kLanes<V> < n; first += kLanes<V>) {
    body(first);
  }
  body(n < kLanes<V> ? 0 : n - kLanes<V>);
}

/// Calls body(range) for each curve of a block: places of a register of its samples.
template <typename V, typename T, typename Body>
SIMDBEZIER_INLINE void for_curves(const CurveTask<T>& task, CurveBlock block, std::size_t first,
                                  Body body) {
  const std::size_t n = task.n;
  CurveRange<V> range{block.begin, block.begin * n + first, 0,
                      n - first < kLanes<V> ? n - first : kLanes<V>, task.streaming};
  std::size_t left = task.curve_count * n - range.at;
  for (; range.curve < block.end; ++range.curve, range.at += n, left -= n) {
    range.writable = left < kLanes<V> ? left : kLanes<V>;
    body(range);
  }
}

/// Values and derivatives of one component of some curves.
template <typename V, std::size_t kKnownOrder, std::size_t kDepth, bool kMixed, bool kHalves,
          typename T>
SIMDBEZIER_PART void sweep_component(const CurveTask<T>& task, const CurveShape& given_shape,
                                     CurveBlock block, std::size_t first,
                                     const CurvePoints<V, kHalves>& points, std::size_t slot) {
  T* const position = task.out[output_index(CurveOutput::position)].component[slot];
  T* const d1 = task.out[output_index(CurveOutput::d1)].component[slot];
  T* const d2 = task.out[output_index(CurveOutput::d2)].component[slot];
  // Copies of what each curve needs, since after a store compilers would load it anew.
  const CurveShape shape = given_shape;
  const Order<kKnownOrder> order(shape.order());
  const std::size_t step = shape.values();
  const T* values =
      task.values + block.begin * step + (task.first_component + slot) * shape.channel_values();
  // Hardware does not follow the values across the pauses between blocks.
  const std::size_t ahead = task.prefetch && slot == 0 && first == 0 ? kCurvesAhead * step : 0;
  for_curves<V>(task, block, first, [&](const CurveRange<V>& range) SIMDBEZIER_INLINE_LAMBDA {
    if (ahead > 0) {
      prefetch_values(values + ahead, step);
    }
    const CurveChannel<V, kMixed> channel(shape, values, points);
    values += step;
    const Series<V> s = channel.template series<kDepth>(order);
    if (kDepth == 0 || position != nullptr) {
      range.store(position, channel.finished(shape, s.value));
    }
    if constexpr (kDepth > 0) {
      if (d1 != nullptr) {
        range.store(d1, scaled_first<kHalves>(s.first));
      }
    }
    if constexpr (kDepth > 1) {
      if (d2 != nullptr) {
        range.store(d2, scaled_second<kHalves>(s.second));
      }
    }
  });
}

template <typename T>
SIMDBEZIER_PART void store_ends(const CurveTask<T>& task, const CurveShape& shape, CurveBlock block,
                                std::size_t slot) {
  const T* const values = task.values + (shape.cells() - 1) * shape.cell_values() +
                          (task.first_component + slot) * shape.channel_values() + shape.ends_at() +
                          1;
  T* const position = task.out[output_index(CurveOutput::position)].component[slot] + task.n - 1;
  for (std::size_t curve = block.begin; curve < block.end; ++curve) {
    move_value(position + curve * task.n, values + curve * shape.values());
  }
}

template <typename T>
SIMDBEZIER_PART bool wants_slot(const CurveTask<T>& task, std::size_t slot) {
  return task.out[output_index(CurveOutput::position)].component[slot] != nullptr ||
         task.out[output_index(CurveOutput::d1)].component[slot] != nullptr ||
         task.out[output_index(CurveOutput::d2)].component[slot] != nullptr;
}

template <typename T>
SIMDBEZIER_PART std::size_t values_per_sample(const CurveTask<T>& task) {
  std::size_t values = 0;
  for (const auto& planes : task.out) {
    values += planes.wanted() ? 3 : 0;
  }
  return values;
}

template <std::size_t kKnownOrder, bool kHalves, std::size_t kDepth, typename T>
SIMDBEZIER_KERNEL void sweep_components(const CurveTask<T>& shared_task) {
  using V = vec<T>;
  // Copies, because stores through vector types might change anything that others can see.
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  const bool lone_end = kDepth == 0 && ends_alone<V>(task);
  const std::size_t swept = task.n - (lone_end ? 1 : 0);
  for_curve_blocks(task, values_per_sample(task), [&](CurveBlock block) SIMDBEZIER_INLINE_LAMBDA {
    for (std::size_t slot = 0; slot < 3; ++slot) {
      if (!wants_slot(task, slot)) {
        continue;
      }
      for_registers<V>(swept, [&](std::size_t first) SIMDBEZIER_INLINE_LAMBDA {
        const CurvePoints<V, kHalves> points(load_vector<V>(task.x + first));
        by_cells<kDepth == 0>(points, [&]<bool kMixed>() SIMDBEZIER_INLINE_LAMBDA {
          sweep_component<V, kKnownOrder, kDepth, kMixed>(task, shape, block, first, points, slot);
        });
      });
      if (lone_end) {
        store_ends(task, shape, block, slot);
      }
    }
  });
}

template <std::size_t kKnownOrder, bool kHalves, bool kRational, std::size_t kDepth, typename T>
SIMDBEZIER_KERNEL void sweep_samples(const CurveTask<T>& shared_task) {
  using V = vec<T>;
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  shape.rational = kRational;
  for_curve_blocks(task, values_per_sample(task), [&](CurveBlock block) SIMDBEZIER_INLINE_LAMBDA {
    for_registers<V>(task.n, [&](std::size_t first) SIMDBEZIER_INLINE_LAMBDA {
      const CurvePoints<V, kHalves> points(load_vector<V>(task.x + first));
      by_cells<kDepth == 0>(points, [&]<bool kMixed>() SIMDBEZIER_INLINE_LAMBDA {
        for_curves<V>(task, block, first, [&](const CurveRange<V>& range) SIMDBEZIER_INLINE_LAMBDA {
          finish_samples<kKnownOrder, kRational, kDepth, kMixed>(task, shape, points, range);
        });
      });
    });
  });
}

template <bool kRational, std::size_t kDepth, typename T>
SIMDBEZIER_PART void sweep_any_degree(const CurveTask<T>& task) {
  if (task.shape->cells() == 1) {
    sweep_samples<0, false, kRational, kDepth>(task);
  } else {
    sweep_samples<0, true, kRational, kDepth>(task);
  }
}

/// Where components meet, few degrees are compiled on their own: lines, circles and cubics, and
/// tangents of polynomial cubics. First derivatives are rarely wanted without second ones
/// elsewhere.
template <bool kRational, typename T>
SIMDBEZIER_PART void sweep_joint(const CurveTask<T>& task) {
  const std::size_t depth = depth_of(task);
  if constexpr (kRational && !kCompact) {
    if (depth == 0 && task.shape->degree == 1) {
      return sweep_samples<2, false, true, 0>(task);
    }
    if (depth == 0 && task.shape->degree == 2) {
      return sweep_samples<3, false, true, 0>(task);
    }
    if (depth == 0 && task.shape->degree == 3) {
      return sweep_samples<4, false, true, 0>(task);
    }
  }
  if constexpr (!kRational && !kCompact) {
    if (depth == 1 && task.shape->degree == 3) {
      return sweep_samples<4, false, false, 1>(task);
    }
  }
  if constexpr (kRational || kCompact) { // others that want positions alone sweep components
    if (depth == 0) {
      return sweep_any_degree<kRational, 0>(task);
    }
  }
  sweep_any_degree<kRational, 2>(task);
}

/// Components that do not need each other. Positions have code for every degree of one cell, which
/// is up to twice as fast; of derivatives cubics have.
template <std::size_t kDepth, typename T>
SIMDBEZIER_PART void sweep_apart(const CurveTask<T>& task) {
  const int degree = task.shape->degree;
  if constexpr (kDepth == 0) {
    switch (degree) {
    case 1:
      return sweep_components<2, false, 0>(task);
    case 2:
      return sweep_components<3, false, 0>(task);
    case 3:
      return sweep_components<4, false, 0>(task);
    case 4:
      return sweep_components<5, false, 0>(task);
    case 5:
      return sweep_components<6, false, 0>(task);
    default:
      return sweep_components<0, true, 0>(task);
    }
  }
  if (degree == 3) {
    return sweep_components<4, false, kDepth>(task);
  }
  if (task.shape->cells() == 1) {
    sweep_components<0, false, kDepth>(task);
  } else {
    sweep_components<0, true, kDepth>(task);
  }
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
