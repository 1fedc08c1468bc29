// tessellate() on models and on real data: closed where they are, oriented, without triangles that
// have no area, and as close to the surface as certified, by dense samples.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/dense_deviation.hpp"
#include "tests/mesh/support/triangle_census.hpp"
#include "tests/support/long_form.hpp"
#include "tests/support/nets/data_files.hpp"

namespace simdbezier::tests::tessellate_test {
namespace {

struct Model {
  std::string name;
  std::vector<PatchPoints> patches;

  [[nodiscard]] std::vector<double> values() const { return MeshModel{name, patches}.values(); }
};

/// A sheet of smooth patches with shared edges.
Model random_sheet(int columns, int rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const int width = 3 * columns + 1;
  std::vector<Point> net;
  for (int l = 0; l <= 3 * rows; ++l) {
    for (int k = 0; k < width; ++k) {
      net.push_back({k + 0.3 * uniform(random), l + 0.3 * uniform(random), uniform(random)});
    }
  }
  Model model{"sheet of " + std::to_string(columns * rows), {}};
  for (int q = 0; q < rows; ++q) {
    for (int p = 0; p < columns; ++p) {
      PatchPoints& patch = model.patches.emplace_back();
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          patch[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] =
              net[static_cast<std::size_t>((3 * q + j) * width + 3 * p + i)];
        }
      }
    }
  }
  return model;
}

template <typename T>
std::span<const std::uint32_t> numbers_of(const Mesh<T>& mesh) {
  return {mesh.triangles.empty() ? nullptr : mesh.triangles.front().data(),
          3 * mesh.triangles.size()};
}

/// What is true of every mesh.
template <typename T>
void expect_sound(const Mesh<T>& mesh, bool normals) {
  ASSERT_EQ(mesh.report.status, Status::ok) << "patch " << mesh.report.item;
  EXPECT_EQ(mesh.normals.size(), normals ? mesh.positions.size() : 0);
  std::size_t flat = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Point a = corner(mesh, t, 0);
    flat += length(cross(corner(mesh, t, 1) - a, corner(mesh, t, 2) - a)) > 0 ? 0 : 1;
  }
  EXPECT_EQ(flat, 0U) << "triangles without area";
  for (const auto& p : mesh.positions) {
    EXPECT_TRUE(std::isfinite(p[0] + p[1] + p[2]));
  }
  for (const auto& n : mesh.normals) {
    EXPECT_NEAR(std::sqrt(double(n[0]) * n[0] + double(n[1]) * n[1] + double(n[2]) * n[2]), 1,
                1e-5);
  }
}

template <typename T>
class TessellateModels : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TessellateModels, Scalars);

TYPED_TEST(TessellateModels, are_closed_and_as_close_as_certified) {
  using T = TypeParam;
  for (const MeshModel& model : mesh_models()) {
    if (model.repeated) {
      continue;
    }
    for (const double tolerance : {0.5, 0.05, 0.005}) {
      SCOPED_TRACE(model.name + ", tolerance " + std::to_string(tolerance));
      const std::vector<double> values = model.values();
      const auto nets = ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3);
      MeshOptions options;
      options.rates.tolerance = tolerance;
      options.topology.orient = model.orientable;
      const MeshPlan<T> plan = plan_mesh<T>(nets, options);
      const Mesh<T> mesh = tessellate<T>(nets, options);
      expect_sound(mesh, true);
      EXPECT_LE(mesh.deviation, tolerance);
      EXPECT_EQ(mesh.deviations.size(), model.patches.size());
      const TriangleCensus census = count_triangles(numbers_of(mesh), mesh.positions.size());
      EXPECT_EQ(census.euler, model.euler);
      EXPECT_EQ(census.degenerate + census.unused + census.out_of_range, 0U);
      if (model.manifold) {
        EXPECT_EQ(census.loops, model.loops);
        EXPECT_EQ(census.crowded + census.repeated, 0U);
        EXPECT_EQ(census.disagreeing > 0, !model.orientable);
      }
      for (std::size_t p = 0; p < model.patches.size() && mesh.triangles.size() < 400; ++p) {
        EXPECT_LE(found_deviation(plan, mesh, model.patches[p], p, 3), mesh.deviations[p]);
      }
    }
  }
}

