// A factor that all weights have in common changes no surface, and so no certificate.
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/flatten.hpp>
#include <simdbezier/rates.hpp>

namespace simdbezier::tests::weight_scale_test {
namespace {

/// x y z w of `count` control points, all weights times a factor.
std::vector<double> weighted_values(unsigned seed, int count, Weights weights, double spread,
                                    double factor) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> values;
  for (int k = 0; k < count; ++k) {
    const std::array<double, 3> x = {uniform(random), uniform(random), uniform(random)};
    const double w = std::exp(spread * uniform(random)) * factor;
    for (const double value : x) {
      values.push_back(weights == Weights::homogeneous ? value * w : value);
    }
    values.push_back(w);
  }
  return values;
}

struct Certificate {
  std::array<std::uint32_t, 1> nu{3};
  std::array<std::uint32_t, 1> nv{2};
  std::array<std::uint16_t, 1> diagonals{};
  std::array<double, 1> deviation{};

  [[nodiscard]] CertifiedRates out() { return {nu, nv, diagonals, deviation}; }
  bool operator==(const Certificate&) const = default;
};

/// The factors: powers of two, whose products are exact, and others.
struct Factor {
  double value;
  bool exact;
};
const Factor kFactors[] = {{0x1p-3, true},   {0x1p5, true},    {0x1p-40, true},  {0x1p540, true},
                           {0x1p-540, true}, {0x1p1000, true}, {0x1p-900, true}, {1e-12, false},
                           {1e-160, false},  {1e200, false},   {1e-200, false},  {0.3, false}};

/// Certificates of given cells, of a grid, and of chosen cells with other limits.
std::vector<Certificate> patch_certificates(const std::vector<double>& values, int degree,
                                            Weights weights) {
  const auto nets = ControlNets<double>::packed(values.data(), 1, degree, degree, 3, weights);
  const std::span<const ControlNets<double>> sets(&nets, 1);
  Topology topology;
  EXPECT_EQ(find_topology(nets, topology), Status::ok);
  std::vector<Certificate> found(4);
  EXPECT_EQ(certify_rates(sets, topology, {}, found[0].out()).status, Status::ok);
  EXPECT_EQ(certify_grids(sets, 4, 5, {}, found[1].deviation).status, Status::ok);
  RateOptions options;
  options.tolerance = 1e-2;
  EXPECT_EQ(choose_rates(sets, topology, options, found[2].out()).status, Status::ok);
  options.tolerance = 10;
  options.longest_edge = 0.5;
  options.normal_degrees = 29;
  EXPECT_EQ(choose_rates(sets, topology, options, found[3].out()).status, Status::ok);
  return found;
}

std::vector<Certificate> curve_certificates(const std::vector<double>& values, int degree,
                                            Weights weights) {
  const auto curves = ControlCurves<double>::packed(values.data(), 1, degree, 3, weights);
  std::vector<Certificate> found;
  for (const double tolerance : {1.0, 1e-2, 1e-5}) {
    Certificate& one = found.emplace_back();
    EXPECT_EQ(choose_polylines(curves, {tolerance}, one.nu, one.deviation).status, Status::ok);
  }
  return found;
}

void expect_same(const std::vector<Certificate>& usual, const std::vector<Certificate>& scaled,
                 const Factor& factor) {
  ASSERT_EQ(usual.size(), scaled.size());
  for (std::size_t k = 0; k < usual.size(); ++k) {
    if (factor.exact) {
      EXPECT_EQ(usual[k], scaled[k]);
      continue;
    }
    EXPECT_EQ(usual[k].nu, scaled[k].nu);
    EXPECT_EQ(usual[k].nv, scaled[k].nv);
    EXPECT_NEAR(usual[k].deviation[0], scaled[k].deviation[0], 1e-9 * usual[k].deviation[0]);
  }
}

TEST(WeightScale, changes_no_certificate) {
  struct Case {
    int degree;
    Weights weights;
    double spread;
  };
  constexpr Case kCases[] = {
      {1, Weights::cartesian, 0}, {2, Weights::cartesian, 0},   {3, Weights::homogeneous, 0},
      {2, Weights::cartesian, 1}, {3, Weights::homogeneous, 1}, {5, Weights::homogeneous, 0.5},
  };
  for (const Case& each : kCases) {
    for (const Factor& factor : kFactors) {
      SCOPED_TRACE("case " + std::to_string(&each - kCases) + ", factor " +
                   std::to_string(std::log2(factor.value)));
      const auto unsigned_degree = static_cast<unsigned>(each.degree);
      const auto values = [&](int count, double by) {
        return weighted_values(unsigned_degree, count, each.weights, each.spread, by);
      };
      const int points = each.degree + 1;
      expect_same(
          patch_certificates(values(points * points, 1), each.degree, each.weights),
          patch_certificates(values(points * points, factor.value), each.degree, each.weights),
          factor);
      expect_same(curve_certificates(values(points, 1), each.degree, each.weights),
                  curve_certificates(values(points, factor.value), each.degree, each.weights),
                  factor);
    }
  }
}

TEST(WeightScale, weights_too_far_apart_have_no_bound) {
  for (const double least : {1e-250, 1e-310, 0x1p-1074}) {
    for (const double largest : {1.0, 1e10, 1e300}) {
      SCOPED_TRACE(std::log2(least));
      std::vector<double> values = weighted_values(1, 16, Weights::cartesian, 0, 1);
      values[3] = least;
      values[23] = largest;
      const auto nets = ControlNets<double>::packed(values.data(), 1, 3, 3, 3, Weights::cartesian);
      const std::span<const ControlNets<double>> sets(&nets, 1);
      Topology topology;
      ASSERT_EQ(find_topology(nets, topology), Status::ok);
      Certificate found;
      ASSERT_EQ(certify_rates(sets, topology, {}, found.out()).status, Status::ok);
      EXPECT_GT(found.deviation[0], 1e200);
      RateOptions options;
      options.tolerance = 1;
      EXPECT_EQ(choose_rates(sets, topology, options, found.out()).status, Status::bad_tolerance);
      const auto curves = ControlCurves<double>::packed(values.data(), 2, 7, 3, Weights::cartesian);
      std::array<std::uint32_t, 2> points{};
      EXPECT_EQ(choose_polylines(curves, {1}, points, {}).status, Status::bad_tolerance);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::weight_scale_test
