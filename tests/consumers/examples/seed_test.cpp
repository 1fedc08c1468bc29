// The textbook algorithms of examples/seed against the library, on the sample patch and on random
// nets: each one's own rounding in double is all that may lie between them beyond the library's
// certified bound.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

#include "examples/seed/bernstein.hpp"
#include "examples/seed/curve.hpp"
#include "examples/seed/sample_patch.hpp"
#include "examples/seed/subdivision.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests::seed_test {
namespace {

using seed::Point;

constexpr int kLevels = 4;
constexpr std::size_t kSide = 17; ///< of parameters k/16, which no format rounds
/// Roundings of the textbook algorithms, generously: six mixes of degree-3 patches make 18.
constexpr double kSeedRounding = 64 * 0x1p-53;

struct Case {
  std::string name;
  seed::Net net;
};

std::vector<Case> bicubic_cases() {
  std::vector<Case> cases = {{"sample", seed::sample_patch()}};
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    seed::Net net;
    for (int point = 0; point < 16; ++point) {
      // Values that float holds, so that both precisions see one surface.
      const auto value = [&random] { return static_cast<double>(random.integer(-999, 999)) / 512; };
      net.points.push_back({value(), value(), value()});
    }
    cases.push_back({"random " + std::to_string(k), net});
  }
  return cases;
}

double size_of(const std::vector<Point>& points) {
  double size = 0;
  for (const Point& p : points) {
    size = std::max(size, seed::distance(p, {}));
  }
  return size;
}

/// Every sample of a patch on the grid of k/16, from the library.
template <typename T>
struct Samples17 {
  explicit Samples17(const seed::Net& net) {
    const std::vector<T> points = seed::coordinates<T>(net.points);
    const auto nets = ControlNets<T>::packed(points.data(), 1, static_cast<int>(net.degree_u),
                                             static_cast<int>(net.degree_v));
    EXPECT_TRUE(static_cast<bool>(pack(nets, set)));
    Outputs<T> out;
    out.position = Vectors<T>::xyz(position.data());
    out.du = Vectors<T>::xyz(du.data());
    out.dv = Vectors<T>::xyz(dv.data());
    out.normal = Vectors<T>::xyz(normal.data());
    EXPECT_EQ(evaluate(set, Grid<T>::uniform(kSide, kSide), out), Status::ok);
    bounds = error_bounds(set, 0);
  }

  void expect_near(const std::vector<T>& found, std::size_t k, Point slow, const double* allowed,
                   double size) const {
    const Point p = seed::point_at(found, k);
    EXPECT_LE(std::abs(p.x - slow.x), allowed[0] + kSeedRounding * size) << "sample " << k;
    EXPECT_LE(std::abs(p.y - slow.y), allowed[1] + kSeedRounding * size) << "sample " << k;
    EXPECT_LE(std::abs(p.z - slow.z), allowed[2] + kSeedRounding * size) << "sample " << k;
  }

  PatchSet<T> set;
  ErrorBounds bounds;
  std::vector<T> position = std::vector<T>(3 * kSide * kSide);
  std::vector<T> du = position;
  std::vector<T> dv = position;
  std::vector<T> normal = position;
};

constexpr double parameter(std::size_t k) { return static_cast<double>(k) / (kSide - 1); }

template <typename T>
class SeedTest : public ::testing::Test {};
using Types = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SeedTest, Types);

