// A grid call cut into blocks of bounded size, so that memory does not grow with the output.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/patches/pack_patches.hpp>

namespace simdbezier::tools {

struct GridSize {
  std::size_t nu = 16;
  std::size_t nv = 16;
};

/// Some patches with all their rows, or some rows of one patch.
struct GridBlock {
  std::size_t first_patch = 0;
  std::size_t patch_count = 0;
  std::size_t first_row = 0;
  std::size_t row_count = 0;

  [[nodiscard]] std::size_t samples(const GridSize& grid) const noexcept {
    return patch_count * row_count * grid.nu;
  }
};

inline constexpr std::size_t kBlockSamples = std::size_t{1} << 18;

/// Larger grids and results are refused, because they are most likely a typing error.
inline constexpr std::size_t kMostPerDirection = std::size_t{1} << 20;
inline constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 40;

/// Returns patches * nu * nv. Throws Failure (bad usage) where the results, at `bytes_per_sample`
/// each, cannot be counted or exceed kMostBytes.
[[nodiscard]] std::uint64_t checked_sample_count(std::size_t patches, const GridSize& grid,
                                                 std::size_t bytes_per_sample);

/// Returns how many patches make a block of moderate size.
[[nodiscard]] constexpr std::size_t patches_per_block(const GridSize& grid) noexcept {
  // A block has neither many samples nor many packed patches.
  return std::clamp<std::size_t>(kBlockSamples / (grid.nu * grid.nv), 1, kBlockPatches);
}

/// Calls f(block) for blocks in output order: patch, then row.
template <typename F>
void for_each_block(std::size_t patches, const GridSize& grid, F&& f) {
  const std::size_t most = patches_per_block(grid);
  const std::size_t rows_per_block = std::clamp<std::size_t>(kBlockSamples / grid.nu, 1, grid.nv);
  for (std::size_t p = 0; p < patches; p += most) {
    const std::size_t patch_count = std::min(most, patches - p);
    for (std::size_t row = 0; row < grid.nv; row += rows_per_block) {
      f(GridBlock{p, patch_count, row, std::min(rows_per_block, grid.nv - row)});
    }
  }
}

/// Evaluates the blocks of a file's patches on one uniform grid. Only a block's patches are packed
/// at a time, because all of them would take several times the memory of the file.
template <typename T>
class GridEvaluator {
public:
  /// Throws Failure where T cannot hold one of the patches, before anything is evaluated.
  GridEvaluator(const PatchFile& file, const GridSize& grid, int threads);
  /// Throws Failure where the library reports an error.
  void evaluate(const GridBlock& block, const Outputs<T>& out);

private:
  void pack(std::size_t first, std::size_t count);

  const PatchFile& file_;
  GridSize grid_;
  int threads_;
  std::vector<T> x_; // the uniform grid's centred parameters, which blocks of rows take
  std::vector<T> y_;
  PatchSet<T> set_; // the patches from first_ on
  std::size_t first_ = 0;
};

} // namespace simdbezier::tools
