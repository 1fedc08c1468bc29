// Unit tangents and curvatures: plain ones, and their limits where C' vanishes.
#include <limits>

#include "tests/curves/curve_results.hpp"

namespace simdbezier::tests::curve_tangents_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One curve in space with a sample at t, and what is expected there.
struct Case {
  const char* name;
  int degree;
  std::vector<double> points; ///< x y z triples
  double t;
  double tangent[3];
  double curvature;
  SampleStatus status;
};

const double kRoot = std::sqrt(0.5);

const Case kCases[] = {
    {"line", 1, {0, 0, 0, 0, 3, 4}, 0.3, {0, 0.6, 0.8}, 0, SampleStatus::regular},
    // y = x^2: curvature 2 at the vertex.
    {"parabola", 2, {-1, 1, 0, 0, -1, 0, 1, 1, 0}, 0.5, {1, 0, 0}, 2, SampleStatus::regular},
    {"first points equal",
     3,
     {0, 0, 0, 0, 0, 0, 1, 1, 0, 3, 1, 0},
     0,
     {kRoot, kRoot, 0},
     kInfinity,
     SampleStatus::limit},
    {"last points equal",
     3,
     {0, 0, 0, 1, 2, 0, 2, 0, 2, 2, 0, 2},
     1,
     {1 / 3.0, -2 / 3.0, 2 / 3.0},
     kInfinity,
     SampleStatus::limit},
    {"three points equal",
     3,
     {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -2, 0},
     0,
     {0, -1, 0},
     0,
     SampleStatus::limit},
    {"three last points equal",
     3,
     {0, 0, 5, 1, 1, 1, 1, 1, 1, 1, 1, 1},
     1,
     {1 / std::sqrt(18), 1 / std::sqrt(18), -4 / std::sqrt(18)},
     0,
     SampleStatus::limit},
    // x = (t - 1/2)^2, y = (t - 1/2)^3: the middle looks from above.
    {"cusp in the middle",
     3,
     {0.25, -0.125, 0, -1 / 12.0, 0.125, 0, -1 / 12.0, -0.125, 0, 0.25, 0.125, 0},
     0.5,
     {1, 0, 0},
     kInfinity,
     SampleStatus::limit},
    // x = t^2, y = t^4: a parabola y = x^2 with C'(0) = 0.
    {"slow parabola",
     4,
     {0, 0, 0, 0, 0, 0, 1 / 6.0, 0, 0, 0.5, 0, 0, 1, 1, 0},
     0,
     {1, 0, 0},
     2,
     SampleStatus::limit},
    // x = t^2, y = t^5.
    {"slow and flat",
     5,
     {0, 0, 0, 0, 0, 0, 0.1, 0, 0, 0.3, 0, 0, 0.6, 0, 0, 1, 1, 0},
     0,
     {1, 0, 0},
     0,
     SampleStatus::limit},
    {"straight cusp",
     3,
     {0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0},
     1,
     {1, 0, 0},
     0,
     SampleStatus::limit},
    {"point", 3, {7, 8, 9, 7, 8, 9, 7, 8, 9, 7, 8, 9}, 0.4, {0, 0, 0}, 0, SampleStatus::degenerate},
    {"seven equal of eight",
     7,
     {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 4},
     0,
     {0, 0, 1},
     0,
     SampleStatus::limit},
};

class CurveTangents : public CurveTest {
protected:
  template <typename T>
  void meets(const Case& expected, double scale, double shift) {
    CurveBatch<T> batch{1, expected.degree, 3, Weights::none, {}};
    for (const double value : expected.points) {
      batch.points.push_back(static_cast<T>(value * scale + shift));
    }
    CurveResults<T> results(3, 3);
    const T t[] = {static_cast<T>(expected.t), static_cast<T>(expected.t),
                   static_cast<T>(expected.t)};
    evaluate(packed<T>(batch), CurveGrid<T>{3, t}, results.outputs());
    const double tolerance = sizeof(T) == sizeof(float) ? 1e-5 : 1e-12;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(static_cast<int>(results.status[k]), static_cast<int>(expected.status))
          << expected.name << " scale " << scale;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(static_cast<double>(results.at(3, c, k)), expected.tangent[c], tolerance)
            << expected.name << " component " << c << " scale " << scale;
      }
      const double curvature = static_cast<double>(results.curvature(k)) * scale;
      if (std::isinf(expected.curvature)) {
        EXPECT_EQ(curvature, expected.curvature) << expected.name;
      } else {
        EXPECT_NEAR(curvature, expected.curvature, 4 * tolerance) << expected.name;
      }
    }
  }
};

