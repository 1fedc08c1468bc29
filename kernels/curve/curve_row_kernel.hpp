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

/// Straight to the caller's memory.
template <std::size_t kOrder, bool kAcross, bool kTriples, typename T>
SIMDBEZIER_INLINE void write_rows(const CurveTask<T>& task, const CurveShape& shape,
                                  const CurveRows<kTriples, T>& out, T* memory) {
  constexpr std::size_t kAll = kLanes<vec<T>>;
  const std::size_t row = out.row(task.n);
  const std::size_t count = task.curve_count;
  const auto nothing = []() SIMDBEZIER_INLINE_LAMBDA {};
  if constexpr (kAcross) {
    const std::size_t whole = count / kAll * kAll;
    fill_across<kOrder>(task, shape, 0, whole, out, nothing);
    if (whole < count) {
      CurveRows<kTriples, T> rows;
      for (std::size_t k = 0; k < out.kStreams; ++k) {
        rows.first[k] = memory + k * kAll * row;
      }
      fill_across<kOrder>(task, shape, whole, count, rows, nothing);
      for (std::size_t k = 0; k < out.kStreams; ++k) {
        __builtin_memcpy(out.first[k] + whole * row, rows.first[k],
                         (count - whole) * row * sizeof(T));
      }
    }
  } else {
    const std::size_t batch = std::max<std::size_t>(kRowBatch<T> / (3 * task.n), 1);
    for (std::size_t begin = 0; begin < count; begin += batch) {
      fill_along<kOrder>(task, shape, begin, std::min(begin + batch, count), out.at(begin * row),
                         task.streaming, nothing);
    }
  }
}

/// By way of rings, past the caches.
template <std::size_t kOrder, bool kAcross, bool kTriples, typename T>
SIMDBEZIER_INLINE void stream_rows(const CurveTask<T>& task, const CurveShape& shape,
                                   const CurveRows<kTriples, T>& out, T* memory) {
  constexpr std::size_t kStreams = CurveRows<kTriples, T>::kStreams;
  // What a step computes, in lines.
  constexpr std::size_t kValues = 3 * kLanes<vec<T>> * (kAcross ? kAcrossStep : 1);
  constexpr std::size_t kLines = (kValues * sizeof(T) + 63) / 64;
  const std::size_t row = out.row(task.n);
  const std::size_t groups = kRowBatch<T> / (3 * task.n * kLineCurves<T>);
  const std::size_t batch = std::max<std::size_t>(groups, 1) * kLineCurves<T>;
  LineRing<T> ring[kStreams];
  for (std::size_t k = 0; k < kStreams; ++k) {
    ring[k].start(memory, batch * row, out.first[k]);
    memory += LineRing<T>::room(batch * row);
  }
  const auto pass_on = [&]() SIMDBEZIER_INLINE_LAMBDA {
    std::size_t lines = kLines;
    for (std::size_t k = 0; k < kStreams && lines > 0; ++k) {
      lines = ring[k].pass_on(lines);
    }
  };
  for (std::size_t begin = 0; begin < task.curve_count; begin += batch) {
    const std::size_t end = std::min(begin + batch, task.curve_count);
    CurveRows<kTriples, T> rows;
    for (std::size_t k = 0; k < kStreams; ++k) {
      rows.first[k] = ring[k].batch();
    }
    if constexpr (kAcross) {
      fill_across<kOrder>(task, shape, begin, end, rows, pass_on);
    } else {
      fill_along<kOrder>(task, shape, begin, end, rows, false, pass_on);
    }
    for (LineRing<T>& r : ring) {
      r.pass_all();
      r.turn((end - begin) * row);
    }
  }
  for (LineRing<T>& r : ring) {
    r.finish();
  }
}

/// Whether every register of samples is whole lines of triples.
template <typename T>
SIMDBEZIER_INLINE bool are_whole_lines(const CurveTask<T>& task) {
  return task.triples != nullptr && kLineWide<vec<T>> && task.n % kLanes<vec<T>> == 0 &&
         reinterpret_cast<std::uintptr_t>(task.triples) % 64 == 0;
}

template <std::size_t kOrder, bool kAcross, bool kTriples, typename T>
__attribute__((noinline)) void evaluate_rows(const CurveTask<T>& shared_task) {
  const CurveTask<T> task = shared_task;
  CurveShape shape = *shared_task.shape;
  if constexpr (kOrder > 0) {
    shape.degree = static_cast<int>(kOrder) - 1; // a constant for the compiler
  }
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
  if (task.streaming && (kAcross || !are_whole_lines(task))) {
    stream_rows<kOrder, kAcross>(task, shape, out, memory);
  } else {
    write_rows<kOrder, kAcross>(task, shape, out, memory);
  }
}

template <std::size_t kOrder, typename T>
SIMDBEZIER_INLINE void evaluate_rows_of(const CurveTask<T>& task) {
  const bool triples = task.triples != nullptr;
  if (task.n >= kLanes<vec<T>>) {
    return triples ? evaluate_rows<kOrder, false, true>(task)
                   : evaluate_rows<kOrder, false, false>(task);
  }
  if constexpr (kLanes < vec < T >>> detail::kLeastRow) {
    return triples ? evaluate_rows<kOrder, true, true>(task)
                   : evaluate_rows<kOrder, true, false>(task);
  }
}

template <typename T>
SIMDBEZIER_INLINE void evaluate_rows(const CurveTask<T>& task) {
  if (task.shape->degree == 3) {
    evaluate_rows_of<4>(task);
  } else {
    evaluate_rows_of<0>(task);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
