// Positions of curves straight to the caller's layout: planes or x y z triples, through the caches
// or past them, at any place in memory. Values are read in order without a pause, so hardware
// fetches them ahead; prefetches gain nothing.
#pragma once

#include "kernels/curve/lanes_are_curves.hpp"
#include "kernels/curve/lanes_are_samples.hpp"
#include "kernels/simd/line_ring.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Curves that are whole lines, whatever the number of samples.
template <typename T>
inline constexpr std::size_t kLineCurves = 64 / sizeof(T);

/// Values that are passed on while as many are computed, or those of kLineCurves where they are
/// more. Few, because lines that coefficients push out of the first-level cache cost a store as
/// much as the way to memory; but stores must have reached that cache before they are read.
template <typename T>
inline constexpr std::size_t kRowBatch = 2048 / sizeof(T);

/// Room for rings of all planes, and for what is put together before it is copied.
template <typename T>
inline constexpr std::size_t kRowMemory = 2 * (3 * detail::kMostRow + 3) * kLineCurves<T>;

/// Rings that rows go through on their way past the caches, and how much of them is passed on at a
/// time.
template <bool kTriples, typename T>
struct RowRings {
  static constexpr std::size_t kStreams = CurveRows<kTriples, T>::kStreams;
  LineRing<T> ring[kStreams];
  std::size_t lines_per_step = 0;

  SIMDBEZIER_INLINE void pass_on() {
    std::size_t lines = lines_per_step;
    for (std::size_t k = 0; k < kStreams && lines > 0; ++k) {
      lines = ring[k].pass_on(lines);
    }
  }
  [[nodiscard]] SIMDBEZIER_INLINE CurveRows<kTriples, T> batch() const {
    CurveRows<kTriples, T> rows;
    for (std::size_t k = 0; k < kStreams; ++k) {
      rows.first[k] = ring[k].batch();
    }
    return rows;
  }
};

/// Curves [begin, end) to rows, `batch` at a time; rings: passed on meanwhile, null where there are
/// none. A function of its own, because it is large and there are several ways to it.
template <std::size_t kKnownOrder, bool kAcross, bool kTriples, typename T>
__attribute__((noinline)) void
fill_rows(const CurveTask<T>& shared_task, std::size_t begin, std::size_t end, std::size_t batch,
          const CurveRows<kTriples, T>& shared_rows, bool streaming, RowRings<kTriples, T>* rings) {
  // Copies, because stores through vector types might change anything that others can see.
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  assume_order<kKnownOrder>(shape);
  const CurveRows<kTriples, T> rows = shared_rows;
  RowRings<kTriples, T> ring_state;
  if (rings != nullptr) {
    ring_state = *rings;
  }
  const bool streams = rings != nullptr;
  const auto pass_on = [&]() SIMDBEZIER_INLINE_LAMBDA {
    if (streams) {
      ring_state.pass_on();
    }
  };
  if constexpr (kAcross) {
    fill_across<kKnownOrder>(task, shape, begin, end, rows, pass_on);
  } else if (streams) {
    fill_along<kKnownOrder>(task, shape, begin, end, rows, false, pass_on);
  } else { // without a test after every register: 5 % of streaming stores
    for (std::size_t first = begin; first < end; first += batch) {
      fill_along<kKnownOrder>(task, shape, first, std::min(first + batch, end),
                              rows.at((first - begin) * rows.row(task.n)), streaming,
                              []() SIMDBEZIER_INLINE_LAMBDA {});
    }
  }
  if (rings != nullptr) {
    *rings = ring_state;
  }
}

/// fill_rows() for some degrees and directions of lanes.
template <bool kTriples, typename T>
using FillRows = void (*)(const CurveTask<T>& task, std::size_t begin, std::size_t end,
                          std::size_t batch, const CurveRows<kTriples, T>& rows, bool streaming,
                          RowRings<kTriples, T>* rings);

