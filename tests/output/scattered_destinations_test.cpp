// Scattered samples in every layout and at every alignment, streamed or not: equal bits, and not
// one element touched that is no output.
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/output/layouts.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/workload.hpp"

namespace simdbezier::tests::scattered_destinations_test {
namespace {

constexpr std::size_t kPatches = 23;
constexpr std::size_t kMostSamples = 1500;

class ScatteredDestinationTest : public IsaTest {
protected:
  template <typename T>
  void layouts() {
    const PatchSet<T> set = packed<T>(mixed_nets(kPatches));
    const SampleArrays<T> all = random_samples<T>(kPatches, kMostSamples);
    Planes<T> reference(kMostSamples, {.second = true});
    scattered(set, all.view(Parameters::centred), reference.outputs(),
              {.threads = 1, .destination = Destination::cache});
    Canvas<T> canvas(0);
    std::size_t turn = 0;
    for (const std::size_t count :
         {1U, 2U, 3U, 4U, 5U, 7U, 8U, 9U, 15U, 16U, 17U, 31U, 33U, 64U, 100U, 257U, 1500U}) {
      const Samples<T> samples = part_of(all, 0, count);
      for (std::size_t shift = 0; shift<16; shift += count> 100 ? 5 : 1) {
        const Options options{.threads = turn % 8 == 3 ? 2 : 1,
                              .destination =
                                  turn % 3 == 0 ? Destination::cache : Destination::memory};
        const auto check = [&](const char* name, const Outputs<T>& out) {
          scattered(set, samples, out, options);
          EXPECT_EQ(canvas.defects(out, reference, count), 0U)
              << name << " + " << shift << ", " << count << " samples, " << options.threads
              << " threads";
          ++turn;
        };
        for (const PlaneCase& layout : kPlaneCases) {
          canvas.reset(plane_elements(layout, count));
          check(layout.name, plane_outputs(layout, count, shift, canvas.at(0)));
        }
        for (const VertexCase& layout : vertex_cases()) {
          canvas.reset(vertex_elements(layout, count) + shift);
          check(layout.name, vertex_outputs(layout, count, canvas.at(shift),
                                            turn % 7 == 0 ? PlaneOrder::zyx : PlaneOrder::xyz));
        }
      }
    }
  }
};

TEST_P(ScatteredDestinationTest, LayoutsF32) { layouts<float>(); }
TEST_P(ScatteredDestinationTest, LayoutsF64) { layouts<double>(); }
INSTANTIATE_FOR_EVERY_ISA(ScatteredDestinationTest);

} // namespace
} // namespace simdbezier::tests::scattered_destinations_test
