// Curvatures as outputs of the evaluate calls.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/shaped_nets.hpp"
#include "tests/support/oracle/oracle_curvature.hpp"

namespace simdbezier::tests::curvature_test {
namespace {

constexpr std::size_t kNu = 9;
constexpr std::size_t kNv = 4;

/// Curvature planes alone, in memory of their own.
template <typename T>
struct CurvaturePlanes {
  std::vector<T> values;
  explicit CurvaturePlanes(std::size_t count) : values(4 * count, T(-777)), count_(count) {}
  [[nodiscard]] T at(std::size_t which, std::size_t k) const { return values[which * count_ + k]; }
  [[nodiscard]] Outputs<T> outputs() {
    Outputs<T> out;
    T* const first = values.data();
    out.curvature = {first, first + count_, first + 2 * count_, first + 3 * count_};
    return out;
  }

private:
  std::size_t count_;
};

class CurvatureTest : public IsaTest {
protected:
  /// Against the oracle; regular nets, whose curvatures lose a few digits only. The bounds of the
  /// accuracy suite are sharper; this shows that all calls give curvatures, of all shapes.
  template <typename T>
  void expect_near_oracle(const Net& net) {
    CurvaturePlanes<T> planes(kNu * kNv);
    grid(packed<T>(std::span(&net, 1)), Grid<T>::uniform(kNu, kNv), planes.outputs());
    const auto parameters = grid_parameters<T>(kNu, kNv);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const OracleSample sample = oracle_sample(net, parameters[k].x, parameters[k].y);
      const OracleCurvatures exact = oracle_curvatures(sample);
      const double size = std::abs(exact[2].to_double()) + std::abs(exact[3].to_double());
      const double digits = sizeof(T) == 4 ? 1e-4 : 1e-12;
      EXPECT_NEAR(planes.at(0, k), exact[0].to_double(), digits * (1 + size * size));
      for (std::size_t which = 1; which < 4; ++which) {
        EXPECT_NEAR(planes.at(which, k), exact[which].to_double(), std::sqrt(digits) * (1 + size));
      }
      EXPECT_LE(planes.at(2, k), planes.at(3, k));
    }
  }
};

/// A gentle dish with a twist, of any degrees.
[[nodiscard]] Net dish(Degrees degrees, Random& random) {
  return shaped_net(degrees, [&](int j, int i) {
    const double x = 2.0 * i / degrees.u - 1;
    const double y = 2.0 * j / degrees.v - 1;
    return Vector3{x, y, 0.3 * x * x - 0.2 * y * y + 0.2 * x * y + 0.01 * random.symmetric()};
  });
}

TEST_P(CurvatureTest, AgreesWithOracle) {
  Random random(63);
  for (const Degrees& degrees : {Degrees{3, 3}, {2, 2}, {1, 1}, {5, 2}, {7, 6}}) {
    for (const bool rational : {false, true}) {
      Net net = dish(degrees, random);
      net = rational ? weighted(std::move(net), 2, random) : net;
      expect_near_oracle<float>(rounded_to<float>(net));
      expect_near_oracle<double>(net);
    }
  }
}

// nan where du x dv is zero (a side that is a point) and where a parameter is nan; elsewhere not.
TEST_P(CurvatureTest, IsNanWhereThereIsNoNormal) {
  Random random(64);
  for (const Degrees& degrees : {Degrees{3, 3}, {2, 4}, {8, 7}}) {
    Net net = dish(degrees, random);
    for (int i = 1; i <= net.degree_u; ++i) {
      net.at(0, i) = net.at(0, 0);
    }
    net = rounded_to<float>(net);
    const PatchSet<float> set = packed<float>(std::span(&net, 1));
    CurvaturePlanes<float> planes(kNu * kNv);
    grid(set, Grid<float>::uniform(kNu, kNv), planes.outputs());
    for (std::size_t k = 0; k < kNu * kNv; ++k) {
      for (std::size_t which = 0; which < 4; ++which) {
        EXPECT_EQ(std::isnan(planes.at(which, k)), k < kNu) << "sample " << k;
      }
    }
    SampleArrays<float> samples;
    samples.add(0, std::numeric_limits<float>::quiet_NaN(), 0.5F);
    samples.add(0, 0.5F, std::numeric_limits<float>::infinity());
    samples.add(0, 0.5F, 0.5F);
    CurvaturePlanes<float> some(3);
    scattered(set, samples.view(Parameters::unit), some.outputs());
    for (std::size_t which = 0; which < 4; ++which) {
      EXPECT_TRUE(std::isnan(some.at(which, 0)));
      EXPECT_TRUE(std::isnan(some.at(which, 1)));
      EXPECT_FALSE(std::isnan(some.at(which, 2)));
    }
  }
}

// A plane has curvatures of +0, also where its normal has negative components only and its tangents
// are more than a right angle apart, so that the terms of the mean curvature are -0: nobody wants
// to read that.
TEST_P(CurvatureTest, OfPlanesIsPositiveZero) {
  for (const bool rational : {false, true}) {
    for (const bool turned : {false, true}) {
      Net net = shaped_net({3, 2}, [&](int j, int i) {
        const double a = turned ? i : j;
        const double b = turned ? j : i;
        return Vector3{a, b - a, -b};
      });
      if (rational) {
        net.weights.assign(net.points.size(), 2);
      }
      CurvaturePlanes<float> planes(kNu * kNv);
      grid(packed<float>(std::span(&net, 1)), Grid<float>::uniform(kNu, kNv), planes.outputs());
      for (const float value : planes.values) {
        EXPECT_TRUE(same_bits(value, 0.0F)) << value << " " << rational << turned;
      }
    }
  }
}

// Each plane alone gives what all of them together do.
TEST_P(CurvatureTest, EveryPlaneIsOptional) {
  Random random(65);
  const Net net = rounded_to<float>(dish({4, 3}, random));
  const PatchSet<float> set = packed<float>(std::span(&net, 1));
  CurvaturePlanes<float> all(kNu * kNv);
  grid(set, Grid<float>::uniform(kNu, kNv), all.outputs());
  for (unsigned subset = 1; subset < 16; ++subset) {
    CurvaturePlanes<float> some(kNu * kNv);
    Outputs<float> out = some.outputs();
    Values<float>* const planes[] = {&out.curvature.gaussian, &out.curvature.mean,
                                     &out.curvature.minimum, &out.curvature.maximum};
    for (std::size_t which = 0; which < 4; ++which) {
      if (((subset >> which) & 1U) == 0) {
        *planes[which] = {};
      }
    }
    grid(set, Grid<float>::uniform(kNu, kNv), out);
    for (std::size_t k = 0; k < some.values.size(); ++k) {
      const bool wanted = ((subset >> (k / (kNu * kNv))) & 1U) != 0;
      EXPECT_TRUE(same_bits(some.values[k], wanted ? all.values[k] : -777.0F));
    }
  }
}
INSTANTIATE_FOR_EVERY_ISA(CurvatureTest);

} // namespace
} // namespace simdbezier::tests::curvature_test
