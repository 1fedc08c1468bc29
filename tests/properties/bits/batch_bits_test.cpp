// Equal bits whatever the thread count, the size of the batch and the place in it.
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/call_options.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/workload.hpp"

namespace simdbezier::tests::batch_bits_test {
namespace {

constexpr std::size_t kPatches = 70;
constexpr int kThreadCounts[] = {1, 2, 7};
constexpr Wanted kEverything{.second = true};
// W-1, W, W+1 for all lane counts (2, 4, 8, 16), and more than any block.
constexpr std::size_t kBatchSizes[] = {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 1000};

class BatchTest : public IsaTest {
protected:
  template <typename T>
  void expect_equal_for_any_thread_count() {
    const std::vector<Net> nets = mixed_nets(kPatches);
    const PatchSet<T> set = packed<T>(nets);
    const SampleArrays<T> samples = random_samples<T>(kPatches, 20'000);
    Planes<T> scattered_reference(samples.patch.size(), kEverything);
    scattered(set, samples.view(Parameters::centred), scattered_reference.outputs(),
              {.threads = 1});
    for (const int threads : kThreadCounts) {
      Planes<T> planes(samples.patch.size(), kEverything);
      scattered(set, samples.view(Parameters::centred), planes.outputs(), {.threads = threads});
      EXPECT_EQ(differing_values(planes, scattered_reference), 0u) << threads << " threads";
    }
    for (const auto& [nu, nv] : kWorkGrids) {
      Planes<T> reference(kPatches * nu * nv, kEverything);
      grid(set, Grid<T>::uniform(nu, nv), reference.outputs(), {.threads = 1});
      for (const int threads : kThreadCounts) {
        Planes<T> planes(kPatches * nu * nv, kEverything);
        grid(set, Grid<T>::uniform(nu, nv), planes.outputs(), {.threads = threads});
        EXPECT_EQ(differing_values(planes, reference), 0u)
            << threads << " threads, grid " << nu << " x " << nv;
      }
    }
  }

  /// The patches in pieces of `size`, each piece packed as a set of its own.
  template <typename T>
  [[nodiscard]] Planes<T> in_pieces(std::span<const Net> nets, std::size_t size, std::size_t nu,
                                    std::size_t nv) {
    Planes<T> planes(nets.size() * nu * nv, kEverything);
    for (std::size_t first = 0; first < nets.size(); first += size) {
      const auto piece = nets.subspan(first, std::min(size, nets.size() - first));
      grid(packed<T>(piece), Grid<T>::uniform(nu, nv), advanced(planes.outputs(), first * nu * nv),
           {.threads = 1});
    }
    return planes;
  }

  template <typename T>
  void expect_equal_for_any_batch_size() {
    const std::vector<Net> nets = mixed_nets(kPatches);
    for (const auto& [nu, nv] : kWorkGrids) {
      const Planes<T> reference = in_pieces<T>(nets, 1, nu, nv);
      for (const std::size_t size : kBatchSizes) {
        EXPECT_EQ(differing_values(in_pieces<T>(nets, size, nu, nv), reference), 0u)
            << "pieces of " << size << ", grid " << nu << " x " << nv;
      }
    }
  }

  template <typename T>
  void expect_equal_for_any_scattered_batch() {
    const std::vector<Net> nets = mixed_nets(kPatches);
    const PatchSet<T> set = packed<T>(nets);
    const SampleArrays<T> samples = random_samples<T>(kPatches, 3000);
    const auto in_steps = [&](std::size_t size) {
      Planes<T> planes(samples.patch.size(), kEverything);
      for (std::size_t first = 0; first < planes.count(); first += size) {
        scattered(set, part_of(samples, first, std::min(size, planes.count() - first)),
                  advanced(planes.outputs(), first), {.threads = 1});
      }
      return planes;
    };
    const Planes<T> reference = in_steps(1);
    for (const std::size_t size : kBatchSizes) {
      EXPECT_EQ(differing_values(in_steps(size), reference), 0u) << "batches of " << size;
    }
  }

  /// A range of patches of one set, which puts a patch at another place of the batch.
  template <typename T>
  void expect_equal_for_any_range() {
    const std::vector<Net> nets = mixed_nets(kPatches);
    const PatchSet<T> set = packed<T>(nets);
    for (const auto& [nu, nv] : kWorkGrids) {
      const std::size_t samples = nu * nv;
      Planes<T> reference(kPatches * samples, kEverything);
      grid(set, Grid<T>::uniform(nu, nv), reference.outputs(), {.threads = 1});
      Planes<T> planes(kPatches * samples, kEverything);
      for (std::size_t first = 0, count = 1; first < kPatches; first += count++) {
        const std::size_t length = std::min(count, kPatches - first);
        grid(set, Grid<T>::uniform(nu, nv), advanced(planes.outputs(), first * samples),
             {.threads = 1, .first_patch = first, .patch_count = length});
      }
      EXPECT_EQ(differing_values(planes, reference), 0u) << "grid " << nu << " x " << nv;
    }
  }
};

TEST_P(BatchTest, ThreadsFloat) { expect_equal_for_any_thread_count<float>(); }
TEST_P(BatchTest, ThreadsDouble) { expect_equal_for_any_thread_count<double>(); }
TEST_P(BatchTest, BatchSizeFloat) { expect_equal_for_any_batch_size<float>(); }
TEST_P(BatchTest, BatchSizeDouble) { expect_equal_for_any_batch_size<double>(); }
TEST_P(BatchTest, ScatteredBatchSizeFloat) { expect_equal_for_any_scattered_batch<float>(); }
TEST_P(BatchTest, ScatteredBatchSizeDouble) { expect_equal_for_any_scattered_batch<double>(); }
TEST_P(BatchTest, PatchRangeFloat) { expect_equal_for_any_range<float>(); }
TEST_P(BatchTest, PatchRangeDouble) { expect_equal_for_any_range<double>(); }

// Results that outgrow the caches may take another way to memory; their bits may not.
TEST_P(BatchTest, LargeOutputsFloat) {
  const std::vector<Net> some = mixed_nets(10);
  std::vector<Net> nets;
  for (std::size_t k = 0; k < 1000; ++k) {
    nets.push_back(some[k % some.size()]);
  }
  const std::size_t n = 33;
  const Planes<float> reference = in_pieces<float>(some, 1, n, n);
  Planes<float> planes(nets.size() * n * n);
  grid(packed<float>(nets), Grid<float>::uniform(n, n), planes.outputs(), {.threads = 2});
  std::size_t different = 0;
  for (std::size_t k = 0; k < planes.count(); ++k) {
    for (std::size_t plane = 0; plane < 12; ++plane) {
      different += same_bits(planes.at(plane / 3, plane % 3, k),
                             reference.at(plane / 3, plane % 3, k % reference.count()))
                       ? 0
                       : 1;
    }
  }
  EXPECT_EQ(different, 0u) << "of " << planes.values().size();
}

INSTANTIATE_FOR_EVERY_ISA(BatchTest);

} // namespace
} // namespace simdbezier::tests::batch_bits_test
