// Patches and curves whose control points are of very different sizes. What packing rounds is
// relative to the largest of them, and need not be small beside derivatives of the others: neither
// may certificates leave it out, nor normals that look well conditioned be taken for good.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/curves/curve_results.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/shaped_nets.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests::uneven_columns_test {
namespace {

constexpr int kN = 7;

/// How far a result of components is from the oracle's, by component.
template <typename T>
double distance(T found, const DoubleDouble& exact) {
  return std::fabs((DoubleDouble(static_cast<double>(found)) - exact).to_double());
}

struct Column {
  Degrees degrees;
  double large; ///< the first column, one point
  double small; ///< all others are that large
};

/// Each column is smaller than the one before by what T carries, and less.
template <typename T>
std::vector<Column> columns() {
  constexpr bool kSingle = sizeof(T) == sizeof(float);
  std::vector<Column> all;
  for (const Degrees& degrees : {Degrees{3, 3}, {1, 2}, {2, 3}, {5, 4}, {7, 6}, {12, 3}}) {
    for (const double small : {0x1p-20, 0x1p-34, 0x1p-48, 0x1p-55, 0x1p-90, 0x1p-112}) {
      if (kSingle ? small > 0x1p-60 : small < 0x1p-40) {
        all.push_back({degrees, kSingle ? 0x1.8p20 : 1.2345678901234567, small});
      }
    }
  }
  return all;
}

template <typename T>
Net column_net(const Column& c, int weights, Random& random) {
  Net net = shaped_net(c.degrees, [&](int, int i) {
    // Of doubles, two scales lie between the largest and the least, so that sums round.
    const bool middle = sizeof(T) == sizeof(double) && i == 1 && c.degrees.u > 1;
    return i == 0   ? Vector3{c.large, 0.7 * c.large, -0.3 * c.large}
           : middle ? Vector3{0.3 * 0x1p-40, 1.1 * 0x1p-40, -0.6 * 0x1p-40}
                    : Vector3{c.small * random.symmetric(), c.small * random.symmetric(),
                              c.small * random.symmetric()};
  });
  if (weights == 1) {
    net.weights.assign(net.points.size(), 0.75);
  } else if (weights == 2) {
    net = weighted(std::move(net), 2, random);
  }
  return rounded_to<T>(net);
}

class UnevenColumns : public IsaTest {
protected:
  template <typename T>
  void expect_sound() {
    Random random(91);
    for (const Column& c : columns<T>()) {
      for (int kind = 0; kind < 12; ++kind) {
        if (kind % 3 == 2 && c.small < 0x1p-96) {
          continue; // beyond the digits of the oracle's quotients
        }
        const Net straight = column_net<T>(c, kind % 3, random);
        const Net net = kind % 2 == 0 ? straight : transposed(straight);
        SCOPED_TRACE(std::to_string(c.degrees.u) + " x " + std::to_string(c.degrees.v) + ", " +
                     std::to_string(std::ilogb(c.small)) + ", kind " + std::to_string(kind));
        expect_sound<T>(net, kind >= 6);
      }
    }
    EXPECT_GT(normals_, 5000U);
    EXPECT_GT(tight_, 0U) << "no bound is near what occurs";
  }

  template <typename T>
  void expect_sound(const Net& net, bool local_origin) {
    const PatchSet<T> set =
        packed<T>(std::span(&net, 1), {.local_origin = local_origin, .isa = isa()});
    Planes<T> planes(kN * kN);
    grid(set, Grid<T>::uniform(kN, kN), planes.outputs());
    const ErrorBounds bounds = error_bounds(set, 0, isa());
    for (std::size_t k = 0; k < kN * kN; ++k) {
      const auto x =
          static_cast<double>(static_cast<T>(2.0 * static_cast<double>(k % kN) / (kN - 1) - 1));
      const auto y =
          static_cast<double>(static_cast<T>(2.0 * static_cast<double>(k / kN) / (kN - 1) - 1));
      const OracleSample exact = oracle_sample(net, x, y);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(distance(planes.at(0, i, k), exact.position[i]), bounds.position[i]) << k;
        const double error = distance(planes.at(2, i, k), exact.dv[i]);
        EXPECT_LE(error, bounds.dv[i]) << k;
        EXPECT_LE(distance(planes.at(1, i, k), exact.du[i]), bounds.du[i]) << k;
        tight_ += error > bounds.dv[i] / 0x1p10 ? 1 : 0;
      }
      expect_normal(net, exact, planes, k);
    }
  }

  template <typename T>
  void expect_normal(const Net& net, const OracleSample& sample, const Planes<T>& planes,
                     std::size_t k) {
    const OracleNormal exact = oracle_normal(net, sample);
    if (!(exact.kappa > 0 && exact.kappa < 0x1p8)) {
      return;
    }
    ++normals_;
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      square += std::pow(static_cast<double>(planes.at(3, i, k)) - exact.direction[i], 2);
    }
    EXPECT_LE(std::sqrt(square) * 180 / std::numbers::pi, 0.05) << "normal of sample " << k;
  }

  std::size_t normals_ = 0;
  std::size_t tight_ = 0;
};

TEST_P(UnevenColumns, HaveCertificatesThatHoldAndNormalsFloat) { expect_sound<float>(); }
TEST_P(UnevenColumns, HaveCertificatesThatHoldAndNormalsDouble) { expect_sound<double>(); }
INSTANTIATE_FOR_EVERY_ISA(UnevenColumns);

