// RateOptions::thorough: fewer cells than by default, wherever they may be fewer.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/mesh_models.hpp"
#include "tests/mesh/support/random_gluing.hpp"
#include "tests/mesh/support/uneven_patches.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::thorough_test {
namespace {

RateOptions within(double tolerance, bool thorough = true) {
  RateOptions options;
  options.tolerance = tolerance;
  options.thorough = thorough;
  return options;
}

/// The largest distance of samples of each cell from its two triangles, with the better diagonal.
double distance_of_cells(const TestPatch& patch, std::uint32_t nu, std::uint32_t nv) {
  double most = 0;
  for (std::uint32_t k = 0; k < nu * nv; ++k) {
    const auto at = [&](double u, double v) {
      return patch.at((k % nu + u) / nu, (static_cast<double>(k / nu) + v) / nv);
    };
    const Point p[] = {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
    double farthest[2] = {0, 0};
    for (std::uint32_t s = 0; s < 81; ++s) {
      const Point x = at(s % 9 / 8.0, s / 9 / 8.0);
      for (const std::size_t way : {std::size_t{0}, std::size_t{1}}) {
        const std::size_t last = 3 - way;
        farthest[way] =
            std::max(farthest[way], std::min(squared_distance(x, {p[0], p[1], p[last]}),
                                             squared_distance(x, {p[3 - last], p[3], p[2]})));
      }
    }
    most = std::max(most, std::min(farthest[0], farthest[1]));
  }
  return std::sqrt(most);
}

/// Adds a row or a column of cells, whichever is better, until samples are within a distance.
std::uint32_t greedy_cells(const TestPatch& patch, double distance) {
  std::uint32_t nu = 1;
  std::uint32_t nv = 1;
  while (distance_of_cells(patch, nu, nv) > distance) {
    const bool in_u = distance_of_cells(patch, nu + 1, nv) <= distance_of_cells(patch, nu, nv + 1);
    (in_u ? nu : nv) += 1;
  }
  return nu * nv;
}

/// Patches of whose cells the default has more than 1.6 times as many.
std::vector<TestPatch> wasteful_patches() {
  std::vector<TestPatch> all = {hull(), octant(kRoot, kRoot), octant(1, 1)};
  for (const unsigned seed : {2U, 4U, 5U, 8U, 11U}) {
    all.push_back(random_patch(seed));
  }
  return all;
}

TEST(Thorough, has_few_more_cells_than_a_greedy_search) {
  std::size_t wasted = 0;
  for (const TestPatch& patch : wasteful_patches()) {
    SCOPED_TRACE(patch.name);
    const double tolerance = 5e-3;
    const double greedy = greedy_cells(patch, tolerance);
    const Choices thorough({patch}, within(tolerance));
    ASSERT_EQ(thorough.status, Status::ok);
    EXPECT_LE(static_cast<double>(thorough.cells()), 1.6 * greedy);
    const Choices usual({patch}, within(tolerance, false));
    wasted += static_cast<double>(usual.cells()) > 1.6 * greedy ? 1 : 0;
  }
  EXPECT_GE(wasted, 3U) << "there is something to be gained";
}

TEST(Thorough, never_has_more_cells) {
  RateOptions edges;
  edges.longest_edge = 0.4;
  RateOptions angles;
  angles.normal_degrees = 20;
  RateOptions long_cells;
  long_cells.longest_edge = 0.08;
  double fewer[4] = {};
  for (const TestPatch& patch : uneven_and_random_patches(by_form(15U, 400U))) {
    SCOPED_TRACE(patch.name);
    std::size_t kind = 0;
    for (RateOptions options : {RateOptions(), edges, angles, long_cells}) {
      const Choices coarse({patch}, options); // what is asked for besides a distance
      for (const double tolerance : {1e-2, 1e-3}) {
        options.tolerance = tolerance;
        options.thorough = false;
        const Choices usual({patch}, options);
        options.thorough = true;
        const Choices thorough({patch}, options);
        ASSERT_EQ(thorough.status, usual.status);
        if (usual.status == Status::ok) { // weights far apart allow no bound of edges
          EXPECT_LE(thorough.cells(), usual.cells());
          EXPECT_LE(thorough.deviation[0], tolerance);
          EXPECT_GE(thorough.nu[0], kind > 0 ? coarse.nu[0] : 1);
          EXPECT_GE(thorough.nv[0], kind > 0 ? coarse.nv[0] : 1);
          fewer[kind] += thorough.cells() < usual.cells() ? 1 : 0;
        }
      }
      ++kind;
    }
  }
  for (const double count : fewer) {
    EXPECT_GT(count, 4);
  }
}

/// Rates of joined patches.
struct Joined {
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  std::vector<std::uint16_t> diagonals;
  std::vector<double> deviation;
  std::size_t raised = 0; ///< how many rates of such numbers would still have to be
  Status status;

  Joined(const std::vector<double>& values, const RateOptions& options, const RunOptions& run = {})
      : nu(values.size() / 48), nv(nu.size()), diagonals(nu.size()), deviation(nu.size()) {
    const auto nets = ControlNets<double>::packed(std::span<const double>(values));
    Topology topology;
    EXPECT_EQ(find_topology(nets, topology), Status::ok);
    status = choose_rates(nets, topology, options, {nu, nv, diagonals, deviation}, run).status;
    EXPECT_EQ(separate_vertices(topology, nu, nv, raised), Status::ok);
  }
  [[nodiscard]] std::size_t cells() const {
    return std::inner_product(nu.begin(), nu.end(), nv.begin(), std::size_t{0});
  }
  friend bool operator==(const Joined&, const Joined&) = default;
};

/// A sheet of 5 x 5 patches whose control points are a lattice of random heights.
std::vector<double> sheet() {
  constexpr std::size_t kPatches = 5;
  constexpr std::size_t kPoints = 3 * kPatches + 1;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<std::array<double, 3>> lattice;
  for (std::size_t k = 0; k < kPoints * kPoints; ++k) {
    const auto along = [&](std::size_t n) {
      return static_cast<double>(n) + 0.6 * (uniform(random) - 0.5);
    };
    const double x = along(k % kPoints);
    lattice.push_back({x, along(k / kPoints), 2 * uniform(random)});
  }
  std::vector<double> values;
  for (std::size_t k = 0; k < 16 * kPatches * kPatches; ++k) {
    const std::size_t patch = k / 16;
    const std::size_t column = 3 * (patch % kPatches) + k % 4;
    const std::size_t row = 3 * (patch / kPatches) + k / 4 % 4;
    const auto& point = lattice[kPoints * row + column];
    values.insert(values.end(), point.begin(), point.end());
  }
  return values;
}

/// A tube of one patch around, whose rings are `rings` patches. Few cells of it have to be raised.
std::vector<double> tube(std::size_t rings) {
  std::vector<double> values;
  for (std::size_t k = 0; k < 16 * rings; ++k) {
    const double angle = 2 * 3.14159265358979 / 3 * static_cast<double>(k % 4 % 3);
    const double along = static_cast<double>(k / 16) + static_cast<double>(k / 4 % 4) / 3;
    const double radius = 1 + 0.3 * along * along;
    for (const double c : {radius * std::cos(angle), radius * std::sin(angle), 2 * along}) {
      values.push_back(c);
    }
  }
  return values;
}

void expect_no_more_cells(const std::vector<double>& values, double tolerance, std::size_t& fewer) {
  const Joined usual(values, within(tolerance, false));
  const Joined thorough(values, within(tolerance));
  ASSERT_EQ(thorough.status, usual.status);
  EXPECT_LE(thorough.cells(), usual.cells());
  EXPECT_EQ(thorough.raised, usual.raised);
  EXPECT_LE(*std::max_element(thorough.deviation.begin(), thorough.deviation.end()), tolerance);
  fewer += thorough.cells() < usual.cells() ? 1 : 0;
}

TEST(Thorough, never_has_more_cells_where_patches_are_joined) {
  std::size_t fewer = 0;
  for (const double tolerance : {0.1, 0.03, 0.01}) {
    for (const MeshModel& model : mesh_models()) {
      SCOPED_TRACE(model.name);
      expect_no_more_cells(model.values(), tolerance, fewer);
    }
    for (unsigned seed = 0; seed < by_form(80U, 2000U); ++seed) {
      SCOPED_TRACE(seed);
      expect_no_more_cells(RandomGluing(seed).values, tolerance, fewer);
    }
  }
  for (const std::size_t rings : {1U, 2U}) {
    for (double tolerance = 0.01; tolerance < 0.6; tolerance *= 1.15) {
      SCOPED_TRACE(tolerance);
      expect_no_more_cells(tube(rings), tolerance, fewer);
    }
  }
  EXPECT_GT(fewer, 10U);
}

// Rates of the sheet's patches do not depend on others, wherever these are.
TEST(Thorough, is_the_same_for_any_number_of_threads_and_in_any_surroundings) {
  const std::vector<double> values = sheet();
  RateOptions options = within(0.03);
  const Joined one(values, options, {.threads = 1});
  ASSERT_EQ(one.status, Status::ok);
  EXPECT_LT(10 * one.cells(), 9 * Joined(values, within(0.03, false)).cells());
  for (const int threads : {2, 3, 7}) {
    EXPECT_TRUE(Joined(values, options, {.threads = threads}) == one) << threads;
  }
  const std::vector<double> tolerances(values.size() / 48, options.tolerance);
  options.tolerances = tolerances;
  options.tolerance = kUnlimited;
  EXPECT_TRUE(Joined(values, options) == one);

  std::vector<double> more = values;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const RandomGluing gluing(seed);
    more.insert(more.end(), gluing.values.begin(), gluing.values.end());
  }
  const Joined beside(more, within(0.03));
  ASSERT_EQ(beside.status, Status::ok);
  EXPECT_TRUE(std::equal(one.nu.begin(), one.nu.end(), beside.nu.begin()));
  EXPECT_TRUE(std::equal(one.nv.begin(), one.nv.end(), beside.nv.begin()));
}

// The default's certificate of these rates is above the tolerance, so that it would not keep them.
TEST(Thorough, keeps_rates_that_it_has_chosen) {
  for (const TestPatch& patch : {hull(), random_patch(2)}) {
    SCOPED_TRACE(patch.name);
    RateOptions options = within(5e-3);
    options.keep = 1.5;
    Choice frame;
    frame.nu = frame.nv = {0};
    ASSERT_TRUE(choose_rates(patch.nets(), topology_of(patch), options, frame.out()));
    const Choice first = frame;
    options.tolerance = 6e-3;
    RateOptions fresh = options;
    fresh.keep = 0;
    Choice chosen;
    ASSERT_TRUE(choose_rates(patch.nets(), topology_of(patch), fresh, chosen.out()));
    ASSERT_LT(chosen.nu[0] * chosen.nv[0], first.nu[0] * first.nv[0]);
    ASSERT_TRUE(choose_rates(patch.nets(), topology_of(patch), options, frame.out()));
    EXPECT_EQ(frame.nu, first.nu);
    EXPECT_EQ(frame.nv, first.nv);
    EXPECT_LE(frame.deviation[0], options.tolerance);
    EXPECT_LE(found_deviation(patch, topology_of(patch), frame), frame.deviation[0]);
  }
}

TEST(Thorough, meshes_have_fewer_triangles) {
  for (const TestPatch& patch : wasteful_patches()) {
    SCOPED_TRACE(patch.name);
    MeshOptions options;
    options.rates = within(5e-3, false);
    const Mesh<double> usual = tessellate<double>(patch.nets(), options);
    options.rates.thorough = true;
    const Mesh<double> thorough = tessellate<double>(patch.nets(), options);
    ASSERT_EQ(thorough.report.status, Status::ok);
    EXPECT_LT(thorough.triangles.size(), usual.triangles.size());
    EXPECT_LE(thorough.deviation, 5e-3);
  }
}

} // namespace
} // namespace simdbezier::tests::thorough_test
