// Equal bits whichever call a sample comes through, with any number of threads, batch and tile
// size, and destination.
#include <gtest/gtest.h>

#include "tests/properties/bits/call_fixture.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::call_bits_test {
namespace {

constexpr std::size_t kPatches = 40;
constexpr int kThreadCounts[] = {1, 2, 7};

class CallsTest : public CallTest {
protected:
  CallsTest() : CallTest({.second = true}) {}

  template <typename T>
  void expect_equal_calls() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    std::size_t number = 0;
    for (const auto& [nu, nv] : kWorkGrids) {
      std::size_t place = ++number;
      const Grid<T> samples = Grid<T>::uniform(nu, nv);
      const Planes<T> reference = by_grid(set, samples, {.threads = 1});
      const auto expect = [&](const char* call, int threads, const Planes<T>& planes) {
        EXPECT_EQ(differing_values(planes, reference), 0U)
            << call << ", " << threads << " threads, grid " << samples.nu << " x " << samples.nv;
      };
      for (const int threads : kThreadCounts) {
        std::size_t sum = ++place;
        for (const Destination destination :
             {Destination::automatic, Destination::cache, Destination::memory}) {
          const CallOptions options{.threads = threads, .destination = destination};
          if (in_form(++sum, 3)) {
            expect("grid", threads, by_grid(set, samples, options));
          }
          if (in_form(sum + 1, 3)) {
            expect("patch grids", threads, by_patch_grids(set, samples, kPatches, options));
          }
        }
        TileFormat format{everything()};
        for (const TileLayout layout :
             {TileLayout::planes, TileLayout::xyz, TileLayout::interleaved}) {
          for (const std::size_t most : {0U, 1U, 300U, 5000U}) {
            if (!in_form(++sum, 3)) {
              continue;
            }
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
} // namespace simdbezier::tests::call_bits_test
