// Rows of cubics as one stream past the caches: lanes = samples that follow each other in memory,
// of one curve or of two.
//
// Streaming stores take whole lines, whatever the number of samples a curve. Rows that were put
// together in the first-level cache and copied from there took the time of both, since streaming
// stores and others leave in order.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernels/curve/curve_rows.hpp"
#include "kernels/curve/lines_of_curves.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Samples of cubics without origins on n common parameters, kLanes<vec<T>> <= n <= kMostJoined, in
/// registers that begin at any of them.
template <typename T>
class JoinedSamples {
  using V = vec<T>;

public:
  /// Curves have their values `stride` behind each other.
  JoinedSamples(const T* x, std::size_t n, std::size_t stride) : n_(n), stride_(stride) {
    alignas(64) T numbers[kLanes<V>];
    for (std::size_t i = 0; i < kLanes<V>; ++i) {
      numbers[i] = static_cast<T>(i);
    }
    number_ = load_vector<V>(numbers);
    for (std::size_t i = 0; i < n + kLanes<V>; ++i) {
      x_[i] = x[i % n];
    }
    std::size_t beyond = 0; // the place behind the next end, 0 where there is none
    for (std::size_t i = n + kLanes<V>; i-- > 0;) {
      if (x_[i] == T(-0.5) || x_[i] == T(0.5)) {
        beyond = i + 1;
      }
      if (i < n) {
        ends_[i] = beyond > 0 && beyond <= i + kLanes<V>;
      }
    }
  }

  /// Evaluates a register of samples of each of kCount components, from number `first` of a curve
  /// on; those beyond its last one are the next curve's first. from: the values of the first
  /// component.
  template <std::size_t kCount>
  SIMDBEZIER_PART void evaluate(const T* from, std::size_t first, LinePart<T>* values) const {
    const V x = load_vector<V>(x_ + first);
    const bool ends = ends_[first];
    if (first + kLanes<V> <= n_) {
      repeat<kCount>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
        const T* const own = from + c * kCubicValues;
        values[c] = finished(
            x, ends, [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { return broadcast<V>(own[k]); });
      });
      return;
    }
    const MaskOf<V> of_next = number_ >= broadcast<V>(static_cast<T>(n_ - first));
    repeat<kCount>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      const T* const own = from + c * kCubicValues;
      values[c] = finished(x, ends, [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
        return select_where<V>(of_next, broadcast<V>(own[stride_ + k]), broadcast<V>(own[k]));
      });
    });
  }

private:
  /// value(k): coefficient k in each lane, and then both ends.
  template <typename Value>
  static SIMDBEZIER_PART LinePart<T> finished(V x, bool ends, const Value& value) {
    V result = row_series<0>(Order<kOrderOfCubics>(kOrderOfCubics), x, value).value;
    if (ends) {
      result = select_ends(x, value(kOrderOfCubics), value(kOrderOfCubics + 1), result);
    }
    return __builtin_bit_cast(LinePart<T>, result);
  }

  std::size_t n_;
  std::size_t stride_;
  V number_; ///< of each lane
  T x_[detail::kMostJoined + kLanes<V>];
  bool ends_[detail::kMostJoined]; ///< whether one of the lanes from there on is an end
};

/// What begins at one place within a line: triples, planes, or one plane alone. It is streamed from
/// the first line on that begins with a sample, as many samples at a time as a line has values.
template <bool kTriples, std::size_t kComponents, typename T>
class JoinedStream {
  using V = vec<T>;
  static constexpr std::size_t kStreams = kTriples ? 1 : kComponents;
  static constexpr std::size_t kMembers = kComponents / kStreams; ///< values of a sample in each

public:
  JoinedStream() = default;
  /// from: the values of the first curve's first component. Curves are `stride` apart.
  JoinedStream(const T* from, std::size_t stride, std::size_t curves, std::size_t n, T* const* to)
      : curve_(from), n_(n), stride_(stride), samples_(n * curves) {
    for (std::size_t k = 0; k < kStreams; ++k) {
      to_[k] = to[k];
    }
    const std::size_t begins = reinterpret_cast<std::uintptr_t>(to[0]) / sizeof(T);
    std::size_t head = 0;
    while ((begins + kMembers * head) % kLineSamples<T> != 0) {
      ++head;
    }
    head_ = std::min(head, samples_);
    end_ = head_ + (samples_ - head_) / kLineSamples<T> * kLineSamples<T>;
  }

  /// Writes the samples before those that are streamed.
  void write_head(const JoinedSamples<T>& samples) { write(samples, head_); }

