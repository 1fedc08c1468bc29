// Which rows go in bands (fast/row_bands.hpp), and which lines compete for the same places of a
// first-level cache.
#pragma once

#include <cstdint>

#include "kernels/grid/patch_sweeps.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Whether the lines that a tile writes to these planes stay in the first-level cache, of 64 sets
/// and 8 lines each, until the next tile comes to the same sets: rows that lie a power of two apart
/// use few sets, and so do planes that begin at the same place within such a distance.
template <typename T, std::size_t kPlanes>
SIMDBEZIER_PART bool lines_stay(const GridTask<T>& task, const T* const (&planes)[kPlanes],
                                std::size_t rows) {
  constexpr std::size_t kSetBytes = 64 * 64;
  // Registers of a fourth of a line come to each line so often that half of them are too many. In
  // WebAssembly, what is swept instead gains less.
  constexpr std::size_t kLines = kLanes<vec<T>> * sizeof(T) < 32 && !kSimd128 ? 4 : 8;
  const std::size_t row = task.nu * sizeof(T);
  const std::size_t distance = row & (~row + 1); // the largest power of two in it
  const auto place = [&](const T* plane) SIMDBEZIER_INLINE_LAMBDA {
    return reinterpret_cast<std::uintptr_t>(plane) % distance / 64;
  };
  std::size_t most = 0;
  for (const T* const a : planes) {
    std::size_t together = 0;
    for (const T* const b : planes) {
      together += place(a) == place(b) ? 1 : 0;
    }
    most = together > most ? together : most;
  }
  return most * rows * distance <= kLines * kSetBytes;
}

/// Whether there are bands. Normals take so much arithmetic that stores do not matter, and so do
/// positions where a tile is a line or two; of shorter registers too many would have to lie side by
/// side.
template <detail::OutputSet kOutputs, typename T>
constexpr bool kSweepsBands = kMakesLines<vec<T>> &&
                              (kOutputs == detail::kPositionDerivatives ||
                               (kOutputs == detail::kPosition && !kLineWide<vec<T>>));

/// The most registers of a band. Each number from two on has code of its own, and more would gain
/// less than theirs costs.
template <typename V>
constexpr std::size_t kMostInBand = kLineWide<V> ? 4 : 8;

/// Whether rows of the task lie a multiple of 512 bytes apart, and leave the cache while one tile
/// follows the other. Below 4096 bytes there are no strips of such rows
/// (src/choice/row_strips.hpp).
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool rows_leave(const GridTask<T>& task, std::size_t rows) {
  if (task.nu * sizeof(T) % 512 != 0) {
    return false;
  }
  const auto& position = task.out[output_index(Output::position)].component;
  if constexpr (kOutputs == detail::kPosition) {
    const T* const planes[] = {position[0], position[1], position[2]};
    return !lines_stay(task, planes, rows);
  } else {
    const T* const planes[] = {position[0], task.out[output_index(Output::du)].component[0],
                               task.out[output_index(Output::dv)].component[0]};
    return !lines_stay(task, planes, rows);
  }
}

/// Returns the number of registers that a row takes.
template <typename V>
SIMDBEZIER_PART std::size_t band_registers(std::size_t nu) {
  return (nu + kLanes<V> - 1) / kLanes<V>;
}

/// Whether bands are faster than tiles. In staging, samples are passed on in smaller portions tile
/// by tile.
template <detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART bool pays_in_bands(const GridTask<T>& task, const RowPiece<T>& piece) {
  using V = vec<T>;
  constexpr bool kPositions = kOutputs == detail::kPosition;
  const std::size_t registers = band_registers<V>(task.nu);
  if (task.drain != nullptr) {
    return false;
  }
  if (rows_leave<kOutputs>(task, piece.rows())) {
    return true;
  }
  // Positions that are whole lines are as fast in pairs of registers. By plain stores to memory,
  // rows of a few lines go slowly in any order but that of tiles. A single column behind one
  // register goes along with it.
  const bool whole_lines = task.nu * sizeof(T) % 64 == 0;
  if (kPositions && (whole_lines || (task.plain_to_memory && registers < 5))) {
    return false;
  }
  const bool single = task.nu == kLanes<V> + 1;
  return registers >= 2 && !single && piece.rows() >= 5; // few rows are not worth the preparations
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
