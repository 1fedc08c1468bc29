// The oracle against exact rational arithmetic: 2000 samples per run, degrees 1 to 15.
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/exact_rational.hpp"
#include "tests/support/net_shapes.hpp"
#include "tests/support/oracle.hpp"

namespace simdbezier::tests {
namespace {

struct OracleCase {
  const char* name;
  int degree_u;
  int degree_v;
  double offset;
  double parameter_range; ///< |x|, |y| up to this; above 1 extrapolates
  int samples;
};

constexpr OracleCase kOracleCases[] = {
    {"bicubic", 3, 3, 0, 1, 1000},        {"bicubic_far", 3, 3, 1e9, 1, 400},
    {"bicubic_outside", 3, 3, 0, 3, 200}, {"bilinear", 1, 1, 0, 1, 100},
    {"mixed_degrees", 2, 5, 0, 1, 200},   {"degree_15", 15, 15, 10, 1, 100}};

[[nodiscard]] Net random_degree_net(const OracleCase& test, Random& random) {
  Net net{test.degree_u, test.degree_v, {}};
  const int count = (test.degree_u + 1) * (test.degree_v + 1);
  for (int k = 0; k < count; ++k) {
    net.points.push_back({test.offset + random.symmetric(), test.offset + random.symmetric(),
                          test.offset + random.symmetric()});
  }
  return net;
}

/// |oracle - exact| / scale, the difference formed exactly.
[[nodiscard]] double relative_error(DoubleDouble oracle, const Rational& truth, double scale) {
  const Rational difference = exact(oracle) - truth;
  return std::abs(difference.get_d()) / scale;
}

[[nodiscard]] double worst_error(const Net& net, double x, double y) {
  const OracleSample oracle = oracle_sample(net, x, y);
  const ExactSample truth = exact_sample(net, x, y);
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double hodograph_u = largest_hodograph_u(net, c);
    const double hodograph_v = largest_hodograph_v(net, c);
    worst = std::max(
        {worst, relative_error(oracle.position[c], truth.position[c], largest_coordinate(net, c)),
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
// of the patch weights grow like |x|^(m+n), so there 2^-84.
TEST_P(OracleTest, AgreesWithExactRationals) {
  const OracleCase& test = GetParam();
  Random random(7);
  double worst = 0;
  for (int k = 0; k < test.samples; ++k) {
    const Net net = random_degree_net(test, random);
    const double x = test.parameter_range * random.symmetric();
    worst = std::max(worst, worst_error(net, x, test.parameter_range * random.symmetric()));
  }
  const double limit = test.parameter_range > 1 ? 0x1p-84 : 0x1p-96;
  EXPECT_LT(worst, limit) << "2^" << std::log2(worst);
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
      EXPECT_EQ(sample.position[c].to_double(), net.at(j, i)[c]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, OracleTest, ::testing::ValuesIn(kOracleCases),
                         [](const auto& row) { return std::string(row.param.name); });

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
} // namespace simdbezier::tests
