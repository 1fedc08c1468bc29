// Polylines against curves that the test evaluates by formulas of its own.
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/flatten.hpp>

namespace simdbezier::tests::flatten_test {
namespace {

struct TestCurve {
  int degree = 3;
  int components = 3;
  Weights weights = Weights::none;
  std::vector<double> values;

  [[nodiscard]] ControlCurves<double> curves() const {
    return ControlCurves<double>::packed(std::span<const double>(values), degree, components,
                                         weights);
  }
  /// De Casteljau's algorithm on homogeneous points.
  [[nodiscard]] std::array<double, 3> at(std::size_t curve, double t) const {
    const auto n = static_cast<std::size_t>(degree);
    const auto c = static_cast<std::size_t>(components);
    const std::size_t channels = c + (weights == Weights::none ? 0 : 1);
    std::vector<std::array<double, 4>> p(n + 1);
    for (std::size_t i = 0; i <= n; ++i) {
      const double* const from = &values[(curve * (n + 1) + i) * channels];
      const double w = weights == Weights::none ? 1 : from[c];
      for (std::size_t k = 0; k < c; ++k) {
        p[i][k] = weights == Weights::cartesian ? w * from[k] : from[k];
      }
      p[i][3] = w;
    }
    for (std::size_t level = n; level > 0; --level) {
      for (std::size_t i = 0; i < level; ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
          p[i][k] = (1 - t) * p[i][k] + t * p[i + 1][k];
        }
      }
    }
    return {p[0][0] / p[0][3], p[0][1] / p[0][3], p[0][2] / p[0][3]};
  }
};

TestCurve random_curves(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  TestCurve curve;
  curve.degree = 1 + static_cast<int>(random() % 9);
  curve.components = 1 + static_cast<int>(random() % 3);
  curve.weights = static_cast<Weights>(random() % 3);
  for (std::size_t k = 0; k < count * static_cast<std::size_t>(curve.degree + 1); ++k) {
    const double w = curve.weights == Weights::none ? 1 : std::exp(uniform(random));
    for (int c = 0; c < curve.components; ++c) {
      curve.values.push_back(5 * uniform(random) * (curve.weights == Weights::homogeneous ? w : 1));
    }
    if (curve.weights != Weights::none) {
      curve.values.push_back(w);
    }
  }
  return curve;
}

double distance_from_segment(const std::array<double, 3>& x, const std::array<double, 3>& a,
                             const std::array<double, 3>& b) {
  double along = 0;
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    along += (x[c] - a[c]) * (b[c] - a[c]);
    square += (b[c] - a[c]) * (b[c] - a[c]);
  }
  const double s = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  double rest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double d = x[c] - a[c] - s * (b[c] - a[c]);
    rest += d * d;
  }
  return std::sqrt(rest);
}

template <typename T>
class Flatten : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Flatten, Scalars);

TYPED_TEST(Flatten, polylines_are_as_close_as_certified) {
  using T = TypeParam;
  std::vector<double> ratios;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const TestCurve curve = random_curves(seed, 3);
    for (const double tolerance : {1.0, 0.1, 1e-3}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", tolerance " + std::to_string(tolerance));
      const Polylines<T> lines = flatten<T>(curve.curves(), tolerance);
      ASSERT_EQ(lines.report.status, Status::ok);
      EXPECT_LE(lines.deviation, tolerance);
      ASSERT_EQ(lines.first.size(), 4U);
      EXPECT_EQ(lines.first.back(), lines.points.size());
      double worst = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t segments = lines.first[k + 1] - lines.first[k] - 1;
        for (std::size_t s = 0; s < segments; ++s) {
          const auto& a = lines.points[lines.first[k] + s];
          const auto& b = lines.points[lines.first[k] + s + 1];
          for (int i = 0; i <= 4; ++i) {
            const double t = (static_cast<double>(s) + i / 4.0) / static_cast<double>(segments);
            worst = std::max(worst, distance_from_segment(curve.at(k, t), {a[0], a[1], a[2]},
                                                          {b[0], b[1], b[2]}));
          }
        }
      }
      EXPECT_LE(worst, lines.deviation * (1 + 1e-9) + 1e-14);
      if (curve.weights == Weights::none && curve.degree > 1) {
        ratios.push_back(lines.deviation / worst);
      }
    }
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LT(ratios[ratios.size() / 2], 3); // a bound of no use would pass everything above
}

