// Calls from many threads at once, from regions inside of regions, and after fork(). Right results
// are checked here; `./run sanitize` has the thread sanitizer look at who touches what.
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <omp.h>

#include "tests/reliability/threads/shared_set.hpp"

namespace simdbezier::tests::threads_test {
namespace {

constexpr std::size_t kPatches = 24;
constexpr std::size_t n = 9;
constexpr int kCallers = 16;

const SharedSet& shared() {
  static const SharedSet all(kPatches, n);
  return all;
}

/// Each function returns how many values differ from the reference after a call with this many
/// threads.
std::size_t grid_errors(int threads) {
  return shared().grid_errors({.threads = threads, .destination = Destination::memory});
}

std::size_t patch_grid_errors(int threads) {
  return shared().patch_grid_errors({.threads = threads});
}

std::size_t scattered_errors(int threads) {
  const SharedSet& all = shared();
  SampleArrays<float> samples;
  for (std::size_t p = 0; p < kPatches; ++p) {
    for (std::size_t k = 0; k < n * n; ++k) {
      samples.add(p, uniform_centred<float>(static_cast<int>(k % n), n - 1),
                  uniform_centred<float>(static_cast<int>(k / n), n - 1));
    }
  }
  return all.errors([&](const auto& out) {
    return evaluate(all.set, samples.view(Parameters::centred), out, {.threads = threads});
  });
}

/// Tiles come from several threads at once, each with a worker's number of its own; what they write
/// is apart, so nothing has to be locked.
std::size_t tile_errors(int threads) {
  const SharedSet& all = shared();
  std::vector<float> x(kPatches * n * n, -777);
  const auto take = [&](const Tile<float>& tile) {
    float* const to = x.data() + (tile.first_patch * n + tile.first_row) * n;
    std::copy_n(tile.out.position.x, tile.samples, to);
  };
  TileFormat format;
  format.samples = n * n;
  const Status status =
      evaluate_tiles<float>(all.set, all.grid, format, take, {.threads = threads});
  std::size_t different = status == Status::ok ? 0 : 1;
  for (std::size_t k = 0; k < x.size(); ++k) {
    different += same_bits(x[k], all.reference.at(0, 0, k)) ? 0 : 1;
  }
  return different;
}

/// Packing anew while others read; the set that is packed into has a reader as well, of its copy.
std::size_t packing_errors(int threads) {
  const SharedSet& all = shared();
  PatchSet<float> own = all.set;
  const PatchSet<float> copy = own;
  const std::vector<float> points = packed_points<float>(std::span(all.nets));
  if (!pack(control_nets<float>(all.nets, points), own, {.threads = threads})) {
    return 1;
  }
  const auto errors_of = [&](const PatchSet<float>& set, int own_threads) {
    return all.errors(
        [&](const auto& out) { return evaluate(set, all.grid, out, {.threads = own_threads}); });
  };
  return errors_of(own, threads) + errors_of(copy, 1);
}

std::size_t net_errors(int threads) {
  const SharedSet& all = shared();
  const std::vector<float> points = packed_points<float>(std::span(all.nets));
  const ControlNets<float> nets = control_nets<float>(all.nets, points);
  std::vector<EdgeLink> links(4 * kPatches);
  std::vector<float> boxes(6 * kPatches);
  const bool done =
      find_adjacency(nets, links.data(), {.threads = threads}) == Status::ok &&
      tight_boxes(nets, 1, {boxes.data(), boxes.data() + 3 * kPatches}, {.threads = threads});
  return done ? 0 : 1;
}

struct Work {
  const char* name;
  std::size_t (*errors)(int threads);
};

constexpr Work kWork[] = {{"grid", grid_errors},           {"patch_grids", patch_grid_errors},
                          {"scattered", scattered_errors}, {"tiles", tile_errors},
                          {"packing", packing_errors},     {"nets", net_errors}};

class Threads : public ::testing::TestWithParam<Work> {
protected:
  Threads() { shared(); }
  [[nodiscard]] static std::size_t errors(int threads) { return GetParam().errors(threads); }
};

TEST_P(Threads, SixteenCallersWithRegionsOfTheirOwn) {
  std::atomic<std::size_t> wrong{0};
  std::vector<std::thread> callers;
  for (int k = 0; k < kCallers; ++k) {
    callers.emplace_back([&, k] {
      for (int round = 0; round < 2; ++round) {
        wrong += errors(1 + (k + round) % 3);
      }
    });
  }
  for (std::thread& caller : callers) {
    caller.join();
  }
  EXPECT_EQ(wrong, 0U);
}

TEST_P(Threads, RegionsInsideOfRegions) {
  omp_set_max_active_levels(3);
  std::atomic<std::size_t> wrong{0};
  std::atomic<int> outer{0};
#pragma omp parallel num_threads(4)
  {
    ++outer;
    wrong += errors(2); // asked for by name, so the call opens a region inside of this one
    wrong += errors(0); // its own choice: this thread alone
  }
  EXPECT_EQ(outer, 4);
  EXPECT_EQ(wrong, 0U);
}

/// Exit code of a child that makes the calls; a child that hangs is ended by its alarm.
int in_child(const std::function<std::size_t()>& body) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    _exit(body() == 0 ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST_P(Threads, AfterFork) {
  EXPECT_EQ(in_child([] { return errors(1); }), 0) << "one thread";
  EXPECT_EQ(errors(3), 0U);
  EXPECT_EQ(in_child([] { return errors(1); }), 0) << "one thread, its parent had several";
}

INSTANTIATE_TEST_SUITE_P(Calls, Threads, ::testing::ValuesIn(kWork),
                         [](const auto& each) { return std::string(each.param.name); });

} // namespace
} // namespace simdbezier::tests::threads_test
