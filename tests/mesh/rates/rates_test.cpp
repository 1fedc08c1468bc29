// The certificate of rates against dense samples of patches of every kind, by an evaluation and a
// distance of the test's own.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include <simdbezier/rates.hpp>

#include "tests/mesh/support/sampled_patch.hpp"

namespace simdbezier::tests::rates_test {
namespace {

/// Each second patch is bicubic. Of the others some are nearly so, in every form of weights, since
/// bicubic patches without weights have kernels of their own.
TestPatch random_patch(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  TestPatch patch;
  constexpr Weights kForms[] = {Weights::none, Weights::cartesian, Weights::homogeneous};
  patch.weights = kForms[seed / 2 % 3];
  if (seed % 2 != 0) {
    constexpr int kNear[][2] = {{3, 4}, {4, 3}, {3, 2}, {2, 3}};
    const std::size_t near = seed / 6;
    const auto any = [&] { return 1 + static_cast<int>(random() % 8); };
    patch.degree_u = near < std::size(kNear) ? kNear[near][0] : any();
    patch.degree_v = near < std::size(kNear) ? kNear[near][1] : any();
  }
  const double roughness = std::pow(10, uniform(random));
  const double spread = 1 + 4 * std::fabs(uniform(random));
  for (int j = 0; j <= patch.degree_v; ++j) {
    for (int i = 0; i <= patch.degree_u; ++i) {
      const double w = patch.weights == Weights::none ? 1 : std::exp(uniform(random)) * spread;
      const Point p = {3.0 * i + roughness * uniform(random), 2.0 * j + roughness * uniform(random),
                       roughness * uniform(random)};
      const double factor = patch.weights == Weights::homogeneous ? w : 1;
      patch.values.insert(patch.values.end(), {factor * p[0], factor * p[1], factor * p[2]});
      if (patch.weights != Weights::none) {
        patch.values.push_back(w);
      }
    }
  }
  patch.name = "patch " + std::to_string(seed) + ", degrees " + std::to_string(patch.degree_u) +
               " " + std::to_string(patch.degree_v) + ", weights " +
               std::to_string(static_cast<int>(patch.weights));
  return patch;
}

TEST(Rates, chosen_meshes_are_within_their_bound_and_that_within_the_tolerance) {
  std::vector<double> ratios;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const TestPatch patch = random_patch(seed);
    SCOPED_TRACE(patch.name);
    const Topology topology = topology_of(patch);
    for (const double tolerance : {1.0, 0.1, 0.02}) {
      Choice choice;
      RateOptions options;
      options.tolerance = tolerance;
      const ControlNets<double> nets = patch.nets();
      const Report report = choose_rates(std::span<const ControlNets<double>>(&nets, 1), topology,
                                         options, choice.out());
      ASSERT_EQ(report.status, Status::ok);
      EXPECT_LE(choice.deviation[0], tolerance);
      if (choice.nu[0] * choice.nv[0] > 150) {
        continue; // the distance of every sample from every triangle takes too long
      }
      const double found = found_deviation(patch, topology, choice);
      EXPECT_LE(found, choice.deviation[0]);
      if (patch.weights == Weights::none) {
        ratios.push_back(choice.deviation[0] / found);
      }
    }
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LT(ratios[ratios.size() / 2], 2.5); // a bound of no use would pass everything above
  EXPECT_GT(ratios.size(), 20U);
}

TEST(Rates, given_rates_are_certified) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const TestPatch patch = random_patch(seed);
    SCOPED_TRACE(patch.name);
    const Topology topology = topology_of(patch);
    for (const std::array<std::uint32_t, 2> rates :
         {std::array{1U, 1U}, {2U, 1U}, {1U, 3U}, {3U, 3U}, {4U, 7U}, {9U, 2U}}) {
      Choice choice;
      choice.nu[0] = rates[0];
      choice.nv[0] = rates[1];
      const ControlNets<double> nets = patch.nets();
      const std::span<const ControlNets<double>> sets(&nets, 1);
      ASSERT_EQ(certify_rates(sets, topology, {}, choice.out()).status, Status::ok);
      EXPECT_LE(found_deviation(patch, topology, choice), choice.deviation[0]);
      choice.diagonals[0] = 0;
      ASSERT_EQ(certify_grids(sets, rates[0], rates[1], {}, choice.deviation).status, Status::ok);
      EXPECT_LE(found_deviation(patch, topology, choice), choice.deviation[0]);
    }
  }
}