/// Hashes of what every instruction set computes of a net, which are equal in a class.
template <typename T>
void expect_one_class(const Net& net) {
  std::uint64_t known[2] = {0, 0};
  for (const Isa isa : available_isas()) {
    const PatchSet<T> set = packed<T>(std::span(&net, 1), {.isa = isa});
    Planes<T> planes(kN * kN);
    EXPECT_TRUE(evaluate(set, Grid<T>::uniform(kN, kN), planes.outputs(), {.isa = isa}));
    std::uint64_t& hash = known[fuses_multiply_add(isa) ? 1 : 0];
    hash = hash == 0 ? planes.hash() : hash;
    EXPECT_EQ(planes.hash(), hash) << to_string(isa);
  }
}

// The quick test of normals is the same everywhere, also where packing decides about it.
TEST(UnevenColumnsBits, AreEqualInAClass) {
  Random random(92);
  for (const Degrees& degrees : {Degrees{3, 3}, {2, 3}, {5, 4}, {7, 6}}) {
    for (int power = 8; power < 44; ++power) {
      for (int weights = 0; weights < 3; ++weights) {
        SCOPED_TRACE(std::to_string(degrees.u) + ", 2^-" + std::to_string(power));
        const Column c{degrees, 1.1, std::ldexp(1.0, -power)};
        expect_one_class<float>(column_net<float>(c, weights, random));
        expect_one_class<double>(column_net<double>(c, weights, random));
      }
    }
  }
}

class UnevenCurves : public CurveTest {
protected:
  /// d0 - 3 d1 + 3 d2 - d3 and the like, in which a small d1 is lost beside the others.
  template <typename T>
  void expect_certified() {
    const double small = sizeof(T) == sizeof(float) ? 0x1p-60 : 0x1.5p-100;
    const double size = sizeof(T) == sizeof(float) ? 1 : 1.2345678901234567;
    for (int degree = 2; degree <= kMostDegree; ++degree) {
      CurveBatch<T> batch{1, degree, 1, Weights::none, {}};
      Net net{degree, 1, {}};
      for (int i = 0; i <= degree; ++i) {
        const double value = i == 1 ? small : (i - 1) * size;
        batch.points.push_back(static_cast<T>(value));
        net.points.push_back({static_cast<double>(static_cast<T>(value)), 0, 0});
      }
      const std::vector<Vector3> row = net.points;
      net.points.insert(net.points.end(), row.begin(), row.end());
      const CurveSet<T> set = packed<T>(batch);
      CurveResults<T> results(kN, 1);
      evaluate(set, CurveGrid<T>::uniform(kN), results.outputs());
      const CurveErrorBounds bounds = error_bounds(set, 0, isa());
      for (std::size_t k = 0; k < kN; ++k) {
        const auto x =
            static_cast<double>(static_cast<T>(2.0 * static_cast<double>(k) / (kN - 1) - 1));
        const OracleSample exact = oracle_sample(net, x, 0);
        EXPECT_LE(distance(results.at(0, 0, k), exact.position[0]), bounds.position[0]);
        EXPECT_LE(distance(results.at(1, 0, k), exact.du[0]), bounds.d1[0]);
        EXPECT_LE(distance(results.at(2, 0, k), exact.duu[0]), bounds.d2[0]) << degree;
      }
    }
  }
};

TEST_P(UnevenCurves, KeepTheirCertificates) {
  expect_certified<float>();
  expect_certified<double>();
}

// A quotient of denormals is rounded by half of one, which is no share of anything.
TEST_P(UnevenCurves, OfDenormalsKeepTheirCertificates) {
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  CurveBatch<double> batch{1, 1, 1, Weights::cartesian, {kTiny, 196608, -4 * kTiny, 327680}};
  const CurveSet<double> set = packed<double>(batch);
  CurveResults<double> results(kN, 1);
  evaluate(set, CurveGrid<double>::uniform(kN), results.outputs());
  const CurveErrorBounds bounds = error_bounds(set, 0, isa());
  for (std::size_t k = 0; k < kN; ++k) {
    const long double t = static_cast<long double>(k) / (kN - 1);
    const long double w = 196608 * (1 - t) + 327680 * t;
    const long double slope = 196608.0L * 327680.0L * -5 / (w * w) * kTiny;
    EXPECT_LE(std::fabs(results.at(1, 0, k) - slope), bounds.d1[0]) << k;
  }
}

// Homogeneous points that differ by roundings are one point; near the denormals, their quotients
// differ by more than their own roundings.
TEST_P(UnevenCurves, OfMergedTinyPointsKeepTheirCertificates) {
  constexpr double kX = 0x1.3p-1030;
  constexpr double kW = 0x1.4p30;
  CurveBatch<double> batch{1, 1, 1, Weights::homogeneous, {kX, 1, kX * kW * (1 + 0x1p-46), kW}};
  const CurveSet<double> set = packed<double>(batch);
  CurveResults<double> results(1, 1);
  const std::uint32_t curve = 0;
  const double at = 0;
  evaluate(set, CurveSamples<double>{{&curve, 1}, {&at, 1}}, results.outputs());
  // C'(0) = (w1 / w0) (P1 - P0)
  const long double slope =
      static_cast<long double>(batch.points[2]) - kX * static_cast<long double>(kW);
  EXPECT_LE(std::fabs(results.at(1, 0, 0) - slope), error_bounds(set, 0, isa()).d1[0]);
}
INSTANTIATE_FOR_EVERY_ISA(UnevenCurves);

} // namespace
} // namespace simdbezier::tests::uneven_columns_test