TYPED_TEST(SeedTest, PatchPointsTangentsAndNormals) {
  for (const Case& test : bicubic_cases()) {
    SCOPED_TRACE(test.name);
    const Samples17<TypeParam> fast(test.net);
    const double size = size_of(test.net.points);
    for (std::size_t k = 0; k < kSide * kSide; ++k) {
      const seed::PatchPoint slow =
          seed::patch_point(test.net, parameter(k % kSide), parameter(k / kSide));
      fast.expect_near(fast.position, k, slow.position, fast.bounds.position, size);
      fast.expect_near(fast.du, k, slow.du, fast.bounds.du, 6 * size);
      fast.expect_near(fast.dv, k, slow.dv, fast.bounds.dv, 6 * size);
      // A normal turns by what its tangents err, relative to their product's length.
      const double* const e = fast.bounds.du;
      const double* const f = fast.bounds.dv;
      const double tangents = seed::length(slow.du) + seed::length(slow.dv);
      const double errors = e[0] + e[1] + e[2] + f[0] + f[1] + f[2] + 12 * kSeedRounding * size;
      const double turn = 2 * tangents * errors / seed::length(cross(slow.du, slow.dv));
      const double most = turn + 4 * static_cast<double>(std::numeric_limits<TypeParam>::epsilon());
      const std::array<double, 3> allowed = {most, most, most};
      fast.expect_near(fast.normal, k, slow.normal, allowed.data(), 1);
    }
  }
}

TYPED_TEST(SeedTest, PatchesOfOtherDegrees) {
  Random random(6);
  for (const auto& [m, n] : {std::array<std::size_t, 2>{1, 1}, {2, 5}, {4, 3}, {7, 2}, {6, 8}}) {
    SCOPED_TRACE(std::to_string(m) + "x" + std::to_string(n));
    seed::Net net{m, n, {}};
    while (net.points.size() < (m + 1) * (n + 1)) {
      const auto value = [&random] { return static_cast<double>(random.integer(-999, 999)) / 512; };
      net.points.push_back({value(), value(), value()});
    }
    const Samples17<TypeParam> fast(net);
    const double size = size_of(net.points);
    for (std::size_t k = 0; k < kSide * kSide; ++k) {
      const seed::PatchPoint slow =
          seed::patch_point(net, parameter(k % kSide), parameter(k / kSide));
      fast.expect_near(fast.position, k, slow.position, fast.bounds.position, 4 * size);
      fast.expect_near(fast.du, k, slow.du, fast.bounds.du, 64 * size);
      fast.expect_near(fast.dv, k, slow.dv, fast.bounds.dv, 64 * size);
    }
  }
}

TYPED_TEST(SeedTest, SixteenTerms) {
  for (const Case& test : bicubic_cases()) {
    SCOPED_TRACE(test.name);
    const Samples17<TypeParam> fast(test.net);
    for (std::size_t k = 0; k < kSide * kSide; ++k) {
      const Point slow = seed::bernstein_sum(test.net, parameter(k % kSide), parameter(k / kSide));
      fast.expect_near(fast.position, k, slow, fast.bounds.position, size_of(test.net.points));
    }
  }
}

TYPED_TEST(SeedTest, UniformSubdivision) {
  for (const Case& test : bicubic_cases()) {
    SCOPED_TRACE(test.name);
    const Samples17<TypeParam> fast(test.net);
    const seed::Mesh mesh = seed::subdivide(test.net, kLevels);
    ASSERT_EQ(mesh.side, kSide);
    ASSERT_EQ(mesh.quads.size(), (kSide - 1) * (kSide - 1));
    for (std::size_t k = 0; k < kSide * kSide; ++k) {
      fast.expect_near(fast.position, k, mesh.vertices[k], fast.bounds.position,
                       size_of(test.net.points));
    }
  }
}

