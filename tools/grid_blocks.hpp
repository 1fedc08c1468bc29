// A grid call cut into blocks of bounded size, so that memory does not grow with the output.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <simdbezier/simdbezier.hpp>

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

/// Larger grids and results are refused: a typo is likelier than a wish.
inline constexpr std::size_t kMostPerDirection = std::size_t{1} << 20;
inline constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 40;

/// patches * nu * nv. Throws Failure (bad usage) where the results, at `bytes_per_sample` each,
/// cannot be counted or exceed kMostBytes.
[[nodiscard]] std::uint64_t checked_sample_count(std::size_t patches, const GridSize& grid,
                                                 std::size_t bytes_per_sample);

/// Calls f(block) for blocks in output order: patch, then row.
template <typename F>
void for_each_block(std::size_t patches, const GridSize& grid, F&& f) {
  constexpr std::size_t kBlockSamples = std::size_t{1} << 18;
  const std::size_t patches_per_block =
      std::max<std::size_t>(1, kBlockSamples / (grid.nu * grid.nv));
  const std::size_t rows_per_block = std::clamp<std::size_t>(kBlockSamples / grid.nu, 1, grid.nv);
  for (std::size_t p = 0; p < patches; p += patches_per_block) {
    const std::size_t patch_count = std::min(patches_per_block, patches - p);
    for (std::size_t row = 0; row < grid.nv; row += rows_per_block) {
      f(GridBlock{p, patch_count, row, std::min(rows_per_block, grid.nv - row)});
    }
  }
}

/// Evaluates the blocks of one set on one uniform grid.
template <typename T>
class GridEvaluator {
public:
  GridEvaluator(const PatchSet<T>& set, const GridSize& grid, int threads);
  /// Throws Failure where the library reports an error.
  void evaluate(const GridBlock& block, const Outputs<T>& out) const;

private:
  PatchSet<T> set_;
  GridSize grid_;
  int threads_;
  std::vector<T> x_; // the uniform grid's centred parameters, for blocks of rows
  std::vector<T> y_;
};

} // namespace simdbezier::tools
