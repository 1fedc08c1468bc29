// Calls from inside of the caller's parallel region start no further threads, and results are as
// ever.
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <omp.h>

#include "tests/reliability/threads/shared_set.hpp"
#include "tests/support/tile_collector.hpp"

namespace simdbezier::tests::regions_test {
namespace {

constexpr std::size_t kPatches = 40;
constexpr std::size_t n = 17;
constexpr int kTeam = 4;

/// What each thread of the caller's team found; nothing of GoogleTest runs inside the region.
struct Found {
  Status status = Status::null_input;
  std::size_t different = 1;
  std::size_t workers = 0;
};

/// Runs `body` on every thread of a team and returns what each found.
template <typename Body>
[[nodiscard]] std::vector<Found> in_region(const Body& body) {
  std::vector<Found> found(kTeam);
  std::atomic<int> team{0};
#pragma omp parallel num_threads(kTeam)
  {
    team = omp_get_num_threads();
    found[static_cast<std::size_t>(omp_get_thread_num())] = body();
  }
  EXPECT_EQ(team, kTeam);
  return found;
}

void expect_right(const std::vector<Found>& all) {
  for (const Found& found : all) {
    EXPECT_EQ(to_string(found.status), to_string(Status::ok));
    EXPECT_EQ(found.different, 0U);
    EXPECT_LE(found.workers, 1U);
  }
}

class Regions : public ::testing::Test {
protected:
  Regions() {
    omp_set_max_active_levels(3); // by default inner regions get no threads, whatever they ask for
  }

  SharedSet shared_{kPatches, n};
};

TEST_F(Regions, TilesStayOnTheCallersThread) {
  expect_right(in_region([&] {
    TileFormat format = tile_format(kP | kDuv | kN, true, TileLayout::xyz, 2 * n * n);
    TileCollector<float> collector(kP | kDuv | kN, format, 0, kPatches, n, n);
    const auto caller = std::this_thread::get_id();
    std::size_t elsewhere = 0;
    const auto receive = [&](const Tile<float>& tile) {
      elsewhere += std::this_thread::get_id() == caller ? 0 : 1;
      collector(tile);
    };
    const Status status = evaluate_tiles(shared_.set, shared_.grid, format, receive);
    return Found{status, collector.different_from(shared_.reference) + elsewhere,
                 collector.workers()};
  }));
}

TEST_F(Regions, GridsAndPatchGridsAreRight) {
  expect_right(in_region([&] { return Found{Status::ok, shared_.grid_errors({}), 0}; }));
  expect_right(in_region([&] {
    return Found{Status::ok, shared_.patch_grid_errors({.destination = Destination::memory}), 0};
  }));
}

// Outside of a region the same call may have several threads, so that one worker above is no
// accident.
TEST_F(Regions, OutsideThereAreSeveralWorkers) {
  const TileFormat format = tile_format(kP, false, TileLayout::planes, n);
  TileCollector<float> collector(kP, format, 0, kPatches, n, n);
  EXPECT_EQ(evaluate_tiles<float>(shared_.set, shared_.grid, format, collector, {.threads = 3}),
            Status::ok);
  EXPECT_EQ(collector.different_from(shared_.reference), 0U);
  EXPECT_EQ(collector.workers(), 3U);
}

} // namespace
} // namespace simdbezier::tests::regions_test
