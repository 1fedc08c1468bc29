// Curves on common parameters, some of them at a time: blocks of curves, registers of a curve's
// samples, and the places of one register of all curves of a block.
//
// A curve of n samples takes whole registers, the last of which may repeat samples of the one
// before. Where n is less than a register, its idle lanes are written all the same, into the place
// of the next curve, which comes later; only the end of the task is masked. Neither costs what a
// masked store would, and lanes are independent, so the bits are those of any other arrangement.
#pragma once

#include "kernels/curve/curve_outputs.hpp"
#include "kernels/curve/curve_rows.hpp"
#include "kernels/drain/drain_kernel.hpp"

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

/// Asks for the pages of whole lines that go past the caches: those behind samples
/// [begin, begin + count), which are written next.
template <typename T>
SIMDBEZIER_INLINE void ask_for_planes(const CurveTask<T>& task, std::size_t begin,
                                      std::size_t count) {
  for (const auto& planes : task.out) {
    for (const T* const plane : planes.component) {
      if (plane != nullptr) {
        ask_for_pages(page_behind(plane + begin), count * sizeof(T));
      }
    }
  }
}

/// Calls body(block) for all curves of a task, and passes on what was staged before in between.
template <typename T, typename Body>
SIMDBEZIER_INLINE void for_curve_blocks(const CurveTask<T>& task, std::size_t values, Body body) {
  const std::size_t most = task.n < kBlockSamples ? kBlockSamples / task.n : 1;
  for (std::size_t begin = 0; begin < task.curve_count; begin += most) {
    const std::size_t left = task.curve_count - begin;
    const CurveBlock block{begin, begin + (left < most ? left : most)};
    if (task.streaming) {
      ask_for_planes(task, begin * task.n, (block.end - begin) * task.n);
    }
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

/// Returns how many values a task writes for each sample, so far as they are vectors.
template <typename T>
SIMDBEZIER_PART std::size_t values_per_sample(const CurveTask<T>& task) {
  std::size_t values = 0;
  for (const auto& planes : task.out) {
    values += planes.wanted() ? 3 : 0;
  }
  return values;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
