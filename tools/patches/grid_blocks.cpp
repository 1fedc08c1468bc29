#include <tools/patches/grid_blocks.hpp>

#include <span>
#include <string>

#include <tools/patches/library_status.hpp>
#include <tools/patches/pack_patches.hpp>
#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

// (2i-N)/N by one division, as the library defines its uniform grid, so that bits are equal.
template <typename T>
std::vector<T> uniform_parameters(std::size_t count) {
  std::vector<T> x(count);
  const auto intervals = static_cast<std::ptrdiff_t>(count - 1);
  for (std::ptrdiff_t i = 0; i <= intervals; ++i) {
    x[static_cast<std::size_t>(i)] = static_cast<T>(2 * i - intervals) / static_cast<T>(intervals);
  }
  return x;
}

} // namespace

std::uint64_t checked_sample_count(std::size_t patches, const GridSize& grid,
                                   std::size_t bytes_per_sample) {
  const Count samples = Count(patches) * grid.nu * grid.nv;
  if (!(samples * bytes_per_sample).within(kMostBytes)) {
    bad_usage("--grid: expected at most " + std::to_string(kMostBytes) +
              " bytes of results, found " + quantity(patches, "patch", "patches") + " of " +
              std::to_string(grid.nu) + "x" + std::to_string(grid.nv) + " samples of " +
              std::to_string(bytes_per_sample) + " bytes");
  }
  return *samples.value();
}

template <typename T>
GridEvaluator<T>::GridEvaluator(const PatchFile& file, const GridSize& grid, int threads)
    : file_(file), grid_(grid), threads_(threads), x_(uniform_parameters<T>(grid.nu)),
      y_(uniform_parameters<T>(grid.nv)) {
  const std::size_t most = patches_per_block(grid);
  for (std::size_t p = 0; p < file.count; p += most) {
    pack(p, std::min(most, file.count - p));
  }
}

template <typename T>
void GridEvaluator<T>::pack(std::size_t first, std::size_t count) {
  if (set_.size() != count || first_ != first) {
    set_ = PatchSet<T>(); // frees memory that the next set may take
    set_ = pack_patches<T>(file_, first, count);
    first_ = first;
  }
}

template <typename T>
void GridEvaluator<T>::evaluate(const GridBlock& block, const Outputs<T>& out) {
  pack(block.first_patch, block.patch_count);
  Options options;
  options.threads = threads_;
  Grid<T> grid = Grid<T>::uniform(grid_.nu, grid_.nv);
  if (block.row_count != grid_.nv) {
    grid = Grid<T>::at(x_, std::span(y_).subspan(block.first_row, block.row_count),
                       Parameters::centred);
  }
  check(simdbezier::evaluate(set_, grid, out, options));
}

template class GridEvaluator<float>;
template class GridEvaluator<double>;

} // namespace simdbezier::tools
