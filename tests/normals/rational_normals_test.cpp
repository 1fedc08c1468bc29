// The quick test of rational patches' normals: what it is made of bounds the tangents' errors, and
// it lets nearly all samples of ordinary patches pass. See kernels/pack/shape_floor.hpp.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "src/storage/patch_storage.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/shaped_nets.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests::rational_normals_test {
namespace {

constexpr int kN = 17;
constexpr std::size_t kSamples = kN * kN;

/// sqrt(2) c, rounded up: what packing multiplies the sizes by.
template <typename T>
constexpr double kTestFactor = sizeof(T) == 4 ? 0x1.7p-10 : 0x1.7p-20;

/// Weights that are uniform in [1, ratio], without any order.
[[nodiscard]] Net with_weights(Net net, double ratio, Random& random) {
  net.weights.clear();
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    net.weights.push_back(random.between(1, ratio));
  }
  return net;
}

[[nodiscard]] Net dish(Degrees degrees, Random& random) {
  return shaped_net(degrees, [&](int j, int i) {
    const double x = 2.0 * i / degrees.u - 1;
    const double y = 2.0 * j / degrees.v - 1;
    return Vector3{x, y, 0.3 * x * x - 0.2 * y * y + 0.2 * x * y + 0.02 * random.symmetric()};
  });
}

/// Profile points (radius, height, weight) turned through a quarter of a circle about the z axis.
[[nodiscard]] Net turned(const std::vector<Vector3>& profile) {
  const double half = std::sqrt(0.5);
  const double circle[3][3] = {{1, 0, 1}, {1, 1, half}, {0, 1, 1}};
  Net net{2, static_cast<int>(profile.size()) - 1, {}};
  for (const Vector3& p : profile) {
    for (const auto& c : circle) {
      net.points.push_back({p[0] * c[0], p[0] * c[1], p[1]});
      net.weights.push_back(p[2] * c[2]);
    }
  }
  return net;
}
[[nodiscard]] Net torus(double radius, double tube) {
  return turned({{radius + tube, 0, 1}, {radius + tube, tube, std::sqrt(0.5)}, {radius, tube, 1}});
}

class RationalNormalTest : public IsaTest {
protected:
  /// One net at all samples of a grid, and what the test compares with.
  template <typename T>
  struct Evaluated {
    Net net;
    Planes<T> planes{kSamples};
    std::vector<Parameters2<T>> at = grid_parameters<T>(kN, kN);
    double sizes[2] = {};

    [[nodiscard]] double weight(std::size_t k) const {
      const auto values =
          channel_derivatives(net, OracleParameter::centred(static_cast<double>(at[k].x)),
                              OracleParameter::centred(static_cast<double>(at[k].y)), {0, 0});
      return values[kWeightChannel].to_double();
    }
  };

  template <typename T>
  [[nodiscard]] Evaluated<T> evaluated(const Net& net, bool origins) {
    Evaluated<T> e{rounded_to<T>(net)};
    const PatchSet<T> set =
        packed<T>(std::span(&e.net, 1), {.local_origin = origins, .isa = isa()});
    grid(set, Grid<T>::uniform(kN, kN), e.planes.outputs());
    for (std::size_t d = 0; d < 2; ++d) {
      e.sizes[d] = static_cast<double>(set.storage()->buckets[0].normal_floor[d]);
    }
    return e;
  }

  template <typename T>
  void expect_bounded(const Net& net, bool origins) {
    const Evaluated<T> e = evaluated<T>(net, origins);
    for (std::size_t k = 0; k < kSamples; ++k) {
      const OracleSample exact =
          oracle_sample(e.net, static_cast<double>(e.at[k].x), static_cast<double>(e.at[k].y));
      const double weight = e.weight(k);
      for (std::size_t d = 0; d < 2; ++d) {
        const Vector3dd& derivative = d == 0 ? exact.du : exact.dv;
        const double unit = kUnitRoundoff<T> * e.sizes[d] / kTestFactor<T> / (weight * weight);
        for (std::size_t c = 0; c < 3; ++c) {
          const double error =
              (derivative[c] - static_cast<double>(e.planes.at(1 + d, c, k))).to_double();
          EXPECT_LE(std::abs(error), kMostRoundings * unit) << "sample " << k;
        }
      }
    }
  }
  /// Proved are the constants of docs/accuracy.md; found are at most 2.
  static constexpr double kMostRoundings = 4;

  /// The share of samples that need no second look.
  [[nodiscard]] double passing(const Net& net, bool origins) {
    const Evaluated<float> e = evaluated<float>(net, origins);
    std::size_t passed = 0;
    for (std::size_t k = 0; k < kSamples; ++k) {
      const std::array<float, 3> a = e.planes.vector(1, k);
      const std::array<float, 3> b = e.planes.vector(2, k);
      const Vector3 du{a[0], a[1], a[2]};
      const Vector3 dv{b[0], b[1], b[2]};
      const double area = std::hypot(du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                                     du[0] * dv[1] - du[1] * dv[0]);
      const double w = e.weight(k);
      const double floor = std::hypot(e.sizes[0] * std::hypot(dv[0], dv[1], dv[2]),
                                      e.sizes[1] * std::hypot(du[0], du[1], du[2])) /
                           (w * w);
      passed += area > floor ? 1 : 0;
    }
    return static_cast<double>(passed) / kSamples;
  }
};