TEST(FlattenSizes, are_the_least_that_hold) {
  // |C''| = 2 everywhere: n segments deviate by 1 / (4 n^2).
  TestCurve parabola;
  parabola.degree = 2;
  parabola.components = 2;
  parabola.values = {0, 0, 0.5, 0, 1, 1};
  for (const std::uint32_t n : {1U, 2U, 3U, 10U, 100U}) {
    std::array<std::uint32_t, 1> points{};
    std::array<double, 1> deviation{};
    const double exact = 1.0 / (4.0 * n * n);
    FlattenOptions options;
    options.tolerance = exact * 1.001;
    ASSERT_TRUE(choose_polylines(parabola.curves(), options, points, deviation));
    EXPECT_EQ(points[0], n + 1);
    EXPECT_NEAR(deviation[0], exact, 1e-4 * exact);
    options.tolerance = exact * 0.999;
    ASSERT_TRUE(choose_polylines(parabola.curves(), options, points, deviation));
    EXPECT_EQ(points[0], n + 2);
  }
}

TEST(FlattenSizes, bad_input_is_a_status) {
  TestCurve curve = random_curves(4, 2);
  std::array<std::uint32_t, 2> points{};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto status = [&](const FlattenOptions& options) {
    return choose_polylines(curve.curves(), options, points, {}).status;
  };
  for (const double tolerance : {0.0, -1.0, nan, 1e-15}) {
    EXPECT_EQ(status({tolerance}), Status::bad_tolerance);
  }
  const std::array<double, 2> fine = {1e-3, 1e-4};
  EXPECT_EQ(status({nan, fine}), Status::bad_tolerance);
  EXPECT_EQ(status({0, fine}), Status::bad_tolerance);
  const std::array<double, 2> errors = {0, 0.1};
  const Report report = choose_polylines(curve.curves(), {0.1, {}, errors}, points, {});
  EXPECT_EQ(report.status, Status::bad_tolerance);
  EXPECT_EQ(report.item, 1U);
  for (const double error : {-1e-3, -1.0, nan}) {
    const std::array<double, 2> impossible = {0, error};
    EXPECT_EQ(status({0.1, {}, impossible}), Status::bad_tolerance) << error;
  }
  EXPECT_EQ(choose_polylines(curve.curves(), {0.1}, std::span(points).first(1), {}).status,
            Status::unequal_lengths);
  EXPECT_EQ(status({0.1, std::span(errors).first(1)}), Status::unequal_lengths);
  FlattenOptions endless{1e-13}; // so many points would take minutes
  endless.most_points = 0xffffffff;
  EXPECT_EQ(choose_polylines(curve.curves(), endless, points, {}).status, Status::bad_tolerance);
  ControlCurves<double> none = curve.curves();
  none.points = nullptr;
  EXPECT_EQ(choose_polylines(none, {0.1}, points, {}).status, Status::null_input);
  none.degree = 0;
  EXPECT_EQ(choose_polylines(none, {0.1}, points, {}).status, Status::bad_degree);
  curve.values[curve.values.size() / 2] = nan;
  const Polylines<float> lines = flatten<float>(curve.curves(), 0.1);
  EXPECT_FALSE(lines);
  EXPECT_EQ(lines.report.item, 1U);
  EXPECT_TRUE(lines.points.empty());
  EXPECT_TRUE(flatten<float>(ControlCurves<double>{}, 0.1));
}

} // namespace
} // namespace simdbezier::tests::flatten_test
