// Grids whose rows lie a multiple of 512 bytes apart, in strips of a few rows.
//
// Kernels sweep one register of columns after the other, each through all rows, unless they sweep
// whole rows in bands (kernels/fast/row_bands.hpp, normal_bands.hpp). Lines at such distances share
// an eighth of the sets of a first-level cache, or fewer: with more rows than there is room for,
// lines leave it before the next register comes to them, which takes up to ten times as long.
// Numbers here are measured (docs/experiments.md, Grids in cache).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

inline constexpr std::size_t kMostStripRows = 32;

/// Whether a task of kAnyOutputs, which stands for patches of any shape as well, wants positions
/// alone.
template <typename T>
[[nodiscard]] bool wants_positions_only(const GridTask<T>& task) noexcept {
  const auto wanted = std::count_if(std::begin(task.out), std::end(task.out),
                                    [](const Planes<T>& planes) { return planes.wanted(); });
  return wanted == 1 && task.out[output_index(Output::position)].wanted();
}

/// How many rows kernels sweep in one go that compute `outputs`, with registers of so many bytes.
template <typename T>
[[nodiscard]] std::size_t strip_rows(const GridTask<T>& task, OutputSet outputs,
                                     std::size_t register_bytes) noexcept {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  const std::size_t row = task.nu * sizeof(T);
  const std::size_t distance = row & (~row + 1); // the largest power of two in it
  const bool line_wide = register_bytes == 64;
  // What is staged, or goes to memory in whole lines, has other limits. What kernels sweep in bands
  // (kernels/fast/row_bands.hpp) comes to each line once, and has room until each row is a page.
  const bool in_bands =
      task.origins == nullptr && distance < 4096 &&
      (outputs == kPositionNormal ? register_bytes >= 16
       : outputs == kPosition     ? register_bytes == 32
                                  : register_bytes >= 32 && outputs == kPositionDerivatives);
  const bool leaves = task.drain != nullptr || (line_wide && task.plain_to_memory);
  if (distance < 512 || task.streaming || task.record > 1 || leaves || in_bands) {
    return kAll;
  }
  // One plane, and lines that are stored whole, have enough room until they share still fewer sets;
  // and curvatures take so long that no cache matters.
  const bool roomy = outputs == kPosition || (line_wide && outputs != kPositionNormal);
  const bool slow = std::any_of(std::begin(task.curvature), std::end(task.curvature),
                                [](const T* plane) { return plane != nullptr; });
  if (slow || (roomy && distance < 1024)) {
    return kAll;
  }
  // Each strip finds the polynomials of its columns anew, which weighs more with all outputs, and
  // more beside few.
  const bool heavy = outputs == kAnyOutputs && (task.out[output_index(Output::normal)].wanted() ||
                                                wants_positions_only(task));
  const std::size_t bytes = outputs == kPosition ? 32768 : heavy ? 16384 : 8192;
  return std::clamp<std::size_t>(bytes / distance, 4, kMostStripRows);
}

/// Whether a task has rows for two strips and more: a short second one would cost more than it
/// saves.
template <typename T>
[[nodiscard]] bool fills_strips(const GridTask<T>& task, std::size_t most) noexcept {
  std::size_t rows = 0;
  for (std::size_t r = 0; r < task.run_count && rows < 2 * most; ++r) {
    rows += task.runs[r].rows;
  }
  return rows >= 2 * most;
}

/// Calls run(strip) for each strip of a task without curvatures: the same rows of each of its
/// patches, at most `most`, which is no more than kMostStripRows.
template <typename T, typename Run>
void in_strips(GridTask<T>& task, std::size_t most, const Run& run) noexcept {
  GridTask<T> strip = task;
  RowRun<T> runs[kMostStripRows];
  strip.runs = runs;
  std::size_t taken = 0; // rows of task.runs[r]
  for (std::size_t r = 0; r < task.run_count;) {
    strip.run_count = 0;
    std::size_t rows = 0;
    while (r < task.run_count && rows < most) {
      const RowRun<T>& from = task.runs[r];
      const std::size_t count = std::min<std::size_t>(from.rows - taken, most - rows);
      runs[strip.run_count++] = {from.y + taken, static_cast<std::uint32_t>(count), from.kind};
      rows += count;
      taken += count;
      if (taken == from.rows) {
        taken = 0;
        ++r;
      }
    }
    run(strip);
    const auto go_on = [&](auto*& first) { first += first == nullptr ? 0 : rows * task.nu; };
    for (Planes<T>& planes : strip.out) {
      std::for_each(std::begin(planes.component), std::end(planes.component), go_on);
    }
    go_on(strip.status);
  }
  task.executed = strip.executed;
  task.taken = strip.taken;
}

} // namespace simdbezier::detail
