// Which lines compete for the same places of a first-level cache.
#pragma once

#include <cstdint>

#include "kernels/simd/operands.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridTask;

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

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
