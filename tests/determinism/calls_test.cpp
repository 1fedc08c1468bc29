// Equal bits whichever call a sample comes through, with any number of threads, batch and tile
// size, and destination.
#include <mutex>

#include <gtest/gtest.h>

#include "tests/determinism/workload.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests {
namespace {

constexpr std::size_t kPatches = 40;
constexpr int kThreadCounts[] = {1, 2, 7};
constexpr Wanted kEverything{.second = true};

class CallsTest : public IsaTest {
protected:
  template <typename T>
  [[nodiscard]] Planes<T> by_grid(const PatchSet<T>& set, const Grid<T>& samples, Options options) {
    Planes<T> planes(kPatches * samples.nu * samples.nv, kEverything);
    grid(set, samples, planes.outputs(), options);
    return planes;
  }

  /// The same grid on every patch, the samples of patch k at k * nu * nv.
  template <typename T>
  [[nodiscard]] Planes<T> by_patch_grids(const PatchSet<T>& set, const Grid<T>& samples,
                                         std::size_t piece, Options options) {
    Planes<T> planes(kPatches * samples.nu * samples.nv, kEverything);
    const std::vector<std::uint32_t> nu(kPatches, static_cast<std::uint32_t>(samples.nu));
    const std::vector<std::uint32_t> nv(kPatches, static_cast<std::uint32_t>(samples.nv));
    for (std::size_t first = 0; first < kPatches; first += piece) {
      options.first_patch = first;
      options.patch_count = std::min(piece, kPatches - first);
      patch_grids(set, {nu.data(), nv.data(), nullptr},
                  advanced(planes.outputs(), first * samples.nu * samples.nv), options);
    }
    return planes;
  }

  template <typename T>
  [[nodiscard]] Planes<T> by_tiles(const PatchSet<T>& set, const Grid<T>& samples,
                                   const TileFormat& format, Options options) {
    Planes<T> planes(kPatches * samples.nu * samples.nv, kEverything);
    std::mutex mutex;
    const auto take = [&](const Tile<T>& tile) {
      const std::lock_guard<std::mutex> lock(mutex);
      const std::size_t first = (tile.first_patch * samples.nv + tile.first_row) * samples.nu;
      copy(tile.out, advanced(planes.outputs(), first), tile.samples);
    };
    tiles<T>(set, samples, format, take, options);
    return planes;
  }

  template <typename T>
  static void copy(const Outputs<T>& from, const Outputs<T>& to, std::size_t count) {
    constexpr Vectors<T> Outputs<T>::*kGroups[] = {
        &Outputs<T>::position, &Outputs<T>::du,  &Outputs<T>::dv,    &Outputs<T>::duu,
        &Outputs<T>::duv,      &Outputs<T>::dvv, &Outputs<T>::normal};
    for (const auto group : kGroups) {
      const Vectors<T>& source = from.*group;
      const Vectors<T>& target = to.*group;
      for (std::size_t k = 0; k < count; ++k) {
        const auto at = static_cast<std::ptrdiff_t>(k) * source.stride;
        target.x[k] = source.x[at];
        target.y[k] = source.y[at];
        target.z[k] = source.z[at];
      }
    }
    std::copy_n(from.status, count, to.status);
  }

  template <typename T>
  void expect_equal_calls() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    for (const auto& [nu, nv] : kWorkGrids) {
      const Grid<T> samples = Grid<T>::uniform(nu, nv);
      const Planes<T> reference = by_grid(set, samples, {.threads = 1});
      const auto expect = [&](const char* call, int threads, const Planes<T>& planes) {
        EXPECT_EQ(differing_values(planes, reference), 0U)
            << call << ", " << threads << " threads, grid " << samples.nu << " x " << samples.nv;
      };
      for (const int threads : kThreadCounts) {
        for (const Destination destination :
             {Destination::automatic, Destination::cache, Destination::memory}) {
          const Options options{.threads = threads, .destination = destination};
          expect("grid", threads, by_grid(set, samples, options));
          expect("patch grids", threads, by_patch_grids(set, samples, kPatches, options));
        }
        TileFormat format{true, true, true, true, true, true, true, true};
        for (const TileLayout layout :
             {TileLayout::planes, TileLayout::xyz, TileLayout::interleaved}) {
          for (const std::size_t most : {0U, 1U, 300U, 5000U}) {
            format.layout = layout;
            format.samples = most;
            expect("tiles", threads, by_tiles(set, samples, format, {.threads = threads}));
          }
        }
      }
      for (const std::size_t piece : {1U, 3U, 16U, 39U}) {
        expect("pieces", 1, by_patch_grids(set, samples, piece, {.threads = 1}));
      }
    }
  }
};

TEST_P(CallsTest, AgreeFloat) { expect_equal_calls<float>(); }
TEST_P(CallsTest, AgreeDouble) { expect_equal_calls<double>(); }
INSTANTIATE_FOR_EVERY_ISA(CallsTest);

} // namespace
} // namespace simdbezier::tests
