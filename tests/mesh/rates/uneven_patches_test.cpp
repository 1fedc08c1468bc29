// Rates and certificates of patches whose parameters run unevenly, against dense samples by sums of
// the tests' own: triangles can be close to their surface though points of equal parameters are
// not.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/dense_deviation.hpp"
#include "tests/mesh/support/uneven_patches.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::uneven_patches_test {
namespace {

Choice choose(const TestPatch& patch, double tolerance) {
  Choice choice;
  RateOptions options;
  options.tolerance = tolerance;
  EXPECT_EQ(choose_rates(patch.nets(), topology_of(patch), options, choice.out()).status,
            Status::ok)
      << patch.name;
  return choice;
}

/// Whether samples of each cell are within a distance of its two triangles, for either diagonal.
bool may_hold(const TestPatch& patch, std::uint32_t nu, std::uint32_t nv, double distance) {
  const auto cell_holds = [&](std::uint32_t i, std::uint32_t j) {
    const auto at = [&](double u, double v) { return patch.at((i + u) / nu, (j + v) / nv); };
    const Point p[] = {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
    for (const std::size_t last : {std::size_t{3}, std::size_t{2}}) {
      const std::array<Point, 3> halves[] = {{p[0], p[1], p[last]}, {p[3 - last], p[3], p[2]}};
      double farthest = 0;
      for (int k = 0; k <= 64 && farthest <= distance * distance; ++k) {
        const Point x = at(k % 8 / 8.0 + 0.125 * (k / 64), k / 8 / 8.0);
        farthest = std::max(
            farthest, std::min(squared_distance(x, halves[0]), squared_distance(x, halves[1])));
      }
      if (farthest <= distance * distance) {
        return true;
      }
    }
    return false;
  };
  for (std::uint32_t k = 0; k < nu * nv; ++k) {
    if (!cell_holds(k % nu, k / nu)) {
      return false;
    }
  }
  return true;
}

void expect_few_cells(const TestPatch& patch, double tolerance) {
  SCOPED_TRACE(patch.name + ", tolerance " + std::to_string(tolerance));
  const Choice choice = choose(patch, tolerance);
  const std::uint32_t chosen = choice.nu[0] * choice.nv[0];
  EXPECT_LE(choice.deviation[0], tolerance);
  for (std::uint32_t nu = 1; 1.6 * nu < chosen; ++nu) {
    for (std::uint32_t nv = 1; 1.6 * nu * nv < chosen; ++nv) {
      EXPECT_FALSE(may_hold(patch, nu, nv, tolerance))
          << chosen << " chosen, " << nu << " x " << nv;
    }
  }
}

TEST(UnevenPatches, have_few_more_cells_than_they_need) {
  for (const TestPatch& patch : {flat(kDoubled), flat(kPower), cone(0.3, kRoot), cone(0, kRoot),
                                 cone(0, 1e3), bicubic_cone(), octant(3, 3), octant(10, kRoot),
                                 octant(1e3, 1e3), bend(kEven, kDoubled), nearly_doubled()}) {
    expect_few_cells(patch, 2e-3);
  }
}

// A quarter of a circle needs 176 chords of that sagitta; points of equal parameters are so far
// apart that they would ask for more than 20 000 cells.
TEST(UnevenPatches, of_a_cone_have_few_cells_at_small_tolerances) {
  const Choice choice = choose(cone(0, kRoot), 1e-5);
  EXPECT_LE(choice.deviation[0], 1e-5);
  EXPECT_LE(choice.nu[0] * choice.nv[0], 256U);
}

// The fewest cells of which dense samples are within the tolerance, with one diagonal a quarter,
// are 420, 704, 10 and, of squares of cells, 365 x 365; with samples of triangles as well, 780.
TEST(UnevenPatches, with_one_heavy_weight_have_at_most_four_times_the_cells_they_need) {
  constexpr struct {
    double weight;
    double tolerance;
    std::uint32_t fewest;
  } kCases[] = {{1e3, 1e-2, 420},
                {1e5, 1e-2, 704},
                {1e6, 2e-2, 10},
                {1e5, 1e-3, 365 * 365},
                {1e6, 1e-2, 780}};
  for (const auto& heavy : kCases) {
    const TestPatch patch = net_of("one heavy weight", 3, 3, Weights::cartesian, [&](int i, int j) {
      return std::array{kEven[i], kEven[j], 0.3 * std::sin(1.7 * (4 * j + i) + 0.3),
                        i == 1 && j == 1 ? heavy.weight : 1.0};
    });
    const Choice choice = choose(patch, heavy.tolerance);
    EXPECT_LE(choice.deviation[0], heavy.tolerance);
    EXPECT_LE(choice.nu[0] * choice.nv[0], 4 * heavy.fewest) << heavy.weight;
  }
}

/// The mesh of copies of a patch that need not be where it is, how far samples of the first one are
/// from its triangles and, if these are few, they from that.
struct Sampled {
  MeshPlan<double> plan;
  double found = 0;

  Sampled(const TestPatch& patch, const std::vector<double>& values, const MeshOptions& options) {
    const auto nets =
        ControlNets<double>::packed(values.data(), values.size() / patch.values.size(),
                                    patch.degree_u, patch.degree_v, 3, patch.weights);
    plan = plan_mesh<double>(nets, options);
    EXPECT_EQ(plan.report.status, Status::ok);
    const Mesh<double> mesh = tessellate<double>(nets, options);
    EXPECT_EQ(mesh.report.status, Status::ok);
    if (plan.report.status == Status::ok && plan.cells_u[0] * plan.cells_v[0] <= 150) {
      const auto surface = [&](double u, double v) { return patch.at(u, v); };
      found = farthest_sample(plan, mesh, surface, 0, 4);
      found = plan.cells_u[0] * plan.cells_v[0] > 8
                  ? found
                  : std::max(found, farthest_from_surface(plan, mesh, surface, 0));
    }
  }
};

TEST(UnevenPatches, are_as_close_as_certified) {
  for (const TestPatch& patch : uneven_and_random_patches(by_form(40U, 400U))) {
    SCOPED_TRACE(patch.name);
    for (const double tolerance : {0.1, 0.02, -0.02}) {
      MeshOptions options;
      options.rates.tolerance = std::fabs(tolerance);
      options.rates.thorough = tolerance < 0;
      options.normals = false;
      const Sampled sampled(patch, patch.values, options);
      ASSERT_EQ(sampled.plan.deviations.size(), 1U);
      EXPECT_LE(sampled.found, sampled.plan.deviations[0]);
      EXPECT_LE(sampled.plan.deviations[0], options.rates.tolerance);
    }
  }
}

/// Two patches with a common edge at v = 1: `patch`, and its image behind that.
std::vector<double> with_neighbour(const TestPatch& patch) {
  std::vector<double> values = patch.values;
  const std::size_t row = patch.channels() * (static_cast<std::size_t>(patch.degree_u) + 1);
  for (std::size_t j = static_cast<std::size_t>(patch.degree_v) + 1; j-- > 0;) {
    for (std::size_t k = 0; k < row; ++k) {
      const bool moves = k % patch.channels() == 2 && j < static_cast<std::size_t>(patch.degree_v);
      values.push_back(patch.values[j * row + k] + (moves ? 3.0 : 0.0));
    }
  }
  return values;
}

// A neighbour's vertices on an edge cut triangles there.
TEST(UnevenPatches, are_as_close_as_certified_whatever_their_neighbours) {
  for (const TestPatch& patch : uneven_and_random_patches(by_form(30U, 300U))) {
    SCOPED_TRACE(patch.name);
    const std::vector<double> values = with_neighbour(patch);
    for (const bool thorough : {false, true}) {
      const std::array<double, 2> tolerances = {thorough ? 0.02 : 0.1, 0.005};
      MeshOptions options;
      options.rates.tolerances = tolerances;
      options.rates.thorough = thorough;
      options.normals = false;
      const Sampled sampled(patch, values, options);
      ASSERT_EQ(sampled.plan.deviations.size(), 2U);
      EXPECT_LE(sampled.found, sampled.plan.deviations[0]);
      EXPECT_LE(sampled.plan.deviations[0], tolerances[0]);
    }
  }
}

/// A flat patch whose side at v = 0 is a point: one cell would do, but makes no triangle there.
TestPatch raised_pole() {
  return net_of("pole", 3, 3, Weights::none, [](int i, int j) {
    return std::array{-500.0 + (j == 0 ? 0 : i), 1.0 * j, 5.0, 1.0};
  });
}

// Rates of the pole are raised after they were certified, and nothing joins it to the patch.
TEST(UnevenPatches, have_certificates_that_no_other_patch_changes) {
  RateOptions edges;
  edges.longest_edge = 0.4;
  RateOptions keeps;
  keeps.keep = 2;
  RateOptions thorough;
  thorough.thorough = true;
  for (const TestPatch& patch : uneven_and_random_patches(by_form(60U, 400U))) {
    SCOPED_TRACE(patch.name);
    for (RateOptions options : {RateOptions(), edges, keeps, thorough}) {
      for (const double tolerance : {0.1, 0.01}) {
        options.tolerance = tolerance;
        const Choices alone({patch}, options);
        if (!alone.status && std::isfinite(options.longest_edge)) {
          continue; // weights far apart allow no bound of edges
        }
        ASSERT_EQ(alone.status, Status::ok);
        Choices beside({patch, raised_pole()}, options);
        ASSERT_GT(beside.nu[1] * beside.nv[1], 1U);
        EXPECT_LE(beside.deviation[0], tolerance);
        beside.nu.pop_back();
        beside.nv.pop_back();
        beside.diagonals.pop_back();
        beside.deviation.pop_back();
        EXPECT_TRUE(beside == alone);
      }
    }
  }
}

template <typename T>
void expect_two_triangles(const double (&along)[4]) {
  const TestPatch patch = flat(along);
  const std::vector<T> values(patch.values.begin(), patch.values.end());
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    MeshOptions options;
    options.rates.tolerance = tolerance;
    const Mesh<T> mesh = tessellate<T>(ControlNets<T>::packed(std::span<const T>(values)), options);
    ASSERT_EQ(mesh.report.status, Status::ok);
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_LE(mesh.deviation, 1e-6);
  }
}

TEST(UnevenPatches, flat_squares_have_two_triangles) {
  expect_two_triangles<float>(kDoubled);
  expect_two_triangles<double>(kDoubled);
  expect_two_triangles<float>(kPower);
  expect_two_triangles<double>(kPower);
}

} // namespace
} // namespace simdbezier::tests::uneven_patches_test
