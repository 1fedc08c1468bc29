// Rates where few cells are left to be chosen from: near the most segments that there may be, and
// near the tolerance.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/rates.hpp>

namespace simdbezier::tests::rate_limits_test {
namespace {

/// The graph of z = uu u^2 + uv u v + vv v^2.
struct Graph {
  double uu;
  double uv;
  double vv;

  template <typename S>
  [[nodiscard]] std::vector<S> values(int degree) const {
    std::vector<S> values;
    const auto linear = [&](int k) { return 1.0 * k / degree; };
    const auto square = [&](int k) {
      return degree == 1 ? 0 : 1.0 * k * (k - 1) / (degree * (degree - 1));
    };
    for (int j = 0; j <= degree; ++j) {
      for (int i = 0; i <= degree; ++i) {
        const double z = uu * square(i) + uv * linear(i) * linear(j) + vv * square(j);
        values.insert(values.end(),
                      {static_cast<S>(linear(i)), static_cast<S>(linear(j)), static_cast<S>(z)});
      }
    }
    return values;
  }
};

template <typename S>
struct Rated {
  std::array<std::uint32_t, 1> nu{1};
  std::array<std::uint32_t, 1> nv{1};
  std::array<std::uint16_t, 1> diagonals{};
  std::array<double, 1> deviation{};
  Report report;

  void choose(const std::vector<S>& values, int degree, const RateOptions& options) {
    const ControlNets<S> nets = ControlNets<S>::packed(values.data(), 1, degree, degree);
    Topology topology;
    ASSERT_EQ(find_topology(nets, topology), Status::ok);
    report = choose_rates<S>({&nets, 1}, topology, options, {nu, nv, diagonals, deviation},
                             {.threads = 1});
  }
  void certify(const std::vector<S>& values, int degree, std::uint32_t of_u, std::uint32_t of_v) {
    const ControlNets<S> nets = ControlNets<S>::packed(values.data(), 1, degree, degree);
    Topology topology;
    ASSERT_EQ(find_topology(nets, topology), Status::ok);
    nu[0] = of_u;
    nv[0] = of_v;
    report =
        certify_rates<S>({&nets, 1}, topology, {}, {nu, nv, diagonals, deviation}, {.threads = 1});
  }
  [[nodiscard]] double cells() const { return 1.0 * nu[0] * nv[0]; }
};

/// What some cells keep is kept, by as many cells at most.
template <typename S>
void expect_as_few(const std::vector<S>& values, int degree, const RateOptions& options,
                   std::uint32_t nu, std::uint32_t nv) {
  Rated<S> other;
  other.certify(values, degree, nu, nv);
  ASSERT_EQ(other.report.status, Status::ok);
  ASSERT_LE(other.deviation[0], options.tolerance);
  Rated<S> chosen;
  chosen.choose(values, degree, options);
  ASSERT_EQ(chosen.report.status, Status::ok);
  EXPECT_LE(chosen.deviation[0], options.tolerance);
  EXPECT_LE(chosen.cells(), other.cells());
  EXPECT_LE(std::max(chosen.nu[0], chosen.nv[0]), options.most_segments);
  EXPECT_GT(std::min(chosen.nu[0], chosen.nv[0]), 0U);
}

/// Bicubic patches go to the kernel first, others do not.
constexpr int kDegrees[] = {3, 4};

template <typename S>
class RateLimits : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RateLimits, Scalars);

TYPED_TEST(RateLimits, long_thin_cells_fit_the_segments_that_there_are) {
  struct Case {
    Graph graph;
    double tolerance;
    std::uint32_t most;
    std::uint32_t nu; ///< cells that keep the tolerance
    std::uint32_t nv;
  };
  constexpr Case kCases[] = {
      {{1.8e-7, 0.81, 1}, 1.5e-5, 4096, 7, 4096},
      {{1, 0.81, 1.8e-7}, 1.5e-5, 4096, 4096, 7},
      {{0, 0.5, 1}, 6.4e-5, 4096, 2, 2072},
      {{1, 0.5, 0}, 6.4e-5, 4096, 2072, 2},
      {{0, 0.02, 1}, 0.0046, 8, 1, 8},
      {{1, 0.02, 0}, 0.0046, 8, 8, 1},
      {{0, 0.1, 1}, 0.006, 8, 2, 8},
      {{1e-9, 0.1, 1}, 0.0056, 8, 8, 8},
  };
  for (const Case& each : kCases) {
    for (const int degree : kDegrees) {
      SCOPED_TRACE("case " + std::to_string(&each - kCases) + ", degree " + std::to_string(degree));
      RateOptions options;
      options.tolerance = each.tolerance;
      options.most_segments = each.most;
      expect_as_few(each.graph.template values<TypeParam>(degree), degree, options, each.nu,
                    each.nv);
    }
  }
}

TYPED_TEST(RateLimits, what_the_most_segments_keep_is_not_refused) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 1000; ++k) {
    SCOPED_TRACE("patch " + std::to_string(k));
    const double bent = std::pow(10, -3 * std::fabs(uniform(random)));
    const double twist = uniform(random);
    const int degree = kDegrees[k / 2 % 2];
    const Graph graph = k % 2 == 0 ? Graph{bent, twist, 1} : Graph{1, twist, bent};
    std::vector<TypeParam> values = graph.values<TypeParam>(degree);
    for (std::size_t z = 2; z < values.size(); z += 3) {
      values[z] += static_cast<TypeParam>(0.01 * uniform(random));
    }
    Rated<TypeParam> most;
    most.certify(values, degree, 8, 8);
    RateOptions options;
    options.most_segments = 8;
    options.tolerance = (1 + 0.6 * std::fabs(uniform(random))) * most.deviation[0];
    expect_as_few(values, degree, options, 8, 8);
  }
}

