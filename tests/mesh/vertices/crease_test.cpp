// Vertices that are split into several where patches meet at an angle.
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include <simdbezier/results.hpp>

#include "tests/mesh/support/evaluated_mesh.hpp"
#include "tests/mesh/support/mesh_oracle.hpp"

namespace simdbezier::tests::crease_test {
namespace {

/// A roof of planes: patch k of an x-z polyline, each one over y from 0 to 3.
MeshModel roof(const std::vector<Point>& ridge) {
  MeshModel model{"roof", {}, 1, 1};
  for (std::size_t k = 0; k + 1 < ridge.size(); ++k) {
    PatchPoints& patch = model.patches.emplace_back();
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double t = static_cast<double>(i) / 3;
        patch[j][i] = i == 0   ? ridge[k]
                      : i == 3 ? ridge[k + 1]
                               : (1 - t) * ridge[k] + t * ridge[k + 1];
        patch[j][i][1] = static_cast<double>(j);
      }
    }
  }
  return model;
}

MeshModel bulged_cube() {
  for (MeshModel& model : mesh_models()) {
    if (model.name == "cube") {
      return model;
    }
  }
  return {};
}

template <typename T>
void split(EvaluatedMesh<T>& mesh, double degrees) {
  ASSERT_EQ(split_creases(mesh.set, mesh.layout, degrees, mesh.layout), Status::ok);
}

struct Angle {
  double degrees; ///< between the planes of two neighbours
  double crease;
  bool splits;
};
constexpr Angle kAngles[] = {{30, 29, true},   {30, 31, false},   {90, 89, true}, {90, 91, false},
                             {150, 149, true}, {150, 151, false}, {30, 0, true},  {0.5, 0, true},
                             {0.5, 0.4, true}, {0.5, 0.6, false}};

TEST(Creases, split_where_planes_meet_at_more_than_the_angle) {
  for (const Angle& angle : kAngles) {
    SCOPED_TRACE(std::to_string(angle.degrees) + ", crease " + std::to_string(angle.crease));
    const double a = angle.degrees * std::numbers::pi / 180;
    const MeshModel model = roof({{-3, 0, 0}, {0, 0, 0}, {3 * std::cos(a), 0, 3 * std::sin(a)}});
    for (unsigned seed = 0; seed < 4; ++seed) {
      // Patches the other way round, with normals that agree.
      TopologyOptions how;
      how.orient = true;
      EvaluatedMesh<double> mesh(seed == 0 ? model : shuffled(model, seed), 6, seed, how);
      const std::size_t whole = mesh.layout.size().vertices;
      const std::size_t triangles = mesh.layout.size().triangles;
      mesh.evaluate_all();
      const std::vector<std::array<double, 3>> position = mesh.position;
      const std::vector<std::uint32_t> before = mesh.triangles;
      split(mesh, angle.crease);
      EXPECT_EQ(mesh.layout.size().vertices > whole, angle.splits);
      EXPECT_EQ(mesh.layout.size().triangles, triangles);
      mesh.evaluate_all();
      for (std::size_t k = 0; k < before.size(); ++k) {
        EXPECT_EQ(mesh.position[mesh.triangles[k]], position[before[k]]);
      }
      std::set<Point> directions; // of two planes, and of what is merged between them
      for (const Point& normal : mesh.normal) {
        const auto round = [](double x) { return std::round(1e6 * x); };
        directions.insert({round(normal[0]), round(normal[1]), round(normal[2])});
      }
      EXPECT_EQ(directions.size(), angle.splits ? 2U : 3U);
    }
  }
}

/// Two planes in a plane of any direction, or with a small angle between them: what float rounds of
/// a normal is no crease.
TEST(Creases, of_small_angles_leave_planes_whole) {
  constexpr double kCreases[] = {3e-4, 1e-4, 1e-5};
  std::size_t planes = 0;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (const double crease : kCreases) {
        for (const double rise : {0.0, 20 * crease}) {
          SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(rise) +
                       " at " + std::to_string(crease));
          MeshModel model = roof({{-3, 0, 0}, {0, 0, 0}, {3, 0, 0}});
          for (PatchPoints& patch : model.patches) {
            for (auto& row : patch) {
              for (Point& p : row) {
                p[2] = x * p[0] + y * p[1] + (p[0] > 0 ? rise * p[0] : 0);
              }
            }
          }
          EvaluatedMesh<float> mesh(model, 5, 2);
          const std::size_t whole = mesh.layout.size().vertices;
          split(mesh, crease * 180 / std::numbers::pi);
          EXPECT_EQ(mesh.layout.size().vertices > whole, rise > 0);
          ++planes;
        }
      }
    }
  }
  EXPECT_EQ(planes, 150U);
}

