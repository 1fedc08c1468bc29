// What cameras do not see: patches beside the picture and those that face away.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/evaluate.hpp>
#include <simdbezier/mesh.hpp>
#include <simdbezier/rates.hpp>
#include <simdbezier/splines.hpp>

#include "tests/support/random.hpp"

namespace simdbezier::tests::view_test {
namespace {

using Point = std::array<double, 3>;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A torus of 24 x 16 bicubic patches whose normals point outwards, and 9 x 9 points of each with
/// their normals.
struct Torus {
  static constexpr std::size_t kColumns = 24;
  static constexpr std::size_t kRows = 16;
  static constexpr std::size_t kSamples = 81;

  std::vector<double> values = std::vector<double>(kColumns * kRows * 48);
  std::vector<Point> positions;
  std::vector<Point> normals;

  Torus() {
    std::vector<double> mesh;
    for (std::size_t k = 0; k < kColumns * kRows; ++k) {
      const double u = 2 * std::numbers::pi * static_cast<double>(k % kColumns) / kColumns;
      const double v = 2 * std::numbers::pi * static_cast<double>(k / kColumns) / kRows;
      const double r = 3 + std::cos(v);
      mesh.insert(mesh.end(), {r * std::cos(u), r * std::sin(u), std::sin(v)});
    }
    SplineSurface<double> surface;
    surface.points = mesh.data();
    surface.rows = kRows;
    surface.columns = kColumns;
    surface.row_stride = 3 * kColumns;
    surface.periodic_u = surface.periodic_v = true;
    EXPECT_TRUE(to_bezier(surface, MutableNets<double>::packed(values.data(), patches(), 3, 3)));
    PatchSet<double> set;
    EXPECT_TRUE(pack(nets(), set));
    positions.resize(patches() * kSamples);
    normals.resize(patches() * kSamples);
    Outputs<double> out;
    out.position = Vectors<double>::xyz(std::span(positions));
    out.normal = Vectors<double>::xyz(std::span(normals));
    EXPECT_TRUE(evaluate(set, Grid<double>::uniform(9, 9), out));
  }
  [[nodiscard]] static std::size_t patches() { return kColumns * kRows; }
  [[nodiscard]] ControlNets<double> nets() const {
    return ControlNets<double>::packed(values.data(), patches(), 3, 3);
  }
  [[nodiscard]] std::vector<double> tolerances(const Camera& camera) const {
    std::vector<double> tolerances(patches());
    EXPECT_TRUE(pixel_tolerances(nets(), camera, 1, std::span(tolerances)));
    return tolerances;
  }
};

Camera random_camera(Random& random) {
  Camera camera;
  for (std::size_t c = 0; c < 3; ++c) {
    camera.eye[c] = random.between(-7, 7);
    camera.direction[c] = random.between(-3, 3) - camera.eye[c];
  }
  camera.focal_length = random.between(300, 3000);
  camera.orthographic = random.below(2) == 0;
  camera.focal_length *= camera.orthographic ? 0.2 : 1;
  return camera;
}

/// Whether a point is in the circle around the picture, and where it is no nearer than allowed.
bool is_in_picture(const Camera& camera, const Point& point) {
  const Point from = minus(point, camera.eye);
  const double size = std::sqrt(dot(camera.direction, camera.direction));
  const double depth = dot(from, camera.direction) / size;
  const Point across = cross(from, camera.direction);
  const double off = std::sqrt(dot(across, across)) / size;
  const double radius = std::hypot(camera.width, camera.height) / 2 / camera.focal_length;
  return depth >= camera.nearest && off <= radius * (camera.orthographic ? 1 : depth);
}
bool faces_away(const Camera& camera, const Point& point, const Point& normal) {
  return dot(normal, camera.orthographic ? camera.direction : minus(point, camera.eye)) > 0;
}

template <typename Is>
bool all_samples(std::size_t patch, const Is& is) {
  for (std::size_t k = patch * Torus::kSamples; k < (patch + 1) * Torus::kSamples; ++k) {
    if (!is(k)) {
      return false;
    }
  }
  return true;
}

// The oracle is what dense samples say. Where all of a patch is unseen, most patches are skipped.
TEST(View, skips_what_is_beside_the_picture_or_faces_away) {
  const Torus torus;
  Random random(5);
  std::size_t unseen[2] = {};
  std::size_t skipped[2] = {};
  for (int round = 0; round < 200; ++round) {
    Camera camera = random_camera(random);
    const std::vector<double> all = torus.tolerances(camera);
    for (std::size_t kind = 0; kind < 2; ++kind) {
      Camera some = camera;
      (kind == 0 ? some.skip_outside : some.skip_back) = true;
      const std::vector<double> tolerances = torus.tolerances(some);
      for (std::size_t p = 0; p < Torus::patches(); ++p) {
        const bool is_unseen = all_samples(p, [&](std::size_t k) {
          return kind == 0 ? !is_in_picture(camera, torus.positions[k])
                           : faces_away(camera, torus.positions[k], torus.normals[k]);
        });
        const bool skips = tolerances[p] != all[p];
        EXPECT_TRUE(is_unseen || !skips) << "round " << round << ", kind " << kind << ", " << p;
        EXPECT_TRUE(!skips || tolerances[p] == kUnlimited);
        unseen[kind] += is_unseen ? 1 : 0;
        skipped[kind] += skips ? 1 : 0;
      }
    }
  }
  EXPECT_GT(skipped[0], unseen[0] * 7 / 10);
  EXPECT_GT(skipped[1], unseen[1] * 7 / 10);
}

TEST(View, has_pixels_of_one_size_where_it_is_parallel) {
  const Torus torus;
  Camera camera;
  camera.eye = {0, 0, 9};
  camera.focal_length = 400;
  camera.orthographic = true;
  for (const double tolerance : torus.tolerances(camera)) {
    EXPECT_EQ(tolerance, 1.0 / 400);
  }
  camera.direction = {0, 0, 1}; // the torus lies behind the eye
  for (const double tolerance : torus.tolerances(camera)) {
    EXPECT_EQ(tolerance, kUnlimited);
  }
}

/// The test of what faces away is one of polynomial patches.
TEST(View, keeps_rational_patches_that_face_away) {
  const Torus torus;
  std::vector<double> weighted;
  for (std::size_t k = 0; k < torus.values.size(); k += 3) {
    weighted.insert(weighted.end(), {torus.values[k], torus.values[k + 1], torus.values[k + 2], 1});
  }
  Camera camera;
  camera.eye = {0, 0, 9};
  camera.skip_back = true;
  const auto nets =
      ControlNets<double>::packed(weighted.data(), Torus::patches(), 3, 3, 3, Weights::cartesian);
  std::vector<double> tolerances(Torus::patches());
  ASSERT_TRUE(pixel_tolerances(nets, camera, 1, std::span(tolerances)));
  EXPECT_LT(*std::ranges::max_element(tolerances), 0.1);
  EXPECT_EQ(std::ranges::max(torus.tolerances(camera)), kUnlimited);
}

/// What faces away has fewer cells: nothing is asked of it.
void expect_fewer_cells_of_the_back(const MeshPlan<double>& all, const MeshPlan<double>& seen,
                                    const Camera& camera, const Torus& torus, double sign) {
  ASSERT_TRUE(all && seen);
  std::size_t skipped = 0;
  for (std::size_t p = 0; p < Torus::patches(); ++p) {
    const bool away = all_samples(p, [&](std::size_t k) {
      const Point& normal = torus.normals[k];
      return faces_away(camera, torus.positions[k],
                        {sign * normal[0], sign * normal[1], sign * normal[2]});
    });
    const bool fewer = seen.cells_u[p] * seen.cells_v[p] < all.cells_u[p] * all.cells_v[p];
    EXPECT_TRUE(away || (seen.cells_u[p] == all.cells_u[p] && seen.cells_v[p] == all.cells_v[p]))
        << p;
    skipped += fewer ? 1 : 0;
  }
  EXPECT_GT(skipped, Torus::patches() / 5);
}

// A plan judges by the normals that the mesh has: those of a flipped torus point inwards, so that
// its near side faces away, and the inside of its far side is seen.
TEST(View, goes_by_the_normals_of_the_mesh) {
  const Torus torus;
  for (const bool flip : {false, true}) {
    SCOPED_TRACE(flip);
    MeshOptions options;
    options.pixels = 0.2;
    options.camera.eye = {0, 0, 9};
    options.topology.flip = flip;
    const MeshPlan<double> all = plan_mesh<double>(torus.nets(), options);
    options.camera.skip_back = true;
    MeshPlan<double> seen = plan_mesh<double>(torus.nets(), options);
    const double sign = flip ? -1 : 1;
    expect_fewer_cells_of_the_back(all, seen, options.camera, torus, sign);
    options.topology.flip = false; // the plan has its topology
    EXPECT_TRUE(plan_again(torus.nets(), options, seen));
    expect_fewer_cells_of_the_back(all, seen, options.camera, torus, sign);
  }
}

// As small and as far from the origin as the second patch is, no mesh keeps a tolerance of its
// size, which is not asked for: it is behind the camera.
TEST(View, asks_nothing_of_patches_behind_the_camera) {
  std::vector<float> values;
  for (const double z : {-1000.0, 50.0}) {
    for (std::size_t k = 0; k < 16; ++k) {
      const double size = z < 0 ? 100.0 / 3 : 0.1 / 3;
      const auto i = static_cast<double>(k % 4);
      const auto j = static_cast<double>(k / 4);
      for (const double x : {size * i, size * j, z + size * i * j / 10}) {
        values.push_back(static_cast<float>(1e6 + x));
      }
    }
  }
  MeshOptions options;
  options.pixels = 1;
  options.camera.eye = {1e6, 1e6, 1e6};
  for (const bool thorough : {false, true}) {
    options.rates.thorough = thorough;
    const auto plan = plan_mesh<float>(ControlNets<float>::packed(values.data(), 2, 3, 3), options);
    ASSERT_EQ(plan.report.status, Status::ok);
    EXPECT_LE(plan.deviations[0], 2.0);
    EXPECT_EQ(plan.cells_u[1] * plan.cells_v[1], 1U);
  }
}

/// Nets are measured several at once, unless they are few or not side by side, and by several
/// threads where they are many.
template <typename T>
void expect_tolerances_of_single_nets() {
  constexpr std::size_t kNets = 10'007;
  Random random(11);
  std::vector<T> values(kNets * 50);
  for (T& value : values) {
    value = static_cast<T>(random.between(-9, 9));
  }
  const Camera camera = random_camera(random);
  for (const std::ptrdiff_t stride : {48, 50}) {
    auto nets = ControlNets<T>::packed(values.data(), kNets, 3, 3);
    nets.patch_stride = stride;
    std::vector<double> together(nets.count);
    ASSERT_TRUE(pixel_tolerances(nets, camera, 1, std::span(together)));
    for (const Isa isa : available_isas()) {
      for (const int threads : {1, 3}) {
        std::vector<double> again(nets.count);
        ASSERT_TRUE(pixel_tolerances(nets, camera, 1, std::span(again), {threads, isa}));
        EXPECT_TRUE(again == together) << to_string(isa) << threads;
      }
    }
    for (std::size_t p = 0; p < nets.count; ++p) {
      auto single = nets;
      single.points += static_cast<std::ptrdiff_t>(p) * stride;
      single.count = 1;
      double alone = 0;
      ASSERT_TRUE(pixel_tolerances(single, camera, 1, std::span(&alone, 1)));
      EXPECT_EQ(together[p], alone) << p;
    }
  }
}
TEST(View, gives_nets_the_same_tolerance_together_and_alone) {
  expect_tolerances_of_single_nets<float>();
  expect_tolerances_of_single_nets<double>();
}

} // namespace
} // namespace simdbezier::tests::view_test