TEST_P(RationalNormalTest, SizesBoundTheErrorsOfTangents) {
  Random random(91);
  for (const Degrees& degrees : {Degrees{2, 2}, {3, 3}, {5, 4}, {8, 7}}) {
    for (const double ratio : {1.0, 4.0, 100.0, 1e4}) {
      for (int k = 0; k < 4; ++k) {
        Net net = weighted(k % 2 == 0 ? shaped_random_net(degrees, random)
                                      : shaped_offset_net(degrees, random, 10),
                           ratio, random);
        for (double& weight : net.weights) {
          weight *= k < 2 ? 1 : 0x1p10; // the same surface
        }
        for (const bool origins : {false, true}) {
          SCOPED_TRACE(testing::Message() << degrees.u << " x " << degrees.v << ", ratio " << ratio
                                          << ", net " << k << ", origins " << origins);
          expect_bounded<float>(net, origins);
          expect_bounded<double>(net, origins);
        }
      }
    }
  }
}

TEST_P(RationalNormalTest, OrdinaryPatchesPass) {
  struct Case {
    double ratio;
    double share; ///< of all samples, at least
  };
  Random random(92);
  for (const Case& test : {Case{2, 1}, {4, 1}, {16, 0.99}}) {
    for (const Degrees& degrees : {Degrees{2, 2}, {3, 3}, {5, 5}, {7, 7}}) {
      for (const bool origins : {false, true}) {
        const Net net = with_weights(dish(degrees, random), test.ratio, random);
        EXPECT_GE(passing(net, origins), test.share)
            << degrees.u << " x " << degrees.v << ", ratio " << test.ratio << " " << origins;
      }
    }
  }
  // Of the sphere's octant, all samples pass except the row on its pole.
  constexpr double kButOneRow = 1 - 1.0 / kN;
  for (const bool origins : {false, true}) {
    EXPECT_DOUBLE_EQ(passing(torus(0, 1), origins), kButOneRow);
    EXPECT_DOUBLE_EQ(passing(sphere_octant(), origins), kButOneRow);
    EXPECT_EQ(passing(torus(3, 1), origins), 1);
    EXPECT_EQ(passing(torus(10, 1), origins), 1);
    EXPECT_EQ(passing(turned({{1, 0, 1}, {0.5, 1, 1}}), origins), 1);
    EXPECT_DOUBLE_EQ(passing(turned({{1, 0, 1}, {0, 1, 1}}), origins), kButOneRow);
  }
}

// Tangents that are nearly parallel: whoever answers, the normal is good.
TEST_P(RationalNormalTest, NearlyParallelTangents) {
  Random random(93);
  for (int exponent = 0; exponent <= 20; ++exponent) {
    const double flat = std::ldexp(1, -exponent);
    Net net = dish({3, 2}, random);
    for (Vector3& p : net.points) {
      p = {p[0] + p[1], flat * p[1], flat * p[2]};
    }
    net = with_weights(rotated(net, random_rotation(random)), 8, random);
    for (const bool origins : {false, true}) {
      const Evaluated<float> e = evaluated<float>(net, origins);
      for (std::size_t k = 0; k < kSamples; ++k) {
        const OracleNormal exact =
            oracle_normal(e.net, oracle_sample(e.net, static_cast<double>(e.at[k].x),
                                               static_cast<double>(e.at[k].y)));
        const std::array<float, 3> n = e.planes.vector(3, k);
        const double angle = std::hypot(n[0] - exact.direction[0], n[1] - exact.direction[1],
                                        n[2] - exact.direction[2]);
        EXPECT_LE(angle * 180 / std::numbers::pi, 0.02) << "2^-" << exponent << ", sample " << k;
      }
    }
  }
}

// Sizes and weights that leave the range of products: the second look answers.
TEST_P(RationalNormalTest, ExtremeScales) {
  Random random(94);
  const Net net = with_weights(dish({3, 2}, random), 4, random);
  const Evaluated<float> reference = evaluated<float>(net, false);
  for (const double scale : {0x1p-60, 0x1p-30, 0x1p30, 0x1p45}) {
    for (const double weight : {0x1p-30, 1.0, 0x1p30}) {
      if (scale * weight > 0x1p60 || scale * weight < 0x1p-80) {
        continue;
      }
      Net scaled = scaled_by(net, {scale, scale, scale});
      for (double& w : scaled.weights) {
        w *= weight;
      }
      const Evaluated<float> e = evaluated<float>(scaled, false);
      for (std::size_t k = 0; k < kSamples; ++k) {
        EXPECT_EQ(e.planes.status()[k], SampleStatus::regular) << scale << " " << weight;
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(e.planes.at(3, c, k), reference.planes.at(3, c, k), 1e-6)
              << scale << " " << weight;
        }
      }
    }
  }
}
INSTANTIATE_FOR_EVERY_ISA(RationalNormalTest);

} // namespace
} // namespace simdbezier::tests::rational_normals_test