TYPED_TEST(RateLimits, deviations_of_many_segments_are_within_the_tolerance) {
  for (const Graph& graph : {Graph{1, 0, 0}, Graph{0, 0, 1}, Graph{1, 0, 1}}) {
    for (const int degree : kDegrees) {
      for (double n = 1500; n < 4050; n += 17) {
        SCOPED_TRACE(n);
        RateOptions options;
        options.tolerance = 0.25 * (graph.uu + graph.vv) / (n * n);
        expect_as_few(graph.values<TypeParam>(degree), degree, options, kMostSegments,
                      kMostSegments);
      }
    }
  }
}

TYPED_TEST(RateLimits, deviations_are_within_the_tolerance_whatever_else_is_asked) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 400; ++k) {
    SCOPED_TRACE("patch " + std::to_string(k));
    std::vector<TypeParam> values;
    for (int i = 0; i < 16; ++i) {
      values.push_back(static_cast<TypeParam>(i % 4 + 0.3 * uniform(random)));
      values.push_back(static_cast<TypeParam>(std::floor(i / 4.0) + 0.3 * uniform(random)));
      values.push_back(static_cast<TypeParam>(uniform(random)));
    }
    RateOptions options;
    options.tolerance = std::pow(10, -4 + uniform(random));
    options.normal_degrees = k % 2 == 0 ? 570 : kUnlimited;
    options.longest_edge = k % 2 == 0 ? kUnlimited : 10;
    Rated<TypeParam> chosen;
    chosen.choose(values, 3, options);
    ASSERT_EQ(chosen.report.status, Status::ok);
    EXPECT_LE(chosen.deviation[0], options.tolerance);
  }
}

TYPED_TEST(RateLimits, any_tolerance_however_large_takes_one_cell) {
  for (const double tolerance : {1e30, 1e300, std::numeric_limits<double>::infinity()}) {
    for (const int degree : kDegrees) {
      Rated<TypeParam> chosen;
      RateOptions options;
      options.tolerance = tolerance;
      chosen.choose(Graph{1, 2, 3}.values<TypeParam>(degree), degree, options);
      ASSERT_EQ(chosen.report.status, Status::ok);
      EXPECT_EQ(chosen.cells(), 1);
    }
  }
}