/// Straight to the caller's memory. across: lanes are curves.
template <bool kTriples, typename T>
SIMDBEZIER_INLINE void write_rows(const CurveTask<T>& task, const CurveRows<kTriples, T>& out,
                                  bool across, FillRows<kTriples, T> fill, T* memory) {
  constexpr std::size_t kAll = kLanes<vec<T>>;
  const std::size_t row = out.row(task.n);
  const std::size_t count = task.curve_count;
  if (!across) {
    const std::size_t batch = std::max<std::size_t>(kRowBatch<T> / (3 * task.n), 1);
    return fill(task, 0, count, batch, out, task.streaming, nullptr);
  }
  const std::size_t whole = count / kAll * kAll;
  fill(task, 0, whole, whole, out, false, nullptr);
  if (whole < count) {
    CurveRows<kTriples, T> rows;
    for (std::size_t k = 0; k < out.kStreams; ++k) {
      rows.first[k] = memory + k * kAll * row;
    }
    fill(task, whole, count, count, rows, false, nullptr);
    for (std::size_t k = 0; k < out.kStreams; ++k) {
      __builtin_memcpy(out.first[k] + whole * row, rows.first[k],
                       (count - whole) * row * sizeof(T));
    }
  }
}

/// By way of rings, past the caches.
template <bool kTriples, typename T>
SIMDBEZIER_INLINE void stream_rows(const CurveTask<T>& task, const CurveRows<kTriples, T>& out,
                                   bool across, FillRows<kTriples, T> fill, T* memory) {
  const std::size_t row = out.row(task.n);
  const std::size_t groups = kRowBatch<T> / (3 * task.n * kLineCurves<T>);
  const std::size_t batch = std::max<std::size_t>(groups, 1) * kLineCurves<T>;
  RowRings<kTriples, T> rings;
  // What a step computes, in lines.
  const std::size_t values = 3 * kLanes<vec<T>> * (across ? kAcrossStep : 1);
  rings.lines_per_step = (values * sizeof(T) + 63) / 64;
  for (std::size_t k = 0; k < out.kStreams; ++k) {
    rings.ring[k].start(memory, batch * row, out.first[k]);
    memory += LineRing<T>::room(batch * row);
  }
  for (std::size_t begin = 0; begin < task.curve_count; begin += batch) {
    const std::size_t end = std::min(begin + batch, task.curve_count);
    fill(task, begin, end, batch, rings.batch(), false, &rings);
    for (LineRing<T>& r : rings.ring) {
      r.pass_all();
      r.turn((end - begin) * row);
    }
  }
  for (LineRing<T>& r : rings.ring) {
    r.finish();
  }
}

/// Whether every register of samples is whole lines of triples.
template <typename T>
SIMDBEZIER_INLINE bool are_whole_lines(const CurveTask<T>& task) {
  return task.triples != nullptr && kLineWide<vec<T>> && task.n % kLanes<vec<T>> == 0 &&
         reinterpret_cast<std::uintptr_t>(task.triples) % 64 == 0;
}

template <bool kTriples, typename T>
__attribute__((noinline)) void evaluate_rows(const CurveTask<T>& task, bool across,
                                             FillRows<kTriples, T> fill) {
  CurveRows<kTriples, T> out;
  if constexpr (kTriples) {
    out.first[0] = task.triples;
  } else {
    for (std::size_t c = 0; c < 3; ++c) {
      out.first[c] = task.out[detail::kCurvePosition].component[c];
    }
  }
  static_assert(kRowBatch<T> <= 3 * detail::kMostRow * kLineCurves<T>);
  alignas(64) T memory[kRowMemory<T>];
  if (task.streaming && (across || !are_whole_lines(task))) {
    stream_rows(task, out, across, fill, memory);
  } else {
    write_rows(task, out, across, fill, memory);
  }
}

/// Rows of fewer samples than a register have curves in its lanes.
template <bool kTriples, typename T>
SIMDBEZIER_INLINE void evaluate_rows(const CurveTask<T>& task) {
  const bool cubic = task.shape->degree == 3;
  if constexpr ((kLanes<vec<T>>) > detail::kLeastRow) {
    if (task.n < kLanes<vec<T>>) {
      return evaluate_rows<kTriples, T>(
          task, true, cubic ? fill_rows<4, true, kTriples, T> : fill_rows<0, true, kTriples, T>);
    }
  }
  evaluate_rows<kTriples, T>(
      task, false, cubic ? fill_rows<4, false, kTriples, T> : fill_rows<0, false, kTriples, T>);
}

template <typename T>
SIMDBEZIER_INLINE void evaluate_rows(const CurveTask<T>& task) {
  task.triples != nullptr ? evaluate_rows<true>(task) : evaluate_rows<false>(task);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
