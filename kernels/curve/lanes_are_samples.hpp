// Positions of curves in x y z triples: lanes = samples of one curve.
#pragma once

#include <algorithm>

#include "kernels/curve/curve_blocks.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether there is one more sample than whole registers hold, on the end of the curves, as in
/// grids of 17 or 33. Positions there are stored values.
template <typename V, typename T>
SIMDBEZIER_PART bool ends_alone(const CurveTask<T>& task) {
  return task.n % kLanes<V> == 1 && task.n > kLanes<V> && task.x[task.n - 1] == T(0.5);
}

/// Writes samples [first, first + a register) of a block of curves, whose rows begin at `to`.
template <std::size_t kKnownOrder, typename T>
SIMDBEZIER_INLINE void sweep_triples(const CurveTask<T>& task, const CurveShape& shape,
                                     CurveBlock block, std::size_t first, T* to) {
  using V = vec<T>;
  const CurvePoints<V, false> points(load_vector<V>(task.x + first), shape);
  const std::size_t stride = shape.values();
  const std::size_t channel_values = shape.channel_values();
  const T* values = task.values + block.begin * stride + task.first_component * channel_values;
  const bool prefetch = task.prefetch && first == 0;
  to += 3 * first;
  for (std::size_t curve = block.begin; curve < block.end;
       ++curve, values += stride, to += 3 * task.n) {
    if (prefetch) {
      prefetch_values(values + kValuesAhead<T>, stride);
    }
    V value[3];
    repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      const CurveChannel<V, false> channel(shape, values + c * channel_values, points);
      value[c] = channel.finished(
          shape, channel.template series<0>(Order<kKnownOrder>(shape.order())).value);
    });
    store_triples(value, to, false);
  }
}

/// Writes the rows of a block of curves to `to`, in registers as for_registers() has them.
template <std::size_t kKnownOrder, typename T>
SIMDBEZIER_INLINE void fill_triples(const CurveTask<T>& task, const CurveShape& shape,
                                    CurveBlock block, T* to) {
  using V = vec<T>;
  const bool lone_end = ends_alone<V>(task);
  const std::size_t swept = task.n - (lone_end ? 1 : 0);
  for_registers<V>(swept, [&](std::size_t first) SIMDBEZIER_INLINE_LAMBDA {
    sweep_triples<kKnownOrder>(task, shape, block, first, to);
  });
  if (lone_end) {
    const std::size_t channel = shape.channel_values();
    const T* from = task.values + block.begin * shape.values() + task.first_component * channel +
                    shape.ends_at() + 1;
    to += 3 * swept;
    for (std::size_t curve = block.begin; curve < block.end;
         ++curve, from += shape.values(), to += 3 * task.n) {
      for (std::size_t c = 0; c < 3; ++c) {
        move_value(to + c, from + c * channel);
      }
    }
  }
}

/// Writes all curves of a task, so many at a time that their lines are still in the first-level
/// cache when the next register of samples comes to them. Idle lanes of short rows are written to
/// the next curve's place, so that the last curves go through memory.
template <std::size_t kKnownOrder, typename T>
SIMDBEZIER_KERNEL void write_triples(const CurveTask<T>& shared_task) {
  constexpr std::size_t kBatch = 2048 / sizeof(T);
  constexpr std::size_t kAll = kLanes<vec<T>>;
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  const std::size_t row = 3 * task.n;
  const std::size_t last = std::min((kAll - 1) / task.n, task.curve_count);
  const std::size_t end = task.curve_count - last;
  const std::size_t batch = std::max<std::size_t>(kBatch / row, 1);
  alignas(64) T memory[6 * kAll];
  for (std::size_t first = 0; first < task.curve_count;) {
    const CurveBlock block{first, first < end ? std::min(first + batch, end) : task.curve_count};
    fill_triples<kKnownOrder>(task, shape, block,
                              first < end ? task.triples + first * row : memory);
    first = block.end;
  }
  __builtin_memcpy(task.triples + end * row, memory, last * row * sizeof(T));
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
