// One grid of every patch through each of the calls that can give it, in the order of the grid.
#pragma once

#include <algorithm>
#include <mutex>
#include <vector>

#include "tests/support/call_options.hpp"
#include "tests/support/canvas.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/workload.hpp"

namespace simdbezier::tests {

/// All that a tile can hold.
[[nodiscard]] inline OutputSelection everything() {
  OutputSelection all = selection_of(kAllVectors);
  all.add(Output::status);
  all.add(Output::curvature);
  return all;
}

class CallTest : public IsaTest {
protected:
  /// `wanted`: the outputs that are asked of all calls.
  explicit CallTest(Wanted wanted) : wanted_(wanted) {}

  template <typename T>
  [[nodiscard]] Planes<T> planes_of(const PatchSet<T>& set, const Grid<T>& samples) const {
    return Planes<T>(set.size() * samples.nu * samples.nv, wanted_);
  }

  template <typename T>
  [[nodiscard]] Planes<T> by_grid(const PatchSet<T>& set, const Grid<T>& samples,
                                  const CallOptions& options) {
    Planes<T> planes = planes_of(set, samples);
    grid(set, samples, planes.outputs(), options);
    return planes;
  }

  /// Calls of `piece` patches each; the samples of patch k at k * nu * nv.
  template <typename T>
  [[nodiscard]] Planes<T> by_patch_grids(const PatchSet<T>& set, const Grid<T>& samples,
                                         std::size_t piece, CallOptions options) {
    Planes<T> planes = planes_of(set, samples);
    const std::vector<std::uint32_t> nu(set.size(), static_cast<std::uint32_t>(samples.nu));
    const std::vector<std::uint32_t> nv(set.size(), static_cast<std::uint32_t>(samples.nv));
    for (std::size_t first = 0; first < set.size(); first += piece) {
      options.first_patch = first;
      options.patch_count = std::min(piece, set.size() - first);
      patch_grids(set, {nu, nv}, advanced(planes.outputs(), first * samples.nu * samples.nv),
                  options);
    }
    return planes;
  }

  template <typename T>
  [[nodiscard]] Planes<T> by_tiles(const PatchSet<T>& set, const Grid<T>& samples,
                                   const TileFormat& format, const CallOptions& options) {
    Planes<T> planes = planes_of(set, samples);
    std::mutex mutex;
    const auto take = [&](const Tile<T>& tile) {
      const std::lock_guard<std::mutex> lock(mutex);
      const std::size_t first = (tile.first_patch * samples.nv + tile.first_row) * samples.nu;
      copy_samples(tile.out, advanced(planes.outputs(), first), tile.samples);
    };
    tiles<T>(set, samples, format, take, options);
    return planes;
  }

  /// The grid of every patch as scattered samples.
  template <typename T>
  [[nodiscard]] Planes<T> by_scattered(const PatchSet<T>& set, const Grid<T>& samples,
                                       const CallOptions& options) {
    Planes<T> planes = planes_of(set, samples);
    const auto list =
        grid_parameters<T>(static_cast<int>(samples.nu), static_cast<int>(samples.nv));
    SampleArrays<T> arrays;
    for (std::size_t p = 0; p < set.size(); ++p) {
      for (const Parameters2<T>& at : list) {
        arrays.add(p, at.x, at.y);
      }
    }
    scattered(set, arrays.view(Parameters::centred), planes.outputs(), options);
    return planes;
  }

private:
  Wanted wanted_;
};

} // namespace simdbezier::tests