TEST(RateReports, name_the_first_patch_of_all_sets) {
  const Graph graph{1, 1, 1};
  const std::vector<double> one[2] = {graph.values<double>(3), graph.values<double>(2)};
  std::vector<double> cubic = one[0];
  cubic.insert(cubic.end(), one[0].begin(), one[0].end());
  const ControlNets<double> of_3 = ControlNets<double>::packed(cubic.data(), 2, 3, 3);
  const ControlNets<double> of_2 = ControlNets<double>::packed(one[1].data(), 1, 2, 2);
  const std::array<ControlNets<double>, 2> sets[2] = {{of_3, of_2}, {of_2, of_3}};
  struct Case {
    std::size_t order;
    std::array<double, 3> tolerances;
    std::size_t patch;
  };
  constexpr Case kCases[] = {
      {0, {1e-12, 1e-12, 1e-12}, 0}, {0, {1, 1e-12, 1e-12}, 1}, {0, {1, 1, 1e-12}, 2},
      {0, {0, 1, 1e-12}, 0},         {0, {1, -1, 0}, 1},        {1, {1e-12, 1e-12, 0}, 0},
      {1, {1, 1e-12, 1}, 1},         {1, {1, 1, 0}, 2}};
  for (const Case& each : kCases) {
    SCOPED_TRACE(&each - kCases);
    Topology topology;
    ASSERT_EQ(find_topology<double>(sets[each.order], topology), Status::ok);
    std::vector<std::uint32_t> nu(3);
    std::vector<std::uint32_t> nv(3);
    std::vector<std::uint16_t> diagonals(3);
    RateOptions options;
    options.tolerances = each.tolerances;
    const Report report =
        choose_rates<double>(sets[each.order], topology, options, {nu, nv, diagonals, {}});
    EXPECT_EQ(report.status, Status::bad_tolerance);
    EXPECT_EQ(report.item, each.patch);
  }
}

TEST(GridCertificates, are_refused_where_there_are_none) {
  struct Case {
    Weights weights;
    double x;
    double weight;
    double error;
    Status status;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case cases[] = {{Weights::homogeneous, 1e200, 1e-200, 0, Status::non_finite_input},
                        {Weights::homogeneous, 1e200, 1, 0, Status::ok},
                        {Weights::cartesian, 1, 1.5e308, 0, Status::ok},
                        {Weights::cartesian, 1, 1, -5, Status::bad_tolerance},
                        {Weights::cartesian, 1, 1, nan, Status::bad_tolerance},
                        {Weights::cartesian, 1, 1, 5, Status::ok}};
  for (const Case& each : cases) {
    SCOPED_TRACE(&each - cases);
    std::vector<double> values;
    for (int k = 0; k < 8; ++k) { // two bilinear patches; the second one is at fault
      const bool at_fault = k == 6;
      values.insert(values.end(), {at_fault ? each.x : k % 2, 1.0 * (k / 2 % 2), 1.0 * k,
                                   at_fault ? each.weight : 1});
    }
    const ControlNets<double> nets =
        ControlNets<double>::packed(values.data(), 2, 1, 1, 3, each.weights);
    const std::vector<double> errors = {0, each.error};
    std::vector<double> deviation(2);
    const Report report = certify_grids<double>({&nets, 1}, 3, 3, errors, deviation);
    EXPECT_EQ(report.status, each.status);
    EXPECT_EQ(report.item, each.status == Status::ok ? 0U : 1U);
    if (each.status == Status::ok) {
      EXPECT_GE(deviation[1], each.error);
      EXPECT_GT(deviation[1], 0);
    }
  }
}

// All pairs of rates with one product are nearly as good for a saddle, whatever the degrees it is
// given in, and even if one direction bends a little.
template <typename S>
void expect_no_slivers(int degree, double bend) {
  SCOPED_TRACE("degree " + std::to_string(degree) + ", bend " + std::to_string(bend));
  RateOptions options;
  options.tolerance = 1e-3; // 1/4 of the mixed derivative over as many cells
  Rated<S> rated;
  rated.choose(Graph{bend, 1, 0}.values<S>(degree), degree, options);
  ASSERT_TRUE(rated.report);
  const auto [fewer, more] = std::minmax(rated.nu[0], rated.nv[0]);
  EXPECT_LE(more, (bend > 0.01 ? 8 : 2) * fewer);
  EXPECT_GE(fewer * more, 230U);
  EXPECT_LE(fewer * more, 260U);
}

TEST(SaddleRates, are_those_of_cells_that_are_no_slivers) {
  for (const int degree : {1, 2, 3, 4, 7}) {
    for (const double bend : {0.0, 1e-6, 2e-3, 2e-2, 2e-1}) {
      if (degree > 1 || bend == 0) {
        expect_no_slivers<float>(degree, bend);
        expect_no_slivers<double>(degree, bend);
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::rate_limits_test
