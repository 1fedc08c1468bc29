// Certificates of rational patches and curves of which the exact result is known without an oracle.
//
// In a plane z = constant, numerators around a local origin are what products of equal values
// leave, so that nothing but the rounding of packing is to be seen. Small weights make derivatives
// larger than all control points.
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "tests/curves/curve_results.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/nets/generators.hpp"
#include "tests/support/nets/shaped_nets.hpp"

namespace simdbezier::tests::known_certificates_test {
namespace {

struct Plane {
  double height;
  double ratio; ///< of the weights
};
constexpr Plane kPlanes[] = {{0.1, 4}, {0.7, 1e3}, {1234.567, 10}, {-3e-5, 1e4}};

class KnownPatches : public IsaTest {
protected:
  template <typename T>
  void expect_certified(bool local_origin) {
    constexpr std::size_t kN = 9; // the middle, where halves meet, among them
    Random random(11);
    for (int n = 1; n <= kMostDegree; ++n) {
      for (const Plane& plane : kPlanes) {
        const Degrees degrees{n, (n + 4) % 15 + 1};
        std::vector<Net> nets;
        while (nets.size() < 3) {
          const Net net = shaped_net(degrees, [&](int, int) {
            return Vector3{random.symmetric(), random.symmetric(), plane.height};
          });
          nets.push_back(rounded_to<T>(weighted(net, plane.ratio, random)));
        }
        const PatchSet<T> set = packed<T>(nets, {.local_origin = local_origin});
        Planes<T> planes(set.size() * kN * kN);
        grid(set, Grid<T>::uniform(kN, kN), planes.outputs());
        const auto z = static_cast<double>(static_cast<T>(plane.height));
        ErrorBounds bounds;
        for (std::size_t k = 0; k < planes.count(); ++k) {
          if (k % (kN * kN) == 0) {
            bounds = error_bounds(set, k / (kN * kN), isa());
          }
          const auto at = [&](std::size_t group) {
            return static_cast<double>(planes.at(group, 2, k));
          };
          ASSERT_LE(std::fabs(at(0) - z), bounds.position[2])
              << degrees.u << " x " << degrees.v << " sample " << k;
          ASSERT_LE(std::fabs(at(1)), bounds.du[2])
              << degrees.u << " x " << degrees.v << " sample " << k;
          ASSERT_LE(std::fabs(at(2)), bounds.dv[2])
              << degrees.u << " x " << degrees.v << " sample " << k;
          exceptions_ += at(0) != z || at(1) != 0 || at(2) != 0 ? 1 : 0;
        }
      }
    }
  }
  std::size_t exceptions_ = 0; ///< samples that are not exact
};

TEST_P(KnownPatches, InAPlaneKeepTheirCertificates) {
  for (const bool local_origin : {false, true}) {
    expect_certified<float>(local_origin);
    expect_certified<double>(local_origin);
  }
  EXPECT_GT(exceptions_, 1000U);
}
// A derivative of 1e39 at the corner with the small weight.
TEST_P(KnownPatches, HaveNoBoundWhereDerivativesOverflow) {
  Net net = shaped_net({1, 1}, [](int j, int i) { return Vector3{i * 1e35, j * 1e35, 0}; });
  net.weights = {1e-4, 1, 1, 1};
  const PatchSet<float> set = packed<float>(std::span(&net, 1));
  Planes<float> planes(4);
  grid(set, Grid<float>::uniform(2, 2), planes.outputs());
  const ErrorBounds bounds = error_bounds(set, 0, isa());
  ASSERT_TRUE(std::isinf(planes.at(1, 0, 0)) && std::isinf(planes.at(2, 1, 0)));
  EXPECT_TRUE(std::isinf(bounds.du[0]) && std::isinf(bounds.dv[1]));
  EXPECT_TRUE(std::isfinite(bounds.position[0]));
}
INSTANTIATE_FOR_EVERY_ISA(KnownPatches);

class KnownCurves : public CurveTest {
protected:
  template <typename T>
  void expect_certified(bool local_origin) {
    constexpr std::size_t kN = 17;
    constexpr std::size_t kCurves = 5;
    for (int n = 1; n <= kMostDegree; ++n) {
      for (const Plane& plane : kPlanes) {
        auto batch = random_curves<T>(kCurves, n, 3, plane.ratio, 13);
        for (std::size_t point = 0; point < batch.points.size(); point += batch.channels()) {
          batch.points[point + 2] = static_cast<T>(plane.height);
        }
        const CurveSet<T> set = packed<T>(batch, {.local_origin = local_origin});
        CurveResults<T> results(kCurves * kN, 3);
        evaluate(set, CurveGrid<T>::uniform(kN), results.outputs());
        const auto z = static_cast<double>(static_cast<T>(plane.height));
        CurveErrorBounds bounds;
        for (std::size_t k = 0; k < kCurves * kN; ++k) {
          if (k % kN == 0) {
            bounds = error_bounds(set, k / kN, isa());
          }
          const auto at = [&](std::size_t d) { return static_cast<double>(results.at(d, 2, k)); };
          ASSERT_LE(std::fabs(at(0) - z), bounds.position[2]) << "degree " << n << " sample " << k;
          ASSERT_LE(std::fabs(at(1)), bounds.d1[2]) << "degree " << n << " sample " << k;
          ASSERT_LE(std::fabs(at(2)), bounds.d2[2]) << "degree " << n << " sample " << k;
          exceptions_ += at(0) != z || at(1) != 0 || at(2) != 0 ? 1 : 0;
        }
      }
    }
  }
  std::size_t exceptions_ = 0;
};

TEST_P(KnownCurves, InAPlaneKeepTheirCertificates) {
  for (const bool local_origin : {false, true}) {
    expect_certified<float>(local_origin);
    expect_certified<double>(local_origin);
  }
  EXPECT_GT(exceptions_, 1000U);
}
TEST_P(KnownCurves, HaveNoBoundWhereDerivativesOverflow) {
  for (const double weight : {1e-4, 1e-2}) { // the first derivative, and the second alone
    CurveBatch<float> batch{1, 2, 1, Weights::cartesian, {}};
    batch.points = {0, static_cast<float>(weight), 1e35F, 1, 0, 1};
    const CurveSet<float> set = packed<float>(batch);
    CurveResults<float> results(2, 1);
    evaluate(set, CurveGrid<float>::uniform(2), results.outputs());
    const CurveErrorBounds bounds = error_bounds(set, 0, isa());
    ASSERT_EQ(std::isinf(results.at(1, 0, 0)), weight == 1e-4);
    ASSERT_TRUE(!std::isfinite(results.at(2, 0, 0)));
    EXPECT_EQ(std::isinf(bounds.d1[0]), weight == 1e-4);
    EXPECT_TRUE(std::isinf(bounds.d2[0]));
    EXPECT_TRUE(std::isfinite(bounds.position[0]));
  }
}
INSTANTIATE_FOR_EVERY_ISA(KnownCurves);

} // namespace
} // namespace simdbezier::tests::known_certificates_test
