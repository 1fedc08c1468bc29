// Rows of curves as streams of whole lines past the caches (simd/line_stream.hpp), wherever they
// begin and whatever the number of samples: lanes = samples of one curve.
//
// Rows that were put together in the first-level cache and copied from there took the time of both,
// since streaming stores and others leave in order.
#pragma once

#include "kernels/curve/lanes_are_samples.hpp"
#include "kernels/curve/lines_of_curves.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Puts records of the first `samples` lanes of three planes behind each other.
template <typename V>
SIMDBEZIER_INLINE void put_triples(const V (&value)[3], std::size_t samples,
                                   LineStream<V, true>& stream) {
  using T = ScalarOf<V>;
  constexpr std::size_t kL = kLanes<V>;
  LinePart<T> part[3];
  repeat<3>([&](std::size_t c)
                SIMDBEZIER_INLINE_LAMBDA { part[c] = __builtin_bit_cast(LinePart<T>, value[c]); });
  LinePart<T> line[3];
  form_records<T>(part, line);
  repeat<3>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    const V values = __builtin_bit_cast(V, line[k]);
    if (3 * samples >= (k + 1) * kL) {
      stream.put(values);
    } else if (3 * samples > k * kL) {
      stream.put_first(values, 3 * samples - k * kL);
    }
  });
}

/// Streams the rows of all curves of a task.
template <std::size_t kKnownOrder, bool kTriples, typename T>
SIMDBEZIER_KERNEL void stream_rows(const CurveTask<T>& shared_task,
                                   const CurveRows<kTriples, T>& rows) {
  using V = vec<T>;
  constexpr std::size_t kL = kLanes<V>;
  constexpr std::size_t kStreams = CurveRows<kTriples, T>::kStreams;
  // Copies, because stores through vector types might change anything that others can see.
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  const std::size_t stride = shape.values();
  const std::size_t channel = shape.channel_values();
  const bool lone_end = ends_alone<V>(task);
  const std::size_t swept = task.n - (lone_end ? 1 : 0);
  const std::size_t row = rows.row(task.n);
  LineStream<V, true> streams[kStreams];
  repeat<kStreams>([&](std::size_t k)
                       SIMDBEZIER_INLINE_LAMBDA { streams[k].begin(rows.first[k]); });
  const T* values = task.values + task.first_component * channel;
  // The samples from number `first` on of component c.
  const auto positions = [&](std::size_t c, std::size_t first) SIMDBEZIER_INLINE_LAMBDA {
    const CurvePoints<V, false> points(load_vector<V>(task.x + first));
    return CurveChannel<V, false>(shape, values + c * channel, points)
        .template position<kKnownOrder>(shape);
  };
  for (std::size_t curve = 0; curve < task.curve_count; ++curve, values += stride) {
    if (task.prefetch) {
      prefetch_values(values + kValuesAhead<T>, stride);
    }
    repeat<kStreams>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
      ask_for_pages(page_behind(rows.first[k] + curve * row), row * sizeof(T));
    });
    const T* const ends = values + shape.ends_at() + 1;
    if constexpr (kTriples) {
      for (std::size_t first = 0; first < swept; first += kL) {
        const V value[3] = {positions(0, first), positions(1, first), positions(2, first)};
        put_triples(value, std::min(swept - first, kL), streams[0]);
      }
      for (std::size_t c = 0; lone_end && c < 3; ++c) {
        streams[0].put_value(ends + c * channel);
      }
    } else {
      repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
        if (swept < kL) {
          streams[c].put_first(positions(c, 0), swept);
        } else {
          streams[c].put_row(swept, [&](std::size_t k)
                                        SIMDBEZIER_INLINE_LAMBDA { return positions(c, k * kL); });
        }
        if (lone_end) {
          streams[c].put_value(ends + c * channel);
        }
      });
    }
  }
  repeat<kStreams>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { streams[k].finish(); });
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