/// The patch with u and v exchanged, or one of them reversed.
TestPatch turned(const TestPatch& patch, bool transpose, bool reverse) {
  TestPatch result = patch;
  const int m = patch.degree_u;
  const int n = patch.degree_v;
  if (transpose) {
    std::swap(result.degree_u, result.degree_v);
  }
  const std::size_t channels = patch.channels();
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= m; ++i) {
      const int k = reverse ? m - i : i;
      const auto from = channels * static_cast<std::size_t>(j * (m + 1) + i);
      const auto to =
          channels * static_cast<std::size_t>(transpose ? k * (n + 1) + j : j * (m + 1) + k);
      std::copy_n(&patch.values[from], channels, &result.values[to]);
    }
  }
  return result;
}

/// Nothing promises this: about one patch in a hundred gets another number of cells if it is
/// transposed, since not all ratios of rows to columns are tried. None of these 60 does.
TEST(Rates, turned_patches_have_turned_rates) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const TestPatch patch = random_patch(seed);
    SCOPED_TRACE(patch.name);
    const auto choose = [](const TestPatch& of) {
      Choice choice;
      RateOptions options;
      options.tolerance = 0.05;
      const ControlNets<double> nets = of.nets();
      EXPECT_TRUE(choose_rates(std::span<const ControlNets<double>>(&nets, 1), topology_of(of),
                               options, choice.out()));
      return choice;
    };
    const Choice original = choose(patch);
    for (const bool transpose : {false, true}) {
      const Choice other = choose(turned(patch, transpose, !transpose));
      EXPECT_EQ(original.nu[0] * original.nv[0], other.nu[0] * other.nv[0]) << transpose;
    }
  }
}

/// Frames whose tolerance rises and falls: rates change seldom, hold, and are never far too many.
TEST(Rates, of_the_frame_before_are_kept_while_they_suffice) {
  constexpr double kKeep = 1.5;
  int changes[2] = {0, 0};
  for (unsigned seed = 0; seed < 40; ++seed) {
    const TestPatch patch = random_patch(seed);
    SCOPED_TRACE(patch.name);
    const Topology topology = topology_of(patch);
    const ControlNets<double> nets = patch.nets();
    const std::span<const ControlNets<double>> sets(&nets, 1);
    Choice fresh;
    Choice kept;
    kept.nu[0] = seed % 3 == 0 ? 0 : kMostSegments + 1; // none yet
    for (int frame = 0; frame < 12; ++frame) {
      RateOptions options;
      options.tolerance = 0.1 * (1 + 0.15 * std::sin(1.7 * frame));
      options.longest_edge = seed % 5 == 0 ? 1.0 : kUnlimited;
      const Choice before[2] = {fresh, kept};
      ASSERT_EQ(choose_rates(sets, topology, options, fresh.out()).status, Status::ok);
      options.keep = kKeep;
      ASSERT_EQ(choose_rates(sets, topology, options, kept.out()).status, Status::ok);
      const auto cells = [](const Choice& choice) { return choice.nu[0] * choice.nv[0]; };
      EXPECT_LE(kept.deviation[0], options.tolerance);
      EXPECT_GE(cells(kept), cells(fresh));
      EXPECT_LE(cells(kept), kKeep * cells(fresh));
      if (seed % 5 == 0) {
        EXPECT_GE(kept.nu[0], fresh.nu[0]);
        EXPECT_GE(kept.nv[0], fresh.nv[0]);
      }
      if (frame == 0) {
        EXPECT_EQ(kept.nu, fresh.nu);
        EXPECT_EQ(kept.nv, fresh.nv);
        EXPECT_EQ(kept.diagonals, fresh.diagonals);
      } else {
        changes[0] += fresh.nu != before[0].nu || fresh.nv != before[0].nv ? 1 : 0;
        changes[1] += kept.nu != before[1].nu || kept.nv != before[1].nv ? 1 : 0;
      }
      if (frame % 4 == 1 && cells(kept) <= 60) {
        EXPECT_LE(found_deviation(patch, topology, kept), kept.deviation[0]);
      }
    }
  }
  EXPECT_GT(changes[0], 150);
  EXPECT_LT(3 * changes[1], changes[0]);
}