TEST(TessellateData, is_closed_where_the_data_is_and_as_close_as_certified) {
  for (const char* const file : {"teapot.bpt", "teapot28.bez", "gumbo.bez", "pawn2.bez.gz",
                                 "wavy_cube.bez", "teacup.bez", "bigguy.bez.gz", "car4.bez.gz"}) {
    const Model model{file, patches_of(data_nets(file))};
    if (model.patches.empty()) {
      GTEST_SKIP() << "no data";
    }
    const std::vector<double> values = model.values();
    const auto nets = ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3);
    for (const double relative : {1e-1, 1e-2, 1e-3}) {
      SCOPED_TRACE(model.name + ", " + std::to_string(relative));
      MeshOptions options;
      options.relative_tolerance = relative;
      options.drop_repeated = true;
      const MeshPlan<float> plan = plan_mesh<float>(nets, options);
      const Mesh<float> mesh = tessellate<float>(nets, options);
      expect_sound(mesh, true);
      EXPECT_LE(mesh.deviation, relative * plan.diagonal);
      const TriangleCensus census = count_triangles(numbers_of(mesh), mesh.positions.size());
      EXPECT_EQ(census.degenerate + census.unused + census.repeated, 0U);
      EXPECT_EQ(census.crowded > 0, plan.counts.non_manifold_edges > 0 &&
                                        plan.topology.counts().non_manifold_edges > 0);
      EXPECT_EQ(census.open > 0, plan.topology.counts().open_edges > 0);
      EXPECT_EQ(census.disagreeing > 0, plan.topology.counts().turned_edges > 0);
      const std::size_t step = 1 + plan.set.size() / 40; // of large models some patches
      for (std::size_t p = 0; p < plan.set.size(); p += step) {
        const std::size_t given = plan.patches.empty() ? p : plan.patches[p];
        EXPECT_EQ(mesh.deviations[given], plan.deviations[p]);
        if (plan.cells_u[p] * plan.cells_v[p] < 150) {
          EXPECT_LE(found_deviation(plan, mesh, model.patches[given], p, 3), plan.deviations[p]);
        }
      }
    }
  }
}

TEST(Tessellate, has_the_type_of_the_nets_where_none_is_named) {
  const Model model = random_sheet(2, 2, 7);
  const std::vector<double> values = model.values();
  const std::vector<float> rounded(values.begin(), values.end());
  MeshOptions options;
  options.rates.tolerance = 0.01;
  const auto check = [&]<typename S>(const ControlNets<S>& nets) {
    const std::span<const ControlNets<S>> views(&nets, 1);
    const auto deduced = tessellate(nets, options);
    static_assert(std::is_same_v<decltype(deduced), const Mesh<S>>);
    static_assert(std::is_same_v<decltype(plan_mesh(nets, options)), MeshPlan<S>>);
    static_assert(std::is_same_v<decltype(tessellate<double>(nets, options)), Mesh<double>>);
    EXPECT_EQ(deduced.positions, tessellate<S>(nets, options).positions);
    EXPECT_EQ(tessellate(views, options).triangles, deduced.triangles);
    EXPECT_EQ(plan_mesh(views, options).cells_u, plan_mesh<S>(views, options).cells_u);
    EXPECT_FALSE(deduced.positions.empty());
  };
  check(ControlNets<double>::packed(std::span<const double>(values)));
  check(ControlNets<float>::packed(std::span<const float>(rounded)));
}

TEST(Tessellate, of_ten_thousand_random_patches_is_one_sheet) {
  const int side = by_form(100, 316); // 10^5 patches
  const Model model = random_sheet(side, side, 1);
  const std::vector<double> values = model.values();
  const auto nets = ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3);
  MeshOptions options;
  options.rates.tolerance = 0.05;
  const Mesh<float> mesh = tessellate<float>(nets, options);
  expect_sound(mesh, true);
  const TriangleCensus census = count_triangles(numbers_of(mesh), mesh.positions.size());
  EXPECT_EQ(census.euler, 1);
  EXPECT_EQ(census.loops, 1U);
  EXPECT_EQ(census.crowded + census.repeated + census.disagreeing + census.degenerate, 0U);
}

