// tessellate() on models and on real data: closed where they are, oriented, without triangles that
// have no area, and as close to the surface as certified, by dense samples.
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/mesh_models.hpp"
#include "tests/mesh/mesh_oracle.hpp"
#include "tests/mesh/triangle_census.hpp"
#include "tests/support/nets/data_files.hpp"

namespace simdbezier::tests {
namespace {

struct Model {
  std::string name;
  std::vector<PatchPoints> patches;

  [[nodiscard]] std::vector<double> values() const { return MeshModel{name, patches}.values(); }
};

std::vector<PatchPoints> patches_of(const std::vector<Net>& nets) {
  std::vector<PatchPoints> patches;
  for (const Net& net : nets) {
    PatchPoints& patch = patches.emplace_back();
    for (std::size_t k = 0; k < 16; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        patch[k / 4][k % 4][c] = static_cast<double>(net.points[k][c]);
      }
    }
  }
  return patches;
}

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
Point corner(const Mesh<T>& mesh, std::size_t triangle, std::size_t k) {
  const auto& p = mesh.positions[mesh.triangles[triangle][k]];
  return {p[0], p[1], p[2]};
}

template <typename T>
std::span<const std::uint32_t> numbers_of(const Mesh<T>& mesh) {
  return {mesh.triangles.empty() ? nullptr : mesh.triangles.front().data(),
          3 * mesh.triangles.size()};
}

/// What is true of every mesh.
template <typename T>
void expect_sound(const Mesh<T>& mesh, bool normals) {
  ASSERT_EQ(mesh.status, Status::ok) << "patch " << mesh.fault_patch;
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

/// The largest distance of dense samples of a patch from its triangles.
template <typename T>
double found_deviation(const MeshPlan<T>& plan, const Mesh<T>& mesh, const PatchPoints& patch,
                       std::size_t p, std::uint32_t in_cell) {
  std::vector<std::array<Point, 3>> triangles;
  for (std::size_t t = plan.layout.first_triangle(p); t < plan.layout.first_triangle(p + 1); ++t) {
    triangles.push_back({corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)});
  }
  double worst = 0;
  const std::uint32_t nu = in_cell * plan.nu[p];
  const std::uint32_t nv = in_cell * plan.nv[p];
  for (std::uint32_t k = 0; k < (nu + 1) * (nv + 1); ++k) {
    const Point x = surface(patch, static_cast<double>(k % (nu + 1)) / nu,
                            static_cast<double>(k / (nu + 1)) / nv);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& triangle : triangles) {
      least = std::min(least, squared_distance(x, triangle));
      if (least <= worst) {
        break;
      }
    }
    worst = std::max(worst, least);
  }
  return std::sqrt(worst);
}

template <typename T>
class TessellateModels : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TessellateModels, Scalars);

TYPED_TEST(TessellateModels, are_closed_and_as_close_as_certified) {
  using T = TypeParam;
  for (const MeshModel& model : mesh_models()) {
    for (const double tolerance : {0.5, 0.05, 0.005}) {
      SCOPED_TRACE(model.name + ", tolerance " + std::to_string(tolerance));
      const std::vector<double> values = model.values();
      const auto nets = ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3);
      MeshOptions options;
      options.tolerance = tolerance;
      options.orient = model.orientable;
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
        if (plan.nu[p] * plan.nv[p] < 150) {
          EXPECT_LE(found_deviation(plan, mesh, model.patches[given], p, 3), plan.deviations[p]);
        }
      }
    }
  }
}

TEST(Tessellate, of_ten_thousand_random_patches_is_one_sheet) {
  const Model model = random_sheet(100, 100, 1);
  const std::vector<double> values = model.values();
  const auto nets = ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3);
  MeshOptions options;
  options.tolerance = 0.05;
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
    options.tolerance = tolerance;
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
      options.tolerance = 100;
      const auto nets = ControlNets<double>::packed(std::span<const double>(values));
      expect_sound(tessellate<float>(nets, options), true);
    }
  }
}

std::vector<double> sheet_values() {
  for (const MeshModel& model : mesh_models()) {
    if (model.name == "sheet") {
      return model.values();
    }
  }
  return {};
}

