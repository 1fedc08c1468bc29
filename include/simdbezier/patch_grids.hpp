// Per-patch grids: every patch with a tessellation factor of its own.
#pragma once

#include <cstddef>
#include <cstdint>

#include <simdbezier/evaluate.hpp>

namespace simdbezier {

/// Uniform grids, ends included, one a patch, their samples in compressed-row form: sample
/// (iu, iv) of the k-th patch evaluated has index offset[k] + iv * nu[k] + iu.
struct PatchGrids {
  const std::uint32_t* nu = nullptr; ///< one value a patch evaluated, 2 or more
  const std::uint32_t* nv = nullptr; ///< as nu
  /// Where each patch's samples begin, ascending by nu*nv or more (samples in between are not
  /// touched). Null: packed without gaps.
  const std::size_t* offset = nullptr;
};

/// Evaluates patches [first_patch, first_patch + patch_count) of the set, each on its own grid.
/// Values are those of evaluate_grid() on each patch alone, bit for bit. Work is divided between
/// threads by samples, a dense patch's rows among several of them.
/// Outputs count as overlapping where their whole ranges do, from index 0 to the last sample.
/// Allocation: 8 bytes a patch and scratch per thread, a call.
/// Returns ok | null_input (nu or nv, with patches to evaluate) | null_output | bad_components |
/// bad_stride | overlapping_outputs | bad_grid | bad_offsets | bad_patch_range | size_overflow |
/// unknown_isa | unsupported_isa | out_of_memory. On an error nothing has been written.
template <typename T>
[[nodiscard]] SIMDBEZIER_API Status evaluate_patch_grids(const PatchSet<T>& set,
                                                         const PatchGrids& grids,
                                                         const Outputs<T>& out,
                                                         const Options& options = {}) noexcept;

} // namespace simdbezier