/// A torus of rational patches: circles of four arcs around circles of four arcs.
TEST(Tessellate, of_a_rational_torus_is_closed_and_as_close_as_certified) {
  const double s = std::sqrt(0.5);
  const std::array<std::array<double, 3>, 9> circle = {{{1, 0, 1},
                                                        {1, 1, s},
                                                        {0, 1, 1},
                                                        {-1, 1, s},
                                                        {-1, 0, 1},
                                                        {-1, -1, s},
                                                        {0, -1, 1},
                                                        {1, -1, s},
                                                        {1, 0, 1}}};
  constexpr double kRing = 3;
  std::vector<double> values; // biquadratic, homogeneous
  for (std::size_t q = 0; q < 4; ++q) {
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t i = 0; i < 3; ++i) {
          const auto& a = circle[2 * p + i];
          const auto& b = circle[2 * q + j];
          const double w = a[2] * b[2];
          const double r = kRing + b[0];
          values.insert(values.end(), {w * (r * a[0]), w * (r * a[1]), w * b[1], w});
        }
      }
    }
  }
  const auto nets = ControlNets<double>::packed(values.data(), 16, 2, 2, 3, Weights::homogeneous);
  for (const double tolerance : {0.3, 0.03, 0.003}) {
    SCOPED_TRACE(tolerance);
    MeshOptions options;
    options.rates.tolerance = tolerance;
    const Mesh<double> mesh = tessellate<double>(nets, options);
    expect_sound(mesh, true);
    const TriangleCensus census = count_triangles(numbers_of(mesh), mesh.positions.size());
    EXPECT_EQ(census.euler, 0);
    EXPECT_EQ(census.open + census.crowded + census.disagreeing, 0U);
    double worst = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int k = 0; k < 28; ++k) { // points of the triangle, and their distance from the torus
        const double l = k % 7 / 6.0;
        const double m = (1 - l) * (k / 7) / 3.0;
        const Point x =
            l * corner(mesh, t, 0) + m * corner(mesh, t, 1) + (1 - l - m) * corner(mesh, t, 2);
        const double from_ring = std::hypot(x[0], x[1]) - kRing;
        worst = std::max(worst, std::fabs(std::hypot(from_ring, x[2]) - 1));
      }
    }
    EXPECT_LE(worst, mesh.deviation);
    EXPECT_GT(worst, mesh.deviation / 4);
    for (std::size_t k = 0; k < mesh.normals.size(); ++k) {
      const Point x = mesh.positions[k];
      const double ring = std::hypot(x[0], x[1]);
      const Point exact = {x[0] * (1 - kRing / ring), x[1] * (1 - kRing / ring), x[2]};
      EXPECT_LT(length(mesh.normals[k] - exact), 1e-12);
    }
  }
}

/// A lid whose tip is a curve that ends where it begins, too large to be a point.
TEST(Tessellate, of_a_side_that_is_a_loop_has_no_triangle_without_area) {
  for (const bool at_v1 : {false, true}) {
    for (const bool transposed : {false, true}) {
      PatchPoints patch;
      for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) {
          const double angle = 2 * static_cast<double>(i);
          const bool inner = i == 1 || i == 2;
          const double r = j == 0 ? (inner ? 0.001 : 0) : static_cast<double>(j);
          const std::size_t row = at_v1 ? 3 - j : j;
          patch[transposed ? i : row][transposed ? row : i] = {
              r * std::cos(angle) + 0.0, r * std::sin(angle) + 0.0, 0.1 * static_cast<double>(j)};
        }
      }
      const std::vector<double> values = MeshModel{"lid", {patch}}.values();
      MeshOptions options;
      options.rates.tolerance = 100;
      const auto nets = ControlNets<double>::packed(std::span<const double>(values));
      expect_sound(tessellate<float>(nets, options), true);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::tessellate_test
