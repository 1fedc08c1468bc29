// Tiles: every sample arrives once, with the grid call's bits, in the layout asked for.
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/call_options.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/tile_collector.hpp"

namespace simdbezier::tests::tiles_test {
namespace {

constexpr TileLayout kLayouts[] = {TileLayout::planes, TileLayout::xyz, TileLayout::interleaved};
constexpr int kThreads[] = {1, 2, 7};
constexpr auto kHuge = std::numeric_limits<std::size_t>::max();

class TilesTest : public IsaTest {
protected:
  template <typename T>
  [[nodiscard]] Planes<T> reference_of(const PatchSet<T>& set, const Grid<T>& samples,
                                       bool watertight = true) {
    Planes<T> reference(set.size() * samples.nu * samples.nv, {.second = true});
    grid(set, samples, reference.outputs(), {.threads = 1, .watertight = watertight});
    return reference;
  }

  /// One call; returns how many tiles came. `reference`: of the whole set, all groups.
  template <typename T>
  std::size_t check(const PatchSet<T>& set, const Grid<T>& samples, GroupSet groups, bool status,
                    TileLayout layout, std::size_t most, const Planes<T>& reference,
                    const CallOptions& options = {}) {
    const std::size_t patches = std::min(set.size() - options.first_patch, options.patch_count);
    const TileFormat format = tile_format(groups, status, layout, most);
    TileCollector<T> collector(groups, format, options.first_patch, patches, samples.nu,
                               samples.nv);
    tiles<T>(set, samples, format, collector, options);
    const std::size_t different = collector.different_from(reference);
    EXPECT_TRUE(different == 0 && collector.complaints().empty())
        << different << " differ. " << collector.complaints() << samples.nu << "x" << samples.nv
        << ", groups " << groups << ", layout " << static_cast<int>(layout) << ", " << most
        << " samples, " << options.threads << " threads, patches " << options.first_patch << " + "
        << patches;
    if (options.threads > 0) {
      EXPECT_LE(collector.workers(), static_cast<std::size_t>(options.threads));
    }
    return collector.tiles();
  }

  template <typename T>
  void every_size() {
    const PatchSet<T> set = packed<T>(mixed_nets(11));
    GroupSet groups = 0;
    std::size_t turn = 0;
    for (std::size_t n = 2; n <= 40; ++n) {
      const std::size_t nv = n % 3 == 0 ? n : 2 + n % 7;
      const Grid<T> samples = Grid<T>::uniform(n, nv);
      const Planes<T> reference = reference_of(set, samples);
      for (const std::size_t most :
           {std::size_t{0}, std::size_t{1}, n, n * nv, 3 * n * nv + 1, std::size_t{500}, kHuge}) {
        for (const TileLayout layout : kLayouts) {
          ++turn;
          groups =
              (groups * 5 + static_cast<GroupSet>(turn)) % kAllVectors + 1; // wanders through all
          check(set, samples, groups, holds(groups, 6), layout, most, reference,
                {.threads = turn % 6 == 0 ? kThreads[turn / 6 % 3] : 1});
        }
      }
    }
  }

  template <typename T>
  void every_choice_of_outputs() {
    const PatchSet<T> set = packed<T>(mixed_nets(5));
    for (const auto& [nu, nv] :
         {std::pair<std::size_t, std::size_t>{5, 4}, {16, 3}, {17, 9}, {22, 2}, {33, 3}}) {
      const Grid<T> samples = Grid<T>::uniform(nu, nv);
      const Planes<T> all = reference_of(set, samples);
      for (GroupSet groups = 1; groups <= kAllVectors; ++groups) {
        for (const TileLayout layout : kLayouts) {
          check(set, samples, groups, false, layout, 0, all, {.threads = 1});
          if (holds(groups, 6)) {
            check(set, samples, groups, true, layout, 2 * nu * nv, all, {.threads = 1});
          }
        }
      }
    }
  }

  /// A status without normals is the one that the grid call gives.
  template <typename T>
  void status_alone() {
    const PatchSet<T> set = packed<T>(mixed_nets(5));
    const T x[] = {T(-1), std::numeric_limits<T>::quiet_NaN(), T(0.5), T(1)};
    const Grid<T> samples{4, 4, x, x, Parameters::centred};
    Planes<T> reference(5 * 16, {.normal = false, .second = true});
    grid(set, samples, reference.outputs(), {.threads = 1});
    for (const TileLayout layout : kLayouts) {
      check(set, samples, kAllVectors & ~kN, true, layout, 0, reference);
    }
  }

