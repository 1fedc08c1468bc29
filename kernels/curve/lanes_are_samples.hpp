// Rows of curves of at least a register of samples: lanes = samples of one curve.
#pragma once

#include "kernels/curve/curve_rows.hpp"
#include "kernels/simd/row_groups.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether there is one more sample than whole registers hold, on the end of the curves, as in
/// grids of 17 or 33. Positions there are stored values.
template <typename V, typename T>
SIMDBEZIER_PART bool ends_alone(const CurveTask<T>& task) {
  return task.n % kLanes<V> == 1 && task.n > kLanes<V> && task.x[task.n - 1] == T(0.5);
}

/// Writes samples [first, first + a register) of curves [begin, end).
template <std::size_t kKnownOrder, bool kTriples, typename T>
SIMDBEZIER_INLINE void sweep_rows(const CurveTask<T>& task, const CurveShape& shape,
                                  std::size_t begin, std::size_t end, std::size_t first,
                                  const CurveRows<kTriples, T>& rows) {
  using V = vec<T>;
  const CurvePoints<V, false> points(load_vector<V>(task.x + first));
  const std::size_t stride = shape.values();
  const std::size_t row = rows.row(task.n);
  const std::size_t channel_values = shape.channel_values();
  const T* values = task.values + begin * stride + task.first_component * channel_values;
  std::size_t at = rows.row(first);
  const bool prefetch = task.prefetch && first == 0;
  for (std::size_t curve = begin; curve < end; ++curve, values += stride, at += row) {
    if (prefetch) {
      prefetch_values(values + kValuesAhead<T>, stride);
    }
    V value[3];
    repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      const CurveChannel<V, false> channel(shape, values + c * channel_values, points);
      value[c] = channel.finished(
          shape, channel.template series<0>(Order<kKnownOrder>(shape.order())).value);
    });
    if constexpr (kTriples) {
      store_triples(value, rows.first[0] + at, false);
    } else {
      repeat<3>([&](std::size_t c)
                    SIMDBEZIER_INLINE_LAMBDA { store_vector(rows.first[c] + at, value[c]); });
    }
  }
}

/// Writes curves [begin, end) to rows of their own. The last register of a row may repeat samples
/// of the one before.
template <std::size_t kKnownOrder, bool kTriples, typename T>
SIMDBEZIER_INLINE void fill_along(const CurveTask<T>& task, const CurveShape& shape,
                                  std::size_t begin, std::size_t end,
                                  const CurveRows<kTriples, T>& rows) {
  using V = vec<T>;
  const bool lone_end = ends_alone<V>(task);
  const std::size_t swept = task.n - (lone_end ? 1 : 0);
  for (std::size_t s = 0; s < swept; s += kLanes<V>) {
    const std::size_t first = s + kLanes<V> <= swept ? s : swept - kLanes<V>;
    sweep_rows<kKnownOrder>(task, shape, begin, end, first, rows);
  }
  if (lone_end) {
    const std::size_t channel = shape.channel_values();
    const T* from =
        task.values + begin * shape.values() + task.first_component * channel + shape.ends_at() + 1;
    std::size_t at = rows.row(swept);
    for (std::size_t curve = begin; curve < end; ++curve) {
      for (std::size_t c = 0; c < 3; ++c) {
        move_value(kTriples ? rows.first[0] + at + c : rows.first[c % rows.kStreams] + at,
                   from + c * channel);
      }
      from += shape.values();
      at += rows.row(task.n);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
