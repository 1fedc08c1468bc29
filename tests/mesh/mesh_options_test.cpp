// What tessellate() is asked for besides a tolerance, and what it refuses.
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <gtest/gtest.h>

#include <simdbezier/mesh.hpp>

#include "tests/mesh/support/mesh_models.hpp"
#include "tests/mesh/support/mesh_oracle.hpp"
#include "tests/support/isas.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests::mesh_options_test {
namespace {

std::vector<double> sheet_values() {
  for (const MeshModel& model : mesh_models()) {
    if (model.name == "sheet") {
      return model.values();
    }
  }
  return {};
}

TEST(MeshOptions, options_are_followed) {
  const std::vector<double> values = sheet_values();
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  const auto mesh_of = [&](const auto& change) {
    MeshOptions options;
    options.rates.tolerance = 0.01;
    change(options);
    const Mesh<float> mesh = tessellate<float>(nets, options);
    EXPECT_EQ(mesh.report.status, Status::ok);
    return mesh;
  };
  const Mesh<float> usual = mesh_of([](auto&) {});
  const Mesh<float> flipped = mesh_of([](auto& o) { o.topology.flip = true; });
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
  const Mesh<float> apart = mesh_of([](auto& o) { o.parameters = true; });
  EXPECT_EQ(apart.patches.size(), apart.positions.size());
  EXPECT_EQ(apart.triangles.size(), usual.triangles.size());
  const Mesh<float> uniform = mesh_of([](auto& o) {
    o = {};
    o.nu = 5;
    o.nv = 4;
  });
  EXPECT_EQ(uniform.triangles.size(), 6U * 4U * 3U * 2U);
  EXPECT_EQ(uniform.positions.size(), 13U * 7U);
  EXPECT_GT(uniform.deviation, 0);
  const std::vector<double> tolerances(6, 0.002);
  const Mesh<float> finer = mesh_of([&](auto& o) { o.rates.tolerances = tolerances; });
  EXPECT_LE(finer.deviation, 0.002);
  EXPECT_LE(mesh_of([](auto& o) { o.relative_tolerance = 1e-4; }).deviation, 1e-4 * 12.4);
  const auto split = mesh_of([](auto& o) { o.crease_degrees = 0; });
  EXPECT_GT(split.positions.size(), usual.positions.size());
  EXPECT_EQ(split.triangles.size(), usual.triangles.size());
  const std::vector<double> errors(6, 0.004); // of the control points
  const Mesh<float> wide = mesh_of([&](auto& o) { o.rates.errors = errors; });
  EXPECT_GE(*std::ranges::min_element(wide.deviations), 0.004);
  EXPECT_LE(wide.deviation, 0.01);
  EXPECT_EQ(wide.positions.size() > usual.positions.size(), true) << "less is left for cells";
}

/// Along rows no edge is longer than asked for, and along columns neighbouring normals enclose no
/// angle much larger than asked for.
TEST(MeshOptions, edges_and_angles_are_as_short_as_asked_for) {
  for (const MeshModel& model : mesh_models()) {
    if (!model.name.starts_with("torus 4") && model.name != "sheet") {
      continue;
    }
    const std::vector<double> values = model.values();
    const auto nets = ControlNets<double>::packed(values.data(), model.patches.size(), 3, 3);
    for (const double most : {0.7, 0.2}) {
      SCOPED_TRACE(model.name);
      MeshOptions options;
      options.rates.longest_edge = most;
      const MeshPlan<double> by_length = plan_mesh<double>(nets, options);
      ASSERT_EQ(by_length.report.status, Status::ok);
      options = {};
      options.rates.normal_degrees = most * 180 / std::numbers::pi;
      const MeshPlan<double> by_angle = plan_mesh<double>(nets, options);
      ASSERT_EQ(by_angle.report.status, Status::ok);
      double longest = 0;
      double widest = 0;
      const auto angle = [](const Point& a, const Point& b) {
        return std::atan2(length(cross(a, b)), dot(a, b));
      };
      for (std::size_t p = 0; p < model.patches.size(); ++p) {
        const PatchPoints& patch = model.patches[p];
        for (std::uint32_t i = 0; i < by_length.cells_u[p]; ++i) {
          const double n = by_length.cells_u[p];
          longest = std::max(longest,
                             length(surface(patch, (i + 1) / n, 0.3) - surface(patch, i / n, 0.3)));
        }
        for (std::uint32_t j = 0; j < by_angle.cells_v[p]; ++j) {
          const double n = by_angle.cells_v[p];
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
TEST(MeshOptions, pixels_are_those_of_the_camera) {
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
    ASSERT_EQ(plan.report.status, Status::ok);
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

/// Vertices that are computed without fused operations are certified as such.
TEST(MeshOptions, deviations_are_those_of_the_instruction_set) {
  std::vector<double> values = sheet_values();
  for (double& value : values) {
    value += 1000; // rounding is most of what single precision deviates by
  }
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  for (const Isa isa : available_isas()) {
    MeshOptions options;
    options.nu = options.nv = 33;
    options.isa = isa;
    const MeshPlan<float> plan = plan_mesh<float>(nets, options);
    ASSERT_EQ(plan.report.status, Status::ok);
    std::vector<double> rounding(plan.set.size());
    ASSERT_TRUE(position_errors(plan.set, rounding, {.isa = isa}));
    for (std::size_t p = 0; p < rounding.size(); ++p) {
      EXPECT_GE(plan.deviations[p], rounding[p]) << to_string(isa);
      EXPECT_LE(plan.deviations[p], rounding[p] + 0.01) << to_string(isa);
    }
    options.isa = Isa::scalar;
    if (is_available(options.isa)) {
      const MeshPlan<float> unfused = plan_mesh<float>(nets, options);
      EXPECT_EQ(plan.deviation < unfused.deviation, fuses_multiply_add(isa)) << to_string(isa);
    }
  }
  std::vector<double> rounding(nets.count);
  EXPECT_EQ(position_errors(plan_mesh<float>(nets, {.nu = 2, .nv = 2}).set, rounding,
                            {.isa = static_cast<Isa>(99)}),
            Status::unsupported_isa);
}

/// Errors are found for several patches at once, unless a set has few of one shape.
TEST(MeshOptions, errors_are_the_same_together_and_alone) {
  Random random(3);
  for (const auto& [degree_u, degree_v] : {std::pair(1, 1), {1, 2}, {3, 3}, {4, 3}, {5, 5}}) {
    for (const double size : {1.0, 2e34}) { // the larger ones are near the range of float
      const auto values = static_cast<std::size_t>(3 * (degree_u + 1) * (degree_v + 1));
      std::vector<double> points(19 * values);
      for (double& value : points) {
        value = random.between(-size, size);
      }
      const auto nets = ControlNets<double>::packed(points.data(), 19, degree_u, degree_v);
      const auto bilinear = ControlNets<double>::packed(points.data(), 2, 1, 1);
      auto tail = nets;
      tail.points += 9 * nets.patch_stride;
      tail.count = 10;
      auto head = nets;
      head.count = 9;
      PatchSet<float> set;
      const std::array views = {head, bilinear, tail};
      ASSERT_TRUE(pack(std::span<const ControlNets<double>>(views), set));
      for (const Isa isa : available_isas()) {
        std::vector<double> together(set.size());
        ASSERT_TRUE(position_errors(set, together, {.isa = isa}));
        together.erase(together.begin() + 9, together.begin() + 11);
        for (std::size_t p = 0; p < nets.count; ++p) {
          auto single = nets;
          single.points += static_cast<std::ptrdiff_t>(p) * nets.patch_stride;
          single.count = 1;
          PatchSet<float> alone;
          ASSERT_TRUE(pack(single, alone));
          double error = 0;
          ASSERT_TRUE(position_errors(alone, std::span(&error, 1), {.isa = isa}));
          EXPECT_EQ(together[p], error) << to_string(isa) << ' ' << degree_u << ' ' << p;
        }
      }
    }
  }
}

const double kNan = std::numeric_limits<double>::quiet_NaN();

/// Only the camera's direction counts, whatever its length, and any finite eye is one.
TEST(MeshOptions, cameras_look_along_directions_of_any_length) {
  const std::vector<double> values = mesh_models()[0].values();
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  const auto tolerances_of = [&](double scale, double eye, Status expected) {
    Camera camera;
    camera.eye = {eye, eye, 3};
    camera.direction = {-3 * scale, -2 * scale, -scale};
    camera.focal_length = 800;
    camera.width = camera.height = 1000;
    std::vector<double> tolerances(nets.count, -1);
    EXPECT_EQ(to_string(pixel_tolerances(std::span(&nets, 1), camera, 1, std::span(tolerances))),
              to_string(expected));
    return tolerances;
  };
  const std::vector<double> usual = tolerances_of(1, 9, Status::ok);
  EXPECT_GT(usual[0], 0);
  for (const double scale : {0x1p-1000, 0x1p-560, 0x1p-3, 0x1p600, 0x1p1000}) {
    EXPECT_EQ(tolerances_of(scale, 9, Status::ok), usual) << scale;
  }
  static_cast<void>(tolerances_of(1, 1e308, Status::ok));
  static_cast<void>(tolerances_of(1, kNan, Status::bad_tolerance));
  static_cast<void>(tolerances_of(kNan, 9, Status::bad_tolerance));
  static_cast<void>(tolerances_of(0, 9, Status::bad_tolerance));
}

struct Refused {
  const char* what;
  Status status;
  void (*change)(MeshOptions&);
};
const Refused kRefused[] = {
    {"nothing asked", Status::bad_tolerance, [](MeshOptions& o) { o = {}; }},
    {"tolerance 0", Status::bad_tolerance, [](MeshOptions& o) { o.rates.tolerance = 0; }},
    {"tolerance nan", Status::bad_tolerance, [](MeshOptions& o) { o.rates.tolerance = kNan; }},
    {"relative -1", Status::bad_tolerance, [](MeshOptions& o) { o.relative_tolerance = -1; }},
    {"too small", Status::bad_tolerance, [](MeshOptions& o) { o.rates.tolerance = 1e-9; }},
    {"pixels 0", Status::bad_tolerance, [](MeshOptions& o) { o.pixels = 0; }},
    {"camera", Status::bad_tolerance,
     [](MeshOptions& o) {
       o.pixels = 1;
       o.camera.direction = {0, 0, 0};
     }},
    {"edge 0", Status::bad_tolerance, [](MeshOptions& o) { o.rates.longest_edge = 0; }},
    {"angle nan", Status::bad_tolerance, [](MeshOptions& o) { o.rates.normal_degrees = kNan; }},
    {"crease nan", Status::bad_tolerance, [](MeshOptions& o) { o.crease_degrees = kNan; }},
    {"crease -1", Status::bad_tolerance, [](MeshOptions& o) { o.crease_degrees = -1; }},
    {"snap -1", Status::bad_tolerance, [](MeshOptions& o) { o.topology.snap = -1; }},
    {"points nan", Status::bad_tolerance, [](MeshOptions& o) { o.topology.point_size = kNan; }},
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
    {"one error", Status::bad_rates,
     [](MeshOptions& o) {
       static constexpr double kOne[] = {0};
       o.rates.errors = kOne;
     }},
    {"error below 0", Status::bad_tolerance,
     [](MeshOptions& o) {
       static constexpr double kSix[] = {0, 0, 0, 0, -1e-20, 0};
       o.rates.errors = kSix;
     }},
    {"one tolerance", Status::bad_rates,
     [](MeshOptions& o) {
       static constexpr double kOne[] = {1};
       o.rates.tolerances = kOne;
     }},
    {"grid too large", Status::bad_rates,
     [](MeshOptions& o) {
       o = {};
       o.nu = o.nv = kMostSegments + 2;
     }},
};

TEST(MeshOptions, refuses_bad_options) {
  const std::vector<double> values = sheet_values();
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  for (const Refused& refused : kRefused) {
    MeshOptions options;
    options.rates.tolerance = 0.01;
    refused.change(options);
    const Mesh<float> mesh = tessellate<float>(nets, options);
    EXPECT_EQ(to_string(mesh.report.status), to_string(refused.status)) << refused.what;
    EXPECT_TRUE(mesh.positions.empty() && mesh.triangles.empty());
  }
}

TEST(MeshOptions, refuses_bad_nets) {
  std::vector<double> values = sheet_values();
  MeshOptions options;
  options.rates.tolerance = 0.01;
  const auto mesh_of = [&](const ControlNets<double>& nets) {
    return tessellate<float>(nets, options);
  };
  values[3 * 48 + 5] = kNan;
  const auto nets = ControlNets<double>::packed(std::span<const double>(values));
  const Mesh<float> mesh = mesh_of(nets);
  EXPECT_EQ(mesh.report.status, Status::non_finite_input);
  EXPECT_EQ(mesh.report.item, 3U);
  EXPECT_EQ(mesh.report.point, 1);
  EXPECT_EQ(mesh.report.component, 2);
  auto flat = nets;
  flat.components = 2;
  EXPECT_EQ(mesh_of(flat).report.status, Status::bad_components);
  EXPECT_EQ(mesh_of(ControlNets<double>{nullptr, 2}).report.status, Status::null_input);
  auto degree = nets;
  degree.degree_u = 16;
  EXPECT_EQ(mesh_of(degree).report.status, Status::bad_degree);
  const Mesh<float> none = mesh_of(ControlNets<double>{});
  EXPECT_EQ(none.report.status, Status::ok);
  EXPECT_TRUE(none.triangles.empty());
  for (const MeshModel& model : mesh_models()) {
    if (!model.orientable) {
      const std::vector<double> ring = model.values();
      options.topology.orient = true;
      EXPECT_EQ(mesh_of(ControlNets<double>::packed(std::span<const double>(ring))).report.status,
                Status::not_orientable);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::mesh_options_test
