// A nan parameter makes every output nan, also those that do not depend on it: derivatives of a
// direction of low degree are constant along it.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/component_nets.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::nan_parameters_test {
namespace {

constexpr Degrees kDegrees[] = {{1, 1}, {1, 2},  {2, 1},  {2, 2},  {1, 3}, {3, 1},
                                {3, 3}, {1, 15}, {15, 1}, {15, 2}, {7, 7}, {2, 9}};
constexpr std::size_t kPatches = 3;
constexpr std::size_t kNu = 19; // a register and a part of one
constexpr std::size_t kNv = 5;
constexpr Wanted kTangents{true, true, true, false};
constexpr Wanted kEverything{true, true, true, false, true, true};

class NanParametersTest : public IsaTest {
protected:
  template <typename T>
  static void expect_nan(const Planes<T>& out, std::size_t k, bool nan, const char* what) {
    const std::size_t planes = out.values().size() / out.count();
    for (std::size_t plane = 0; plane < planes; ++plane) {
      EXPECT_EQ(std::isnan(out.values()[plane * out.count() + k]), nan)
          << what << ": plane " << plane << ", sample " << k;
    }
  }

  template <typename T>
  void expect_nan_everywhere(Degrees degrees, bool rational, const Wanted& wanted) {
    Random random(11);
    const PatchSet<T> set =
        ComponentNets(degrees, 3, rational, kPatches, random).template packed<T>();
    const T nan = std::numeric_limits<T>::quiet_NaN();
    T u[kNu];
    for (std::size_t i = 0; i < kNu; ++i) {
      u[i] = static_cast<T>(i) / (kNu - 1);
    }
    u[2] = u[17] = nan;
    const T v[kNv] = {0, T(0.25), nan, T(0.75), 1};
    const std::string what =
        std::to_string(degrees.u) + "x" + std::to_string(degrees.v) + (rational ? " rational" : "");
    Planes<T> by_grid(kPatches * kNu * kNv, wanted);
    grid(set, Grid<T>{kNu, kNv, u, v}, by_grid.outputs());
    SampleArrays<T> samples;
    for (std::size_t k = 0; k < by_grid.count(); ++k) {
      samples.add(k / (kNu * kNv), u[k % kNu], v[k / kNu % kNv]);
    }
    Planes<T> by_sample(by_grid.count(), wanted);
    scattered(set, samples.view(Parameters::unit), by_sample.outputs());
    for (std::size_t k = 0; k < by_grid.count(); ++k) {
      const bool is_nan = std::isnan(u[k % kNu]) || std::isnan(v[k / kNu % kNv]);
      expect_nan(by_grid, k, is_nan, ("grid, " + what).c_str());
      expect_nan(by_sample, k, is_nan, ("scattered, " + what).c_str());
    }
  }
};

TEST_P(NanParametersTest, make_all_outputs_nan) {
  for (const Degrees degrees : kDegrees) {
    for (const bool rational : {false, true}) {
      for (const Wanted& wanted : {kTangents, kEverything}) {
        expect_nan_everywhere<float>(degrees, rational, wanted);
        expect_nan_everywhere<double>(degrees, rational, wanted);
      }
    }
  }
}
INSTANTIATE_FOR_EVERY_ISA(NanParametersTest);

} // namespace
} // namespace simdbezier::tests::nan_parameters_test