TEST(Tessellate, options_are_followed) {
  const std::vector<double> values = sheet_values();
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  const auto mesh_of = [&](const auto& change) {
    MeshOptions options;
    options.tolerance = 0.01;
    change(options);
    const Mesh<float> mesh = tessellate<float>(nets, options);
    EXPECT_EQ(mesh.status, Status::ok);
    return mesh;
  };
  const Mesh<float> usual = mesh_of([](auto&) {});
  const Mesh<float> flipped = mesh_of([](auto& o) { o.flip = true; });
  ASSERT_EQ(usual.triangles.size(), flipped.triangles.size());
  for (std::size_t t = 0; t < usual.triangles.size(); ++t) {
    EXPECT_EQ(usual.triangles[t][1], flipped.triangles[t][2]);
  }
  for (std::size_t k = 0; k < usual.normals.size(); ++k) {
    EXPECT_EQ(usual.normals[k][2], -flipped.normals[k][2]);
  }
  const Mesh<float> small = mesh_of([](auto& o) { o.short_indices = true; });
  EXPECT_TRUE(small.triangles.empty());
  ASSERT_EQ(small.short_triangles.size(), usual.triangles.size());
  for (std::size_t t = 0; t < usual.triangles.size(); ++t) {
    EXPECT_EQ(usual.triangles[t][0], small.short_triangles[t][0]);
  }
  EXPECT_TRUE(mesh_of([](auto& o) { o.normals = false; }).normals.empty());
  EXPECT_EQ(mesh_of([](auto& o) { o.parameters = true; }).patches.size(), usual.positions.size());
  const Mesh<float> uniform = mesh_of([](auto& o) {
    o = {};
    o.nu = 5;
    o.nv = 4;
  });
  EXPECT_EQ(uniform.triangles.size(), 6U * 4U * 3U * 2U);
  EXPECT_EQ(uniform.positions.size(), 13U * 7U);
  EXPECT_GT(uniform.deviation, 0);
  const std::vector<double> tolerances(6, 0.002);
  const Mesh<float> finer = mesh_of([&](auto& o) { o.tolerances = tolerances; });
  EXPECT_LE(finer.deviation, 0.002);
  EXPECT_LE(mesh_of([](auto& o) { o.relative_tolerance = 1e-4; }).deviation, 1e-4 * 12.4);
  const auto split = mesh_of([](auto& o) { o.crease_angle = 0; });
  EXPECT_GT(split.positions.size(), usual.positions.size());
  EXPECT_EQ(split.triangles.size(), usual.triangles.size());
}

/// Of a square that is turned about its middle: the longest edge, and the largest angle between
/// neighbouring vertices' normals along rows and columns of vertices.
TEST(Tessellate, edges_and_angles_are_as_short_as_asked_for) {
  for (const MeshModel& model : mesh_models()) {
    if (!model.name.starts_with("torus 4") && model.name != "sheet") {
      continue;
    }
    const std::vector<double> values = model.values();
    const auto nets = ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3);
    for (const double most : {0.7, 0.2}) {
      SCOPED_TRACE(model.name);
      MeshOptions options;
      options.longest_edge = most;
      const MeshPlan<double> by_length = plan_mesh<double>(nets, options);
      ASSERT_EQ(by_length.status, Status::ok);
      options = {};
      options.normal_angle = most;
      const MeshPlan<double> by_angle = plan_mesh<double>(nets, options);
      ASSERT_EQ(by_angle.status, Status::ok);
      double longest = 0;
      double widest = 0;
      const auto angle = [](const Point& a, const Point& b) {
        return std::atan2(length(cross(a, b)), dot(a, b));
      };
      for (std::size_t p = 0; p < model.patches.size(); ++p) {
        const PatchPoints& patch = model.patches[p];
        for (std::uint32_t i = 0; i < by_length.nu[p]; ++i) {
          const double n = by_length.nu[p];
          longest = std::max(longest,
                             length(surface(patch, (i + 1) / n, 0.3) - surface(patch, i / n, 0.3)));
        }
        for (std::uint32_t j = 0; j < by_angle.nv[p]; ++j) {
          const double n = by_angle.nv[p];
          widest = std::max(widest, angle(surface_normal(patch, 0.6, (j + 1) / n),
                                          surface_normal(patch, 0.6, j / n)));
        }
      }
      EXPECT_LE(longest, most);
      EXPECT_GT(longest, most / 4);
      EXPECT_LE(widest, 1.5 * most);
      EXPECT_GT(widest, most / 4);
    }
  }
}

/// No point of the surface is seen farther from its place on the mesh than asked for.
TEST(Tessellate, pixels_are_those_of_the_camera) {
  const MeshModel model = [] {
    for (MeshModel& candidate : mesh_models()) {
      if (candidate.name == "torus 4 x 3") {
        return candidate;
      }
    }
    return MeshModel{};
  }();
  const std::vector<double> values = model.values();
  const auto nets = ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3);
  for (const double pixels : {8.0, 1.0}) {
    MeshOptions options;
    options.pixels = pixels;
    options.camera.eye = {9, 0, 3};
    options.camera.direction = {-3, 0, -1};
    options.camera.focal_length = 800;
    options.camera.width = 1000;
    options.camera.height = 1000;
    const MeshPlan<double> plan = plan_mesh<double>(nets, options);
    ASSERT_EQ(plan.status, Status::ok);
    double worst = 0;
    for (std::size_t p = 0; p < model.patches.size(); ++p) {
      double depth = std::numeric_limits<double>::infinity();
      for (const auto& row : model.patches[p]) {
        for (const Point& x : row) {
          depth = std::min(depth, dot(x - Point{9, 0, 3}, Point{-3, 0, -1}) / std::sqrt(10.0));
        }
      }
      EXPECT_LE(plan.deviations[p] * 800 / depth, pixels) << "on the axis";
      worst = std::max(worst, plan.deviations[p] * 800 / depth);
    }
    EXPECT_GT(worst, pixels / 4);
  }
}