  /// Streams whole lines of samples below `limit`. Curves are asked for ahead where that is wanted.
  SIMDBEZIER_PART void stream(const JoinedSamples<T>& samples, std::size_t limit, bool prefetch) {
    const std::size_t end = std::min(limit, end_);
    const T* curve = curve_;
    std::size_t first = first_;
    std::size_t place = place_;
    for (; place + kLanes<V> <= end; place += kLanes<V>) {
      constexpr std::size_t kStep = kMembers * kLanes<V>; // values
      if (is_turn_to_ask<T, kStep>(kMembers * place)) [[unlikely]] {
        repeat<kStreams>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
          ask_until_next_turn<kStep>(to_[k] + kMembers * place);
        });
      }
      LinePart<T> value[kComponents];
      samples.template evaluate<kComponents>(curve, first, value);
      if constexpr (kTriples) {
        LinePart<T> line[kComponents];
        form_records<T>(value, line);
        repeat<kComponents>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
          store_any<true>(to_[0] + kMembers * place + k * kLanes<V>, line[k]);
        });
      } else {
        repeat<kComponents>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
          store_any<true>(to_[k] + place, value[k]);
        });
      }
      first += kLanes<V>;
      if (first >= n_) {
        first -= n_;
        curve += stride_;
        if (prefetch) {
          prefetch_values(curve + kValuesAhead<T>, stride_);
        }
      }
    }
    curve_ = curve;
    first_ = first;
    place_ = place;
  }

  /// Writes what is left when all lines are streamed.
  void write_rest(const JoinedSamples<T>& samples) { write(samples, samples_); }

private:
  /// Writes samples up to `end` with plain stores. Nothing is read behind the last curve.
  SIMDBEZIER_KERNEL void write(const JoinedSamples<T>& samples, std::size_t end) {
    while (place_ < end) {
      const std::size_t from = std::min(first_, n_ - kLanes<V>);
      const std::size_t skipped = first_ - from;
      const std::size_t count = std::min(end - place_, kLanes<V> - skipped);
      LinePart<T> value[kComponents];
      samples.template evaluate<kComponents>(curve_, from, value);
      for (std::size_t i = 0; i < count; ++i, ++place_) {
        for (std::size_t c = 0; c < kComponents; ++c) {
          to_[c % kStreams][kMembers * place_ + c / kStreams] = value[c][skipped + i];
        }
      }
      first_ += count;
      if (first_ == n_) {
        first_ = 0;
        curve_ += stride_;
      }
    }
  }

  const T* curve_ = nullptr; ///< of the next sample
  std::size_t first_ = 0;    ///< number of the next sample in its curve
  std::size_t place_ = 0;    ///< and of all
  T* to_[kStreams] = {};
  std::size_t n_ = 0;
  std::size_t stride_ = 0;
  std::size_t samples_ = 0;
  std::size_t head_ = 0; ///< samples before those that are streamed
  std::size_t end_ = 0;  ///< samples up to the end of those
};

/// Streams the rows of all curves of a task. Planes that begin at different places within a line go
/// one by one, some curves at a time, so that these are read from memory once.
template <bool kTriples, typename T>
SIMDBEZIER_KERNEL void stream_joined(const CurveTask<T>& shared_task,
                                     const CurveRows<kTriples, T>& rows) {
  const CurveTask<T> task = shared_task;
  const std::size_t stride = shared_task.shape->values();
  const std::size_t channel = shared_task.shape->channel_values();
  const T* const from = task.values + task.first_component * channel;
  const std::size_t count = task.curve_count;
  const JoinedSamples<T> samples(task.x, task.n, stride);
  const auto place = [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    return reinterpret_cast<std::uintptr_t>(rows.first[k]) % 64;
  };
  if constexpr (!kTriples) {
    if (place(0) != place(1) || place(0) != place(2)) {
      JoinedStream<false, 1, T> plane[3];
      for (std::size_t c = 0; c < 3; ++c) {
        plane[c] = {from + c * channel, stride, count, task.n, rows.first + c};
        plane[c].write_head(samples);
      }
      constexpr std::size_t kTogether = 16;
      for (std::size_t begin = 0; begin < count; begin += kTogether) {
        const std::size_t end = std::min(begin + kTogether, count);
        for (std::size_t c = 0; c < 3; ++c) {
          plane[c].stream(samples, end * task.n, task.prefetch && c == 0);
        }
      }
      for (JoinedStream<false, 1, T>& p : plane) {
        p.write_rest(samples);
      }
      return;
    }
  }
  JoinedStream<kTriples, 3, T> stream(from, stride, count, task.n, rows.first);
  stream.write_head(samples);
  stream.stream(samples, count * task.n, task.prefetch);
  stream.write_rest(samples);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