TEST_P(CurveTangents, KnownOnes) {
  for (const Case& expected : kCases) {
    for (const double scale : {1.0, 0x1p-30, 0x1p20}) {
      meets<double>(expected, scale, 0);
      if (expected.t != 0.5) { // thirds are no floats, and the cusp would be a narrow turn
        meets<float>(expected, scale, 0);
      }
    }
  }
}

/// Integers up to 2^52 on a line, so that the curvature at 0 is 0. One of them is larger by 1, and
/// it is infinite: products in double cannot tell the one from the other.
TEST_P(CurveTangents, OneBitBendsALine) {
  constexpr double kHalf = 0x1p51 + 1;
  constexpr double kEnd = 0x1p52 + 1;
  for (std::size_t beside = 0; beside < 4; ++beside) {
    CurveBatch<double> batch{
        1, 3, 3, Weights::none, {1, 1, 1, 1, 1, 1, kHalf, kHalf, 1, kEnd, kEnd, 1}};
    if (beside < 3) {
      batch.at(0, 3, beside) += 1;
    }
    CurveResults<double> results(2, 3);
    evaluate(packed<double>(batch), CurveGrid<double>::uniform(2), results.outputs());
    EXPECT_EQ(results.status[0], SampleStatus::limit) << beside;
    EXPECT_NEAR(results.at(3, 0, 0), kRoot, 1e-12) << beside;
    EXPECT_EQ(results.curvature(0), beside < 3 ? kInfinity : 0) << beside;
  }
}

/// (0,0,0), (s,0,0), (1,1,0): the curvature at 0 is 1 / (2 s^2), however small s is.
TEST_P(CurveTangents, TinyStepsHaveTangentsAndCurvatures) {
  for (const int exponent : {-100, -300, -360, -500, -600, -1000}) {
    const double step = std::ldexp(1.0, exponent);
    const CurveBatch<double> batch{1, 2, 3, Weights::none, {0, 0, 0, step, 0, 0, 1, 1, 0}};
    CurveResults<double> results(2, 3);
    evaluate(packed<double>(batch), CurveGrid<double>::uniform(2), results.outputs());
    EXPECT_EQ(results.status[0], SampleStatus::regular) << exponent;
    EXPECT_EQ(results.at(3, 0, 0), 1) << exponent;
    EXPECT_EQ(results.at(3, 1, 0), 0) << exponent;
    EXPECT_EQ(results.curvature(0), std::ldexp(0.5, -2 * exponent)) << exponent;
  }
}

TEST_P(CurveTangents, QuarterCircleHasCurvatureOne) {
  CurveBatch<double> batch{1, 2, 2, Weights::cartesian, {1, 0, 1, 1, 1, std::sqrt(0.5), 0, 1, 1}};
  CurveResults<double> results(37, 2);
  evaluate(packed<double>(batch), CurveGrid<double>::uniform(37), results.outputs());
  for (std::size_t k = 0; k < 37; ++k) {
    const double x = results.at(0, 0, k);
    const double y = results.at(0, 1, k);
    EXPECT_NEAR(x * x + y * y, 1, 1e-15);
    EXPECT_NEAR(results.at(3, 0, k), -y, 1e-14);
    EXPECT_NEAR(results.at(3, 1, k), x, 1e-14);
    EXPECT_NEAR(results.curvature(k), 1, 1e-13);
  }
}

/// This holds where control points repeat, on the way to a cusp, and with weights.
TEST_P(CurveTangents, AreUnitVectorsAlongTheDerivative) {
  for (int degree = 1; degree <= kMostDegree; ++degree) {
    for (const double ratio : {0.0, 1.000002, 20.0}) { // the second: nearly equal weights
      auto batch = random_curves<float>(8, degree, 3, ratio, 12);
      for (std::size_t c = 0; c < 3 && degree > 1; ++c) {
        batch.at(1, 1, c) = batch.at(1, 0, c);
        batch.at(2, batch.order() - 2, c) = batch.at(2, batch.order() - 1, c);
      }
      std::vector<float> t;
      for (int e = 0; e < 40; ++e) {
        t.push_back(std::ldexp(1.0F, -e));
        t.push_back(1 - std::ldexp(1.0F, -e));
      }
      CurveResults<float> results(8 * t.size(), 3);
      evaluate(packed<float>(batch), CurveGrid<float>{t.size(), t.data()}, results.outputs());
      for (std::size_t k = 0; k < 8 * t.size(); ++k) {
        const double x = static_cast<double>(t[k % t.size()]) - 0.5;
        double exact[3];
        double squared = 0;
        double length = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          // The library rounds the parameter in the same way when it centres it.
          const auto centred = static_cast<double>(t[k % t.size()] - 0.5F);
          exact[c] = oracle_curve(batch, k / t.size(), c, centred).d[1].to_double();
          squared += exact[c] * exact[c];
          const auto tangent = static_cast<double>(results.at(3, c, k));
          length += tangent * tangent;
        }
        ASSERT_NEAR(length, 1, 1e-6) << "degree " << degree << " at " << x;
        if (squared > 1e-12) {
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_NEAR(static_cast<double>(results.at(3, c, k)), exact[c] / std::sqrt(squared),
                        4e-3 * (ratio > 0 ? 4 : 1))
                << "degree " << degree << " ratio " << ratio << " curve " << k / t.size() << " at "
                << x;
          }
        }
      }
    }
  }
}