  /// Patches larger than a tile, in strips of rows; rows longer than a tile.
  template <typename T>
  void strips() {
    const PatchSet<T> set = packed<T>(mixed_nets(3));
    for (const auto& [nu, nv] :
         {std::pair<std::size_t, std::size_t>{300, 3}, {3, 300}, {20000, 2}, {2, 5000}}) {
      const Grid<T> samples = Grid<T>::uniform(nu, nv);
      const Planes<T> reference = reference_of(set, samples);
      for (const TileLayout layout : kLayouts) {
        check(set, samples, kP | kN, true, layout, 0, reference, {.threads = 1});
        check(set, samples, kAllVectors, true, layout, nu - 1, reference, {.threads = 3});
        check(set, samples, kP, false, layout, 2 * nu + 1, reference, {.threads = 1});
      }
    }
  }

  template <typename T>
  void dense_patches(std::size_t nu, std::size_t nv) {
    const PatchSet<T> set = packed<T>(mixed_nets(2));
    const Grid<T> samples = Grid<T>::uniform(nu, nv);
    Planes<T> reference(2 * nu * nv);
    grid(set, samples, reference.outputs(), {.threads = 1});
    for (const TileLayout layout : kLayouts) {
      const int threads = layout == TileLayout::xyz ? 1 : 2;
      const std::size_t tiles =
          check(set, samples, kP | kN, true, layout, 0, reference, {.threads = threads});
      EXPECT_GT(tiles, 2 * nu * nv / 60'000) << "tiles that leave the cache";
    }
  }

  template <typename T>
  void windows_and_threads() {
    const PatchSet<T> set = packed<T>(mixed_nets(23));
    const Grid<T> samples = Grid<T>::uniform(9, 9);
    const Planes<T> reference = reference_of(set, samples);
    for (const int threads : kThreads) {
      for (const std::size_t most : {std::size_t{0}, std::size_t{1}, std::size_t{200}, kHuge}) {
        for (const auto& [first, count] :
             {std::pair<std::size_t, std::size_t>{0, 23}, {0, 1}, {22, 1}, {5, 17}}) {
          check(set, samples, kP | kDuv, false, TileLayout::planes, most, reference,
                {.threads = threads, .first_patch = first, .patch_count = count});
        }
      }
    }
  }

  template <typename T>
  void schemes() {
    const std::vector<Net> nets = mixed_nets(9);
    for (const bool origins : {false, true}) {
      const PatchSet<T> set = packed<T>(nets, {.local_origin = origins});
      for (const bool watertight : {false, true}) {
        for (const auto& [nu, nv] : {std::pair<std::size_t, std::size_t>{8, 8}, {17, 5}}) {
          const Grid<T> samples = Grid<T>::uniform(nu, nv);
          const Planes<T> reference = reference_of(set, samples, watertight);
          for (const TileLayout layout : kLayouts) {
            check(set, samples, kAllVectors, true, layout, 100, reference,
                  {.threads = 1, .watertight = watertight});
          }
        }
      }
    }
  }

  /// Given parameters in any order, one row, one column, one sample.
  template <typename T>
  void given_grids() {
    const PatchSet<T> set = packed<T>(mixed_nets(6));
    Random random(3);
    std::vector<T> values;
    for (int k = 0; k < 70; ++k) {
      values.push_back(boundary_centred<T>(random));
    }
    for (const auto& [nu, nv] :
         {std::pair<std::size_t, std::size_t>{1, 1}, {1, 70}, {70, 1}, {33, 12}}) {
      const Grid<T> samples{nu, nv, values.data(), values.data(), Parameters::centred};
      const Planes<T> reference = reference_of(set, samples);
      for (const TileLayout layout : kLayouts) {
        for (const std::size_t most : {0U, 1U, 100U}) {
          check(set, samples, kAllVectors, true, layout, most, reference, {.threads = 1});
        }
      }
    }
  }
};

TEST_P(TilesTest, EverySizeF32) { every_size<float>(); }
TEST_P(TilesTest, EverySizeF64) { every_size<double>(); }
TEST_P(TilesTest, EveryChoiceOfOutputsF32) { every_choice_of_outputs<float>(); }
TEST_P(TilesTest, EveryChoiceOfOutputsF64) { every_choice_of_outputs<double>(); }
TEST_P(TilesTest, StatusWithoutNormalsF32) { status_alone<float>(); }
TEST_P(TilesTest, StatusWithoutNormalsF64) { status_alone<double>(); }
TEST_P(TilesTest, StripsF32) { strips<float>(); }
TEST_P(TilesTest, StripsF64) { strips<double>(); }
TEST_P(TilesTest, DensePatchesF32) { dense_patches<float>(1000, 1000); }
TEST_P(TilesTest, DensePatchesF64) { dense_patches<double>(300, 500); }
TEST_P(TilesTest, WindowsAndThreadsF32) { windows_and_threads<float>(); }
TEST_P(TilesTest, WindowsAndThreadsF64) { windows_and_threads<double>(); }
TEST_P(TilesTest, SchemesF32) { schemes<float>(); }
TEST_P(TilesTest, SchemesF64) { schemes<double>(); }
TEST_P(TilesTest, GivenGridsF32) { given_grids<float>(); }
TEST_P(TilesTest, GivenGridsF64) { given_grids<double>(); }
INSTANTIATE_FOR_EVERY_ISA(TilesTest);

TEST(TileErrors, HandOutNoTile) {
  const PatchSet<float> set = packed<float>(mixed_nets(3));
  const auto good = Grid<float>::uniform(4, 4);
  const float u[] = {0.5F};
  const TileFormat positions;
  struct Case {
    const char* name;
    Status status;
    Grid<float> grid;
    TileFormat format;
    CallOptions options;
  };
  const Case cases[] = {
      {"no vector", Status::null_output, good, tile_format(0, false, TileLayout::xyz), {}},
      {"status alone", Status::null_output, good, tile_format(0, true, TileLayout::planes), {}},
      {"nu 1", Status::bad_grid, Grid<float>::uniform(1, 4), positions, {}},
      {"nv 0", Status::bad_grid, Grid<float>::uniform(4, 0), positions, {}},
      {"given 0", Status::bad_grid, {0, 1, u, u}, positions, {}},
      {"first patch", Status::bad_patch_range, good, positions, {.first_patch = 4}},
      {"patch count",
       Status::bad_patch_range,
       good,
       positions,
       {.first_patch = 1, .patch_count = 3}},
      {"huge grid", Status::size_overflow, Grid<float>::uniform(kHuge, 2), positions, {}},
      {"huge product", Status::size_overflow, Grid<float>::uniform(kHuge / 2, 4), positions, {}},
  };
  for (const Case& c : cases) {
    std::size_t calls = 0;
    const auto count = [&](const Tile<float>&) { ++calls; };
    EXPECT_EQ(to_string(evaluate_tiles(set, c.grid, c.format, count, c.options)),
              to_string(c.status))
        << c.name;
    EXPECT_EQ(calls, 0U) << c.name;
  }
}

std::size_t tiles_of_function = 0;
void count_tile(const Tile<double>&) { ++tiles_of_function; }

TEST(TileFunction, BorrowsFunctionsToo) {
  const PatchSet<double> set = packed<double>(mixed_nets(3));
  const TileFormat positions;
  tiles_of_function = 0;
  EXPECT_EQ(evaluate_tiles(set, Grid<double>::uniform(4, 4), positions, count_tile,
                           CallOptions{.threads = 1}),
            Status::ok);
  EXPECT_GT(tiles_of_function, 0U);
}

TEST(TileErrors, NoPatchesHaveNoTiles) {
  std::size_t calls = 0;
  const auto count = [&](const Tile<double>&) { ++calls; };
  const auto samples = Grid<double>::uniform(4, 4);
  EXPECT_EQ(evaluate_tiles(PatchSet<double>{}, samples, {}, count), Status::ok);
  const PatchSet<double> set = packed<double>(mixed_nets(3));
  EXPECT_EQ(evaluate_tiles(set, samples, {}, count, CallOptions{.first_patch = 3}), Status::ok);
  EXPECT_EQ(
      evaluate_tiles(set, samples, {}, count, CallOptions{.first_patch = 1, .patch_count = 0}),
      Status::ok);
  EXPECT_EQ(calls, 0U);
}

} // namespace
} // namespace simdbezier::tests::tiles_test
