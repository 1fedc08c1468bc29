// Asks for patches, and for pages of outputs, that grid kernels will soon come to.
#pragma once

#include "kernels/simd/operands.hpp"
#include "kernels/simd/pages.hpp"
#include "src/storage/bicubic_layout.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::GridTask;

/// So many patches ahead, and where these are a few registers of positions alone.
constexpr std::size_t kPatchesAhead = 4;
constexpr std::size_t kSmallPatchesAhead = 16;

/// Asks for the edges of the patch that comes so far ahead and, unless these suffice, for its
/// coefficients. The hardware follows neither of the two arrays across the pauses between patches:
/// in a set that does not fit into the caches, grids run at 0.7 of their speed without this.
template <std::size_t kAhead = kPatchesAhead, typename T>
SIMDBEZIER_PART void prefetch_patch(const GridTask<T>& task, std::size_t patch,
                                    bool edges_suffice = false) {
  constexpr std::size_t kLine = 64 / sizeof(T);
  const T* const coefficients = task.coefficients + (patch + kAhead) * detail::kCoefficients;
  for (std::size_t k = 0; k < detail::kCoefficients && !edges_suffice; k += kLine) {
    prefetch_line(coefficients + k);
  }
  const T* const edges = task.edges + (patch + kAhead) * detail::kEdgeBlock;
  for (std::size_t k = 0; k < detail::kEdgeBlock; k += kLine) {
    prefetch_line(edges + k);
  }
}

/// Asks for the pages of outputs that go past the caches (simd/pages.hpp), one patch ahead, or as
/// many as fill a page. Plain stores gain up to a sixth by that, or lose up to a fifth.
template <typename T>
class PagesAhead {
public:
  /// The rows of a piece are written, of the task's patches in order. task: as the kernel was given
  /// it. A copy whose address is known would have to be in memory.
  template <typename Piece>
  SIMDBEZIER_PART PagesAhead(const GridTask<T>& task, const Piece& piece)
      : task_(task), first_(piece.first * task.nu), samples_(piece.rows() * task.nu) {
    const std::size_t bytes = samples_ * task.record * sizeof(T);
    together_ = bytes < kPage && samples_ == task.patch_step ? kPage / bytes : 1;
    due_ = task.streaming && bytes <= kMostPages * kPage ? 0 : task.patch_count;
  }
  /// Patches up to `patch` are about to be written.
  SIMDBEZIER_PART void come_to(std::size_t patch) {
    if (patch >= due_) [[unlikely]] {
      ask(patch);
    }
  }

private:
  /// Pages of each plane. Of longer pieces they would be forgotten until their turn.
  static constexpr std::size_t kMostPages = 16;

  SIMDBEZIER_KERNEL void ask(std::size_t patch) {
    const std::size_t record = task_.record * sizeof(T);
    const std::size_t kinds = task_.record > 1 ? 1 : 3; // the other components lie beside it
    const std::size_t samples = together_ * samples_;
    for (; due_ <= patch; due_ += together_) {
      const std::size_t at = (due_ + together_) * task_.patch_step + first_;
      for (const detail::Planes<T>& planes : task_.out) {
        for (std::size_t c = 0; c < kinds && planes.component[c] != nullptr; ++c) {
          const auto first = reinterpret_cast<std::uintptr_t>(planes.component[c]);
          ask_for_pages(first + at * record, samples * record);
        }
      }
    }
  }

  const GridTask<T>& task_;
  std::size_t first_;    ///< of a patch's samples
  std::size_t samples_;  ///< of each patch
  std::size_t together_; ///< patches, of a page where one is less
  std::size_t due_;      ///< patches whose time has come
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