// The square of C' overflows long before C' does.
TEST_P(CurveTangents, FarOutsideAreUnitVectorsAlongTheDerivative) {
  for (const int degree : {2, 3, 5, 15}) {
    CurveBatch<float> batch{1, degree, 3, Weights::none, {}};
    for (int i = 0; i <= degree; ++i) {
      const auto angle = static_cast<float>(i);
      batch.points.insert(batch.points.end(), {std::cos(angle), std::sin(2 * angle), 0.1F * angle});
    }
    const CurveSet<float> set = packed<float>(batch);
    std::size_t finite = 0;
    for (int power = 1; power < 60; ++power) {
      const float t = std::ldexp(1.0F, power);
      const std::uint32_t curve = 0;
      CurveResults<float> results(1, 3);
      evaluate(set, CurveSamples<float>{{&curve, 1}, {&t, 1}, Parameters::centred},
               results.outputs());
      double length = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        length = std::hypot(length, static_cast<double>(results.at(1, c, 0)));
      }
      if (!std::isfinite(length)) {
        continue;
      }
      ++finite;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(results.at(3, c, 0), static_cast<double>(results.at(1, c, 0)) / length, 1e-3)
            << degree << ", 2^" << power;
      }
    }
    EXPECT_GT(finite, 4U);
  }
}

// C' = 3 (t - r) (t + 3, t - 5) vanishes outside of the curve, where its roundings are large.
TEST_P(CurveTangents, VanishingOutsideHaveLimits) {
  for (double r = 8388607; r > 8380000; r -= 2) {
    const double x[] = {-3 * r, -3 * r - (r - 3) / 2, 1 - (r - 3) - 3 * r};
    const double y[] = {5 * r, 5 * r - (r + 5) / 2, 5 * r - (r + 5) + 1};
    CurveBatch<double> batch{1, 3, 3, Weights::none, {0, 0, 0}};
    for (std::size_t i = 0; i < 3; ++i) { // whole numbers
      batch.points.insert(batch.points.end(),
                          {batch.points[3 * i] + x[i], batch.points[3 * i + 1] + y[i], 0});
    }
    const auto t = static_cast<float>(2 * r - 1);
    if (static_cast<double>(t) != 2 * r - 1) {
      continue;
    }
    CurveSet<float> set;
    ASSERT_TRUE(pack(ControlCurves<double>::packed(batch.points.data(), 1, 3), set));
    const std::uint32_t curve = 0;
    CurveResults<float> results(1, 3);
    evaluate(set, CurveSamples<float>{{&curve, 1}, {&t, 1}, Parameters::centred},
             results.outputs());
    ASSERT_EQ(results.status[0], SampleStatus::limit) << r;
    ASSERT_NEAR(std::fabs(results.at(3, 0, 0)), kRoot, 1e-5);
  }
}

TEST_P(CurveTangents, ParametersThatAreNotFiniteGiveNan) {
  const float t[] = {0.25F, std::numeric_limits<float>::quiet_NaN(),
                     std::numeric_limits<float>::infinity(), 0.75F};
  const CurveSet<float> set = packed<float>(random_curves<float>(3, 6, 3, 0, 2));
  CurveResults<float> grid(12, 3);
  evaluate(set, CurveGrid<float>{4, t}, grid.outputs());
  const std::uint32_t curve[] = {1, 1, 2, 2};
  CurveResults<float> scattered(4, 3);
  evaluate(set, CurveSamples<float>{curve, t}, scattered.outputs());
  for (std::size_t d = 0; d < 4; ++d) {
    for (std::size_t k = 0; k < 4; ++k) {
      const bool bad = k == 1 || k == 2;
      for (std::size_t curves = 0; curves < 3; ++curves) {
        EXPECT_EQ(std::isnan(grid.at(d, 0, 4 * curves + k)), bad);
        EXPECT_EQ(grid.status[4 * curves + k] == SampleStatus::non_finite, bad);
      }
      EXPECT_EQ(std::isnan(scattered.at(d, 0, k)), bad);
      EXPECT_EQ(scattered.status[k] == SampleStatus::non_finite, bad);
    }
  }
}

INSTANTIATE_FOR_EVERY_ISA(CurveTangents);

} // namespace
} // namespace simdbezier::tests::curve_tangents_test
