// Asks for patches that grid kernels will soon come to.
#pragma once

#include "kernels/simd/operands.hpp"
#include "src/storage/bicubic_layout.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridTask;

/// So many patches ahead.
constexpr std::size_t kPatchesAhead = 4;

/// Asks for the coefficients and edges of the patch that comes so far ahead. Hardware follows
/// neither of the two arrays across the pauses in between: 30 % of the speed where the set is in
/// memory.
template <typename T>
SIMDBEZIER_PART void prefetch_patch(const GridTask<T>& task, std::size_t patch) {
  constexpr std::size_t kLine = 64 / sizeof(T);
  const T* const coefficients = task.coefficients + (patch + kPatchesAhead) * detail::kCoefficients;
  for (std::size_t k = 0; k < detail::kCoefficients; k += kLine) {
    prefetch_line(coefficients + k);
  }
  const T* const edges = task.edges + (patch + kPatchesAhead) * detail::kEdgeBlock;
  for (std::size_t k = 0; k < detail::kEdgeBlock; k += kLine) {
    prefetch_line(edges + k);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
