// The oracle against exact rational arithmetic: degrees 1 to 15, with and without weights.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/nets/shaped_nets.hpp"
#include "tests/support/oracle/exact_rational.hpp"
#include "tests/support/oracle/oracle.hpp"
#include "tests/support/oracle/oracle_curvature.hpp"

namespace simdbezier::tests::oracle_test {
namespace {

struct OracleCase {
  const char* name;
  int degree_u;
  int degree_v;
  double offset;
  double parameter_range; ///< |x|, |y| up to this; above 1 extrapolates
  int samples;
  double weight_ratio = 0; ///< 0: polynomial
  bool homogeneous = false;
};

constexpr OracleCase kOracleCases[] = {{"bicubic", 3, 3, 0, 1, 1000},
                                       {"bicubic_far", 3, 3, 1e9, 1, 400},
                                       {"bicubic_outside", 3, 3, 0, 3, 200},
                                       {"bilinear", 1, 1, 0, 1, 100},
                                       {"mixed_degrees", 2, 5, 0, 1, 200},
                                       {"degree_15", 15, 15, 10, 1, 100},
                                       {"rational", 3, 3, 0, 1, 200, 4},
                                       {"rational_2x2_equal", 2, 2, 0, 1, 100, 1},
                                       {"rational_4x6", 4, 6, 0, 1, 60, 1e2},
                                       {"rational_wild", 3, 5, 0, 1, 100, 1e4},
                                       {"rational_far", 2, 3, 1e6, 1, 100, 1e2},
                                       {"rational_15", 15, 15, 0, 1, 20, 1e2},
                                       {"homogeneous", 3, 2, 0, 1, 100, 1e2, true}};

[[nodiscard]] Net random_degree_net(const OracleCase& test, Random& random) {
  Net net{test.degree_u, test.degree_v, {}};
  const int count = (test.degree_u + 1) * (test.degree_v + 1);
  for (int k = 0; k < count; ++k) {
    net.points.push_back({test.offset + random.symmetric(), test.offset + random.symmetric(),
                          test.offset + random.symmetric()});
  }
  if (test.weight_ratio > 0) {
    net = weighted(std::move(net), test.weight_ratio, random);
  }
  return test.homogeneous ? homogeneous(std::move(net)) : net;
}

/// |oracle - exact| / scale, the difference formed exactly.
[[nodiscard]] double relative_error(DoubleDouble oracle, const Rational& truth, double scale) {
  const Rational difference = exact(oracle) - truth;
  return std::abs(difference.get_d()) / scale;
}

[[nodiscard]] double worst_error(const Net& net, double x, double y) {
  const OracleSample oracle = oracle_sample(net, x, y);
  const ExactSample truth = exact_sample(net, x, y);
  const Net polygon = control_polygon(net);
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double hodograph_u = largest_hodograph_u(polygon, c);
    const double hodograph_v = largest_hodograph_v(polygon, c);
    worst = std::max(
        {worst,
         relative_error(oracle.position[c], truth.position[c], largest_coordinate(polygon, c)),
         relative_error(oracle.du[c], truth.du[c], hodograph_u),
         relative_error(oracle.dv[c], truth.dv[c], hodograph_v),
         relative_error(oracle.duu[c], truth.duu[c], net.degree_u * hodograph_u),
         relative_error(oracle.duv[c], truth.duv[c], net.degree_v * hodograph_u),
         relative_error(oracle.dvv[c], truth.dvv[c], net.degree_v * hodograph_v)});
  }
  return worst;
}

class OracleTest : public ::testing::TestWithParam<OracleCase> {};

// 2^-96 leaves 43 bits below the unit roundoff of double for the bounds to be judged by. Outside
// of the patch weights grow like |x|^(m+n), so there 2^-84. The quotient rule magnifies errors by
// the ratio of the weights, by its square and cube in derivatives, and by an offset: the bounds of
// rational patches grow alike.
[[nodiscard]] double allowed_error(const OracleCase& test) {
  if (test.weight_ratio > 0) {
    const double cancelled = 1 + test.offset;
    return 0x1p-92 * std::pow(test.weight_ratio, 1.5) * cancelled;
  }
  return test.parameter_range > 1 ? 0x1p-84 : 0x1p-96;
}

TEST_P(OracleTest, AgreesWithExactRationals) {
  const OracleCase& test = GetParam();
  Random random(7);
  double worst = 0;
  for (int k = 0; k < test.samples; ++k) {
    const Net net = random_degree_net(test, random);
    const double x = test.parameter_range * random.symmetric();
    worst = std::max(worst, worst_error(net, x, test.parameter_range * random.symmetric()));
  }
  EXPECT_LT(worst, allowed_error(test)) << "2^" << std::log2(worst);
  EXPECT_GT(worst, 0) << "double-double arithmetic cannot be exact here: the test is broken";
}

TEST_P(OracleTest, CornersAreExact) {
  const OracleCase& test = GetParam();
  Random random(8);
  const Net net = random_degree_net(test, random);
  for (const int corner : {0, 1, 2, 3}) {
    const int i = corner % 2 == 0 ? 0 : test.degree_u;
    const int j = corner / 2 == 0 ? 0 : test.degree_v;
    const OracleSample sample =
        oracle_sample(net, corner % 2 == 0 ? -1 : 1, corner / 2 == 0 ? -1 : 1);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(sample.position[c].to_double(), control_polygon(net).at(j, i)[c]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, OracleTest, ::testing::ValuesIn(kOracleCases),
                         [](const auto& row) { return std::string(row.param.name); });

/// The largest relative errors of the curvatures at one sample: K, H^2 with the sign of H, and the
/// sum and product of the principal ones.
[[nodiscard]] double curvature_error(const Net& net, double x, double y) {
  const OracleCurvatures oracle = oracle_curvatures(oracle_sample(net, x, y));
  const ExactCurvature truth = exact_curvature(exact_sample(net, x, y));
  const double gaussian = std::abs(truth.gaussian.get_d());
  const double mean = std::abs(truth.mean_squared.get_d());
  const DoubleDouble square = oracle[1] * abs(oracle[1]);
  return std::max({relative_error(oracle[0], truth.gaussian, gaussian + mean),
                   relative_error(square, truth.mean_squared, gaussian + mean),
                   relative_error(oracle[2] * oracle[3], truth.gaussian, gaussian + mean),
                   std::abs((oracle[2] + oracle[3] - oracle[1] * 2.0).to_double())});
}

// Away from samples where the tangents are nearly parallel, which no curvature survives.
TEST(OracleCurvatureTest, AgreesWithExactRationals) {
  Random random(10);
  double worst = 0;
  for (int k = 0; k < 300; ++k) {
    const Degrees degrees{random.integer(1, 6), random.integer(1, 6)};
    Net net = shaped_wave_net(degrees, random);
    if (k % 3 == 0) {
      net = weighted(std::move(net), 4, random);
    }
    const double x = random.symmetric();
    const double y = random.symmetric();
    if (oracle_normal(net, oracle_sample(net, x, y)).relative_size > 1e-2) {
      worst = std::max(worst, curvature_error(net, x, y));
    }
  }
  EXPECT_LT(worst, 0x1p-80) << "2^" << std::log2(worst);
  EXPECT_GT(worst, 0);
}

// An exact sphere: |P| = 1, K = H = k1 = k2 = 1 where the normal points inwards, the pole apart.
TEST(OracleCurvatureTest, SphereOctant) {
  Random random(11);
  for (int k = 0; k < 200; ++k) {
    const Net net = k % 2 == 0 ? sphere_octant() : homogeneous(sphere_octant());
    const OracleSample sample = oracle_sample(net, random.symmetric(), 0.9 * random.symmetric());
    EXPECT_LT(std::abs((length(sample.position) - 1.0).to_double()), 0x1p-98);
    const OracleCurvatures curvature = oracle_curvatures(sample);
    const double outwards = dot(cross(sample.du, sample.dv), sample.position).to_double();
    EXPECT_LT(std::abs((curvature[0] - 1.0).to_double()), 0x1p-80);
    EXPECT_LT(std::abs((abs(curvature[1]) - 1.0).to_double()), 0x1p-80);
    EXPECT_LT(curvature[1].to_double() * outwards, 0) << "positive towards the normal";
  }
  const OracleSample pole = oracle_sample(sphere_octant(), 0.5, 1);
  EXPECT_TRUE(std::isnan(oracle_curvatures(pole)[0].to_double()));
}

// The same surface by other nets: one degree higher, transposed, reversed, homogeneous.
TEST(OracleNetTest, OperationsKeepTheSurface) {
  Random random(12);
  for (int k = 0; k < 100; ++k) {
    const Degrees degrees{random.integer(1, 9), random.integer(1, 9)};
    Net net = shaped_net(degrees, [&](int, int) {
      const double unit = degrees.u + 1;
      return Vector3{unit * random.integer(-99, 99), unit * random.integer(-99, 99),
                     unit * random.integer(-99, 99)};
    });
    for (std::size_t p = 0; k % 2 == 0 && p < net.points.size(); ++p) {
      net.weights.push_back((degrees.u + 1) * random.integer(1, 8));
      net.homogeneous = true;
    }
    const double x = random.symmetric();
    const double y = random.symmetric();
    const OracleSample here = oracle_sample(net, x, y);
    const OracleSample higher = oracle_sample(elevated_u(net), x, y);
    const OracleSample turned = oracle_sample(transposed(net), y, x);
    const OracleSample back = oracle_sample(reversed_u(net), -x, y);
    for (std::size_t c = 0; c < 3; ++c) {
      const double scale = 0x1p-85 * 1e3 * degrees.u;
      EXPECT_NEAR((here.position[c] - higher.position[c]).to_double(), 0, scale);
      EXPECT_NEAR((here.duu[c] - higher.duu[c]).to_double(), 0, 1e4 * scale);
      EXPECT_NEAR((here.position[c] - turned.position[c]).to_double(), 0, scale);
      EXPECT_NEAR((here.du[c] - turned.dv[c]).to_double(), 0, 1e2 * scale);
      EXPECT_NEAR((here.duv[c] + back.duv[c]).to_double(), 0, 1e4 * scale);
    }
  }
}

// A parameter of type double is split without rounding: t + (1-t) = 1 exactly.
TEST(OracleParameterTest, ComplementIsExact) {
  Random random(9);
  for (int k = 0; k < 1000; ++k) {
    const double x = random.symmetric() * std::ldexp(1.0, -random.integer(0, 50));
    const OracleParameter centred = OracleParameter::centred(x);
    EXPECT_EQ(exact(centred.t) + exact(centred.complement), 1);
    EXPECT_EQ(exact(centred.t), (1 + exact(x)) / 2);
    const OracleParameter unit = OracleParameter::unit(x);
    EXPECT_EQ(exact(unit.t) + exact(unit.complement), 1);
  }
}

// The degenerate normal: a pole's limit is the cap's axis.
TEST(OracleNormalTest, LimitAtThePoleOfACap) {
  constexpr double kParabola[] = {0, 0, 1 / 3.0, 1}; // v^2
  const Net net = bicubic([&](int j, int i) {
    const double along = (2 * i - 3) / 3.0;
    return Vector3{j / 3.0 * along, j / 3.0, 0.5 * kParabola[j]};
  });
  const OracleSample pole = oracle_sample(net, 0.25, -1);
  EXPECT_EQ(oracle_normal(net, pole).kappa, 0) << "the cross product vanishes at a pole";
  const Vector3 normal = oracle_limit_normal(net, 0.25, -1).direction;
  EXPECT_NEAR(normal[2], 1.0, 1e-12);
  EXPECT_NEAR(std::hypot(normal[0], normal[1]), 0.0, 1e-7);
}

} // namespace
} // namespace simdbezier::tests::oracle_test