/// With an angle of 0, every patch's vertices are those of its own grid, normals included.
TEST(Creases, of_no_angle_leave_patches_alone) {
  for (const MeshModel& model : mesh_models()) {
    if (model.name.starts_with("ball") || model.name.starts_with("torus 1") ||
        model.name.starts_with("torus 2")) {
      continue; // points keep one vertex, and some patches are their own neighbours
    }
    SCOPED_TRACE(model.name);
    EvaluatedMesh<float> mesh(model, 5, 11);
    split(mesh, 0);
    mesh.evaluate_all();
    std::size_t own = 0;
    for (std::size_t p = 0; p < model.patches.size(); ++p) {
      const auto samples =
          evaluate(mesh.set, Grid<float>::uniform(mesh.nu[p] + 1, mesh.nv[p] + 1, {p, 1}),
                   {Output::position, Output::normal});
      std::set<std::array<std::array<float, 3>, 2>> both;
      for (const std::uint32_t vertex : mesh.vertices_of(p)) {
        both.insert({mesh.position[vertex], mesh.normal[vertex]});
        EXPECT_EQ(mesh.patch[vertex], p);
        const auto [u, v] = mesh.parameters[vertex];
        const auto& x = mesh.position[vertex];
        const Point exact =
            surface(model.patches[p], static_cast<double>(u), static_cast<double>(v));
        EXPECT_LT(length(exact - Point{x[0], x[1], x[2]}), 1e-4);
      }
      for (std::size_t k = 0; k < samples.position.size(); ++k) {
        EXPECT_TRUE(both.contains({samples.position[k], samples.normal[k]}));
      }
      own += mesh.vertices_of(p).size();
    }
    EXPECT_EQ(own, mesh.position.size());
  }
}

TEST(Creases, of_the_cube_are_its_edges) {
  EvaluatedMesh<float> mesh(bulged_cube(), 1, 1);
  std::fill(mesh.nu.begin(), mesh.nu.end(), 4U);
  std::fill(mesh.nv.begin(), mesh.nv.end(), 4U);
  ASSERT_EQ(lay_out_mesh(mesh.topology, {mesh.nu, mesh.nv, {}}, mesh.layout), Status::ok);
  EXPECT_EQ(mesh.layout.size().vertices, 6U * 16U + 2U);
  const MeshLayout whole = mesh.layout;
  // Faces bulge, so that normals at edges differ by less than a right angle: 66 degrees and less.
  for (const auto& [degrees, vertices] :
       std::map<double, std::size_t>{{20, 6 * 25}, {89, 98}, {180, 98}, {1000, 98}}) {
    ASSERT_EQ(split_creases(mesh.set, whole, degrees, mesh.layout), Status::ok);
    EXPECT_EQ(mesh.layout.size().vertices, vertices) << degrees;
  }
  // A layout that is split may be split anew.
  split(mesh, 20);
  split(mesh, 183);
  EXPECT_EQ(mesh.layout.size().vertices, 98U);
}

/// A fan of planes around an axis: patches join their neighbours, and the last one the first one
/// over all between them.
TEST(Creases, in_a_corner_neighbours_join) {
  const MeshModel model = roof({{0, 0, 0}, {1, 0, 0}, {2, 0, 0.1}, {3, 0, 0.3}, {3.1, 0, 5}});
  EvaluatedMesh<double> mesh(model, 3, 4);
  split(mesh, 17); // 6 and 6 degrees are joined, 80 are not
  mesh.evaluate_all();
  std::map<Point, std::set<Point>> normals;
  for (std::size_t k = 0; k < mesh.position.size(); ++k) {
    normals[mesh.position[k]].insert(mesh.normal[k]);
  }
  for (const auto& [position, different] : normals) {
    EXPECT_EQ(different.size(), position[0] == 3 && position[2] == 0.3 ? 2U : 1U) << position[0];
  }
}

TEST(Creases, bad_input_is_a_status) {
  EvaluatedMesh<float> mesh(bulged_cube(), 3, 1);
  MeshLayout split;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(split_creases(mesh.set, mesh.layout, -1, split), Status::bad_tolerance);
  EXPECT_EQ(split_creases(mesh.set, mesh.layout, nan, split), Status::bad_tolerance);
  EXPECT_EQ(split_creases(PatchSet<float>(), mesh.layout, 1, split), Status::unequal_lengths);
  EXPECT_EQ(split_creases(mesh.set, MeshLayout(), 1, split), Status::unequal_lengths);
  EXPECT_EQ(split.size().vertices, 0U);
  EXPECT_EQ(split_creases(PatchSet<float>(), MeshLayout(), 1, split), Status::ok);
}

} // namespace
} // namespace simdbezier::tests::crease_test