struct Refused {
  const char* what;
  Status status;
  void (*change)(MeshOptions&);
};
const double kNan = std::numeric_limits<double>::quiet_NaN();
const Refused kRefused[] = {
    {"nothing asked", Status::bad_tolerance, [](MeshOptions& o) { o = {}; }},
    {"tolerance 0", Status::bad_tolerance, [](MeshOptions& o) { o.tolerance = 0; }},
    {"tolerance nan", Status::bad_tolerance, [](MeshOptions& o) { o.tolerance = kNan; }},
    {"relative -1", Status::bad_tolerance, [](MeshOptions& o) { o.relative_tolerance = -1; }},
    {"too small", Status::bad_tolerance, [](MeshOptions& o) { o.tolerance = 1e-9; }},
    {"pixels 0", Status::bad_tolerance, [](MeshOptions& o) { o.pixels = 0; }},
    {"camera", Status::bad_tolerance,
     [](MeshOptions& o) {
       o.pixels = 1;
       o.camera.direction = {0, 0, 0};
     }},
    {"edge 0", Status::bad_tolerance, [](MeshOptions& o) { o.longest_edge = 0; }},
    {"angle nan", Status::bad_tolerance, [](MeshOptions& o) { o.normal_angle = kNan; }},
    {"crease nan", Status::bad_tolerance, [](MeshOptions& o) { o.crease_angle = kNan; }},
    {"crease -1", Status::bad_tolerance, [](MeshOptions& o) { o.crease_angle = -1; }},
    {"snap -1", Status::bad_tolerance, [](MeshOptions& o) { o.snap = -1; }},
    {"points nan", Status::bad_tolerance, [](MeshOptions& o) { o.point_size = kNan; }},
    {"both", Status::bad_grid, [](MeshOptions& o) { o.nu = o.nv = 4; }},
    {"grid of 1", Status::bad_grid,
     [](MeshOptions& o) {
       o = {};
       o.nu = 1;
       o.nv = 4;
     }},
    {"grid of 0", Status::bad_grid,
     [](MeshOptions& o) {
       o = {};
       o.nv = 4;
     }},
    {"grid too large", Status::bad_rates,
     [](MeshOptions& o) {
       o = {};
       o.nu = o.nv = kMostSegments + 2;
     }},
};

TEST(Tessellate, refuses_bad_options) {
  const std::vector<double> values = sheet_values();
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  for (const Refused& refused : kRefused) {
    MeshOptions options;
    options.tolerance = 0.01;
    refused.change(options);
    const Mesh<float> mesh = tessellate<float>(nets, options);
    EXPECT_EQ(to_string(mesh.status), to_string(refused.status)) << refused.what;
    EXPECT_TRUE(mesh.positions.empty() && mesh.triangles.empty());
  }
}

TEST(Tessellate, refuses_bad_nets) {
  std::vector<double> values = sheet_values();
  MeshOptions options;
  options.tolerance = 0.01;
  const auto mesh_of = [&](const ControlNets<double>& nets) {
    return tessellate<float>(nets, options);
  };
  values[3 * 48 + 5] = kNan;
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  const Mesh<float> mesh = mesh_of(nets);
  EXPECT_EQ(mesh.status, Status::non_finite_input);
  EXPECT_EQ(mesh.fault_patch, 3U);
  auto flat = nets;
  flat.components = 2;
  EXPECT_EQ(mesh_of(flat).status, Status::bad_components);
  EXPECT_EQ(mesh_of(ControlNets<double>{nullptr, 2}).status, Status::null_input);
  auto degree = nets;
  degree.degree_u = 16;
  EXPECT_EQ(mesh_of(degree).status, Status::bad_degree);
  const Mesh<float> none = mesh_of(ControlNets<double>{});
  EXPECT_EQ(none.status, Status::ok);
  EXPECT_TRUE(none.triangles.empty());
  for (const MeshModel& model : mesh_models()) {
    if (!model.orientable) {
      const std::vector<double> ring = model.values();
      options.orient = true;
      EXPECT_EQ(mesh_of(ControlNets<double>::packed(std::span<const double>(ring))).status,
                Status::not_orientable);
    }
  }
}

} // namespace
} // namespace simdbezier::tests
