// Positions relative to one origin keep the digits that a far origin costs.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/bicubic_bounds.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests::relative_positions_test {
namespace {

struct RelativeCase {
  const char* name;
  double origin[3];
};

constexpr RelativeCase kRelativeCases[] = {{"none", {0, 0, 0}},
                                           {"near", {0.1, -0.7, 3}},
                                           {"far", {1e6, -1e6, 1e6}},
                                           {"very_far", {1e9 + 0.1, 1e9, -1e9}}};

/// Unit nets about a point, given in double.
[[nodiscard]] std::vector<Net> nets_about(const double* origin) {
  Random random(70);
  std::vector<Net> nets;
  for (int k = 0; k < 30; ++k) {
    nets.push_back(translated(wave_net(random), {origin[0], origin[1], origin[2]}));
  }
  return nets;
}

class RelativeTest : public IsaTest {
protected:
  /// Nets in double, evaluated in T: |error| <= K u max|b - O| at the exact surface less O.
  template <typename T>
  void expect_digits(const RelativeCase& test, bool local_origin) {
    const std::vector<Net> nets = nets_about(test.origin);
    const std::vector<double> points = packed_points<double>(nets);
    PatchSet<T> set;
    const PackOptions packing{local_origin, {test.origin[0], test.origin[1], test.origin[2]}};
    ASSERT_EQ(pack(ControlNets<double>{points.data(), nets.size()}, set, packing).status,
              Status::ok);
    constexpr int kCount = 13;
    Planes<T> planes(nets.size() * kCount * kCount);
    grid(set, Grid<T>::uniform(kCount, kCount), planes.outputs());
    const auto parameters = grid_parameters<T>(kCount, kCount);
    double worst = 0;
    for (std::size_t k = 0; k < planes.count(); ++k) {
      const Net& net = nets[k / parameters.size()];
      const Parameters2<T>& at = parameters[k % parameters.size()];
      const OracleSample truth = oracle_sample(net, at.x, at.y);
      const Net moved = translated(net, {-test.origin[0], -test.origin[1], -test.origin[2]});
      for (std::size_t c = 0; c < 3; ++c) {
        const DoubleDouble exact = truth.position[c] - DoubleDouble(test.origin[c]);
        const double error = std::abs((exact - static_cast<double>(planes.at(0, c, k))).hi);
        worst = std::max(worst, error / (kUnitRoundoff<T> * largest_coordinate(moved, c)));
      }
    }
    const bool fma = fuses_multiply_add(isa());
    EXPECT_LE(worst, local_origin ? position_bound_with_origin(fma) : position_bound(fma))
        << test.name;
    EXPECT_GT(worst, 0.3) << test.name;
  }
};

TEST_P(RelativeTest, KeepsDigitsFloat) {
  for (const RelativeCase& test : kRelativeCases) {
    expect_digits<float>(test, false);
    expect_digits<float>(test, true);
  }
}
TEST_P(RelativeTest, KeepsDigitsDouble) {
  for (const RelativeCase& test : kRelativeCases) {
    expect_digits<double>(test, false);
    expect_digits<double>(test, true);
  }
}
INSTANTIATE_FOR_EVERY_ISA(RelativeTest);

} // namespace
} // namespace simdbezier::tests::relative_positions_test
