// Polynomial curves on common parameters, swept component by component: a stream of values to one
// plane at a time.
//
// Curves of few samples are swept side by side, so that one register of parameters serves a block
// of them, and their coefficients come from the first-level cache. Long curves are swept one after
// the other, with their coefficients in registers: a register of samples then loads its parameters
// and the ends alone.
#pragma once

#include "kernels/curve/curve_blocks.hpp"
#include "kernels/curve/lanes_are_samples.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Where one component of curves goes.
template <typename T>
struct ComponentPlanes {
  T* position;
  T* d1;
  T* d2;

  SIMDBEZIER_INLINE ComponentPlanes(const CurveTask<T>& task, std::size_t slot)
      : position(task.out[output_index(CurveOutput::position)].component[slot]),
        d1(task.out[output_index(CurveOutput::d1)].component[slot]),
        d2(task.out[output_index(CurveOutput::d2)].component[slot]) {}

  [[nodiscard]] SIMDBEZIER_INLINE bool wanted() const {
    return position != nullptr || d1 != nullptr || d2 != nullptr;
  }
  /// Stores what is wanted of a register of samples.
  template <std::size_t kDepth, bool kMixed, typename V>
  SIMDBEZIER_INLINE void store(const CurveRange<V>& range, const CurveShape& shape,
                               const CurveChannel<V, kMixed>& channel, const Series<V>& s) const {
    if (kDepth == 0 || position != nullptr) {
      range.store(position, channel.finished(shape, s.value));
    }
    if constexpr (kDepth > 0) {
      if (d1 != nullptr) {
        range.store(d1, scaled_first<kMixed>(s.first));
      }
    }
    if constexpr (kDepth > 1) {
      if (d2 != nullptr) {
        range.store(d2, scaled_second<kMixed>(s.second));
      }
    }
  }
};

/// Sweeps a register of samples of each curve of a block.
template <typename V, std::size_t kKnownOrder, std::size_t kDepth, bool kMixed, bool kHalves,
          typename T>
SIMDBEZIER_PART void sweep_side_by_side(const CurveTask<T>& task, const CurveShape& given_shape,
                                        CurveBlock block, std::size_t first,
                                        const CurvePoints<V, kHalves>& points, std::size_t slot) {
  const ComponentPlanes<T> to(task, slot);
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
    to.template store<kDepth>(range, shape, channel, channel.template series<kDepth>(order));
  });
}

/// Curves of at least this many registers of samples are long.
inline constexpr std::size_t kLongCurve = 2;

/// Sweeps the curves of a block one after the other; their coefficients stay in registers.
template <typename V, std::size_t kKnownOrder, std::size_t kDepth, typename T>
SIMDBEZIER_PART void sweep_one_by_one(const CurveTask<T>& task, const CurveShape& given_shape,
                                      CurveBlock block, std::size_t swept, std::size_t slot) {
  const ComponentPlanes<T> to(task, slot);
  const CurveShape shape = given_shape;
  const std::size_t step = shape.values();
  const T* values =
      task.values + block.begin * step + (task.first_component + slot) * shape.channel_values();
  const std::size_t ahead = task.prefetch && slot == 0 ? kCurvesAhead * step : 0;
  for (std::size_t curve = block.begin; curve < block.end; ++curve, values += step) {
    if (ahead > 0) {
      prefetch_values(values + ahead, step);
    }
    V coefficients[kKnownOrder];
    repeat<kKnownOrder>(
        [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { coefficients[k] = broadcast<V>(values[k]); });
    for_registers<V>(swept, [&](std::size_t first) SIMDBEZIER_INLINE_LAMBDA {
      const CurvePoints<V, false> points(load_vector<V>(task.x + first), shape);
      const CurveRange<V> range{curve, curve * task.n + first, kLanes<V>, kLanes<V>,
                                task.streaming};
      const Series<V> s = row_series<kDepth>(
          Order<kKnownOrder>(kKnownOrder), points.local,
          [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return coefficients[k]; });
      to.template store<kDepth>(range, shape, CurveChannel<V, false>(shape, values, points), s);
    });
  }
}

/// Sweeps one component of some curves: short ones side by side, long ones one after the other.
template <typename V, std::size_t kKnownOrder, std::size_t kDepth, typename T>
SIMDBEZIER_PART void sweep_slot(const CurveTask<T>& task, const CurveShape& shape, CurveBlock block,
                                std::size_t swept, std::size_t slot) {
  if constexpr (!kCompact && kKnownOrder > 0) {
    if (swept >= kLongCurve * kLanes<V>) {
      return sweep_one_by_one<V, kKnownOrder, kDepth>(task, shape, block, swept, slot);
    }
  }
  for_registers<V>(swept, [&](std::size_t first) SIMDBEZIER_INLINE_LAMBDA {
    const CurvePoints<V, kKnownOrder == 0> points(load_vector<V>(task.x + first), shape);
    by_cells<kDepth>(points, [&]<bool kMixed>() SIMDBEZIER_INLINE_LAMBDA {
      sweep_side_by_side<V, kKnownOrder, kDepth, kMixed>(task, shape, block, first, points, slot);
    });
  });
}

/// Stores the ends of curves where they are alone.
template <typename T>
SIMDBEZIER_PART void store_ends(const CurveTask<T>& task, const CurveShape& shape, CurveBlock block,
                                std::size_t slot) {
  const T* const values = task.values + (shape.cells() - 1) * shape.cell_values() +
                          (task.first_component + slot) * shape.channel_values() + shape.ends_at() +
                          1;
  T* const position = ComponentPlanes<T>(task, slot).position + task.n - 1;
  for (std::size_t curve = block.begin; curve < block.end; ++curve) {
    move_value(position + curve * task.n, values + curve * shape.values());
  }
}

/// Sweeps all curves, a few of them at a time.
template <std::size_t kKnownOrder, std::size_t kDepth, typename T>
SIMDBEZIER_KERNEL void sweep_components(const CurveTask<T>& shared_task) {
  using V = vec<T>;
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  const bool lone_end = kDepth == 0 && ends_alone<V>(task);
  const std::size_t swept = task.n - (lone_end ? 1 : 0);
  for_curve_blocks(task, values_per_sample(task), [&](CurveBlock block) SIMDBEZIER_INLINE_LAMBDA {
    for (std::size_t slot = 0; slot < 3; ++slot) {
      if (!ComponentPlanes<T>(task, slot).wanted()) {
        continue;
      }
      sweep_slot<V, kKnownOrder, kDepth>(task, shape, block, swept, slot);
      if (lone_end) {
        store_ends(task, shape, block, slot);
      }
    }
  });
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