/// Between opposite sides that are points there are two cells at least, whatever would hold.
TEST(Rates, are_kept_that_were_raised_to_separate_vertices) {
  TestPatch lune = random_patch(0);
  for (int j = 0; j <= 3; ++j) {
    for (int i = 0; i <= 3; ++i) {
      const double width = j % 3 == 0 ? 0 : 2;
      const Point p = {width * (i - 1.5), 1.0 * j, 1.0 * j * (3 - j)};
      std::copy_n(p.begin(), 3, lune.values.begin() + 3 * (4 * j + i));
    }
  }
  const Topology topology = topology_of(lune);
  const ControlNets<double> nets = lune.nets();
  Choice kept;
  RateOptions options;
  options.keep = 1.5;
  for (const double tolerance : {1e-3, 1.2e-3}) {
    const Choice before = kept;
    options.tolerance = tolerance;
    ASSERT_EQ(choose_rates(nets, topology, options, kept.out()).status, Status::ok);
    EXPECT_EQ(kept.nu[0], 2U);
    EXPECT_TRUE(tolerance == 1e-3 || kept.nv == before.nv) << kept.nv[0] << ", " << before.nv[0];
  }
}

TEST(Rates, the_smaller_tolerance_counts) {
  const TestPatch patch = random_patch(0);
  const Topology topology = topology_of(patch);
  const ControlNets<double> nets = patch.nets();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto deviation = [&](double common, const std::vector<double>& own) {
    Choice choice;
    RateOptions options;
    options.tolerance = common;
    options.tolerances = own;
    const Report report = choose_rates(nets, topology, options, choice.out());
    return report ? choice.deviation[0] : nan;
  };
  const double fine = deviation(1e-3, {});
  EXPECT_LE(fine, 1e-3);
  EXPECT_GT(deviation(0.1, {}), fine);
  EXPECT_EQ(deviation(1e-3, {0.1}), fine);
  EXPECT_EQ(deviation(0.1, {1e-3}), fine);
  EXPECT_EQ(deviation(kUnlimited, {1e-3}), fine);
  EXPECT_TRUE(std::isnan(deviation(0.1, {nan})));
  EXPECT_TRUE(std::isnan(deviation(nan, {0.1})));
}

TEST(Rates, bad_input_is_a_status) {
  const TestPatch patch = random_patch(0);
  const Topology topology = topology_of(patch);
  const ControlNets<double> nets = patch.nets();
  const std::span<const ControlNets<double>> sets(&nets, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Choice choice;
  RateOptions options;
  for (const double tolerance : {0.0, -1.0, nan, 1e-12}) { // the last one needs too many cells
    options.tolerance = tolerance;
    const Report report = choose_rates(sets, topology, options, choice.out());
    EXPECT_EQ(report.status, Status::bad_tolerance) << tolerance;
    EXPECT_EQ(report.item, 0U);
  }
  options.tolerance = 0.1;
  const std::array<double, 1> errors = {0.1};
  options.errors = errors;
  EXPECT_EQ(choose_rates(sets, topology, options, choice.out()).status, Status::bad_tolerance);
  options.errors = {};
  options.longest_edge = 0;
  EXPECT_EQ(choose_rates(sets, topology, options, choice.out()).status, Status::bad_tolerance);
  options.longest_edge = std::numeric_limits<double>::infinity();
  CertifiedRates out = choice.out();
  out.cells_u = {};
  EXPECT_EQ(choose_rates(sets, topology, options, out).status, Status::bad_rates);
  EXPECT_EQ(choose_rates(sets, Topology(), options, choice.out()).status, Status::bad_rates);
  choice.nu[0] = 0;
  EXPECT_EQ(certify_rates(sets, topology, {}, choice.out()).status, Status::bad_rates);
  EXPECT_EQ(certify_grids(sets, 1, 0, {}, choice.deviation).status, Status::bad_rates);
  TestPatch broken = patch;
  broken.values[7] = nan;
  const ControlNets<double> bad = broken.nets();
  const std::span<const ControlNets<double>> of_bad(&bad, 1);
  EXPECT_EQ(choose_rates(of_bad, topology, options, choice.out()).status, Status::non_finite_input);
}

} // namespace
} // namespace simdbezier::tests::rates_test