// Quarters of nets, by the library's batch operation. Halving rounds sums only, in either place.
TEST(SeedSubdivision, QuartersAreThoseOfSplit) {
  for (const Case& test : bicubic_cases()) {
    SCOPED_TRACE(test.name);
    const std::vector<double> points = seed::coordinates<double>(test.net.points);
    std::vector<double> quarters(4 * points.size());
    std::array<MutableNets<double>, 4> out;
    for (std::size_t k = 0; k < 4; ++k) {
      out[k] = MutableNets<double>::packed(&quarters[k * points.size()], 1, 3, 3);
    }
    ASSERT_TRUE(static_cast<bool>(split(ControlNets<double>{points.data(), 1}, 0.5, 0.5, out)));
    const auto [low_u, high_u] = seed::halves_u(test.net);
    const auto [low_low, low_high] = seed::halves_v(low_u);
    const auto [high_low, high_high] = seed::halves_v(high_u);
    const std::array<const seed::Net*, 4> slow = {&low_low, &high_low, &low_high, &high_high};
    for (std::size_t k = 0; k < 64; ++k) {
      EXPECT_LE(seed::distance(seed::point_at(quarters, k), slow[k / 16]->points[k % 16]),
                kSeedRounding * size_of(test.net.points))
          << "point " << k;
    }
  }
}

TYPED_TEST(SeedTest, CurvePointsAndDerivatives) {
  using T = TypeParam;
  Random random(7);
  std::vector<std::vector<Point>> polygons = {seed::sample_patch().row(0)};
  for (std::size_t degree = 1; degree <= 8; ++degree) {
    polygons.emplace_back();
    while (polygons.back().size() <= degree) {
      const auto value = [&random] { return static_cast<double>(random.integer(-999, 999)) / 512; };
      polygons.back().push_back({value(), value(), value()});
    }
  }
  for (const std::vector<Point>& polygon : polygons) {
    const auto degree = static_cast<int>(polygon.size() - 1);
    SCOPED_TRACE("degree " + std::to_string(degree));
    const std::vector<T> points = seed::coordinates<T>(polygon);
    CurveSet<T> set;
    ASSERT_TRUE(static_cast<bool>(pack(ControlCurves<T>::packed(points.data(), 1, degree), set)));
    std::vector<T> position(3 * kSide);
    std::vector<T> d1(3 * kSide);
    CurveOutputs<T> out;
    out.position = Vectors<T>::xyz(position.data());
    out.d1 = Vectors<T>::xyz(d1.data());
    ASSERT_EQ(evaluate(set, CurveGrid<T>::uniform(kSide), out), Status::ok);
    const CurveErrorBounds bounds = error_bounds(set, 0);
    const double own = kSeedRounding * size_of(polygon);
    for (std::size_t k = 0; k < kSide; ++k) {
      const seed::CurvePoint slow = seed::de_casteljau(polygon, parameter(k));
      EXPECT_LE(seed::distance(seed::point_at(position, k), slow.position),
                *std::max_element(bounds.position, bounds.position + 3) + own);
      EXPECT_LE(seed::distance(seed::point_at(d1, k), slow.derivative),
                *std::max_element(bounds.d1, bounds.d1 + 3) + 2 * degree * own);
    }
  }
}

// What the algorithms do by themselves, where exact results are known.
TEST(SeedAlgorithms, KnownValues) {
  const seed::CurvePoint parabola = seed::de_casteljau({{0, 0, 0}, {1, 2, 0}, {2, 0, 0}}, 0.25);
  EXPECT_EQ(seed::distance(parabola.position, {0.5, 0.75, 0}), 0);
  EXPECT_EQ(seed::distance(parabola.derivative, {2, 2, 0}), 0);
  const seed::Net square{1, 1, {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {2, 3, 0}}};
  const seed::PatchPoint middle = seed::patch_point(square, 0.5, 0.5);
  EXPECT_EQ(seed::distance(middle.position, {1, 1.5, 0}), 0);
  EXPECT_EQ(seed::distance(middle.normal, {0, 0, 1}), 0);
  const seed::Net point{1, 1, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
  EXPECT_EQ(seed::distance(seed::patch_point(point, 0.5, 0.5).normal, {}), 0);
  // The sample patch at its middle: the mean with weights 1 3 3 1 / 8 in both directions.
  EXPECT_EQ(seed::distance(seed::bernstein_sum(seed::sample_patch(), 0.5, 0.5), {0, 0.46875, 0}),
            0);
}

} // namespace
} // namespace simdbezier::tests::seed_test
