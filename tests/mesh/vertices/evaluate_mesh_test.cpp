// Vertices of meshes against surfaces and normals by the tests' own formulas, and against the grids
// of the library for their bits.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mesh/support/evaluated_mesh.hpp"
#include "tests/mesh/support/mesh_oracle.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::evaluate_mesh_test {
namespace {

template <typename T>
Point to_point(const std::array<T, 3>& x) {
  return {x[0], x[1], x[2]};
}

/// A sheet of so many patches a side: more of them than the samples of which are kept at once, if a
/// side has 24.
MeshModel sheet(std::size_t side) {
  MeshModel model;
  model.name = "sheet of " + std::to_string(side);
  for (std::size_t p = 0; p < side * side; ++p) {
    PatchPoints& patch = model.patches.emplace_back();
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const auto x = static_cast<double>(3 * (p % side) + i);
        const auto y = static_cast<double>(3 * (p / side) + j);
        patch[j][i] = {x + 0.1 * y, y, std::sin(0.5 * x) * std::cos(0.4 * y)};
      }
    }
  }
  return model;
}

/// A model, and the largest rate of its mesh.
struct Case {
  MeshModel model;
  std::uint32_t most;

  [[nodiscard]] std::string name() const {
    return model.name + ", rates up to " + std::to_string(most);
  }
};

/// Sheets whose patches go together in a kernel: all of them, some of them, or only their corners.
std::vector<Case> sheets() {
  std::vector<Case> cases;
  for (const std::size_t side : {2U, 9U, 24U}) {
    for (const std::uint32_t most : {1U, 2U, 3U, 7U}) {
      cases.push_back({sheet(side), most});
      cases.push_back({shuffled(sheet(side), most), most});
    }
  }
  return cases;
}

std::vector<MeshModel> models_and_shuffled() {
  std::vector<MeshModel> models = mesh_models();
  for (unsigned seed = 1; seed < 3; ++seed) {
    for (const MeshModel& model : mesh_models()) {
      models.push_back(shuffled(model, seed));
    }
  }
  return models;
}

/// The sheets, and the other models with rates up to `most`.
std::vector<Case> all_cases(std::uint32_t most) {
  std::vector<Case> cases = sheets();
  for (const MeshModel& model : models_and_shuffled()) {
    cases.push_back({model, most});
  }
  return cases;
}

using EvaluateMesh = IsaTest;

TEST_P(EvaluateMesh, positions_and_parameters_are_the_surface) {
  for (const Case& given : all_cases(7)) {
    const auto& [model, most] = given;
    SCOPED_TRACE(given.name());
    EvaluatedMesh<double> mesh(model, most, 1);
    run<Options>({}, [&](const Options& options) {
      return evaluate_mesh(mesh.set, mesh.layout, mesh.outputs(), options);
    });
    std::set<std::array<double, 3>> places;
    for (std::size_t k = 0; k < mesh.position.size(); ++k) {
      const auto [u, v] = mesh.parameters[k];
      ASSERT_LT(mesh.patch[k], model.patches.size());
      EXPECT_LT(length(surface(model.patches[mesh.patch[k]], u, v) - mesh.position[k]), 1e-12);
      places.insert({static_cast<double>(mesh.patch[k]), u, v});
    }
    EXPECT_EQ(places.size(), mesh.position.size()) << "no two vertices are one point of a patch";
  }
}
INSTANTIATE_FOR_EVERY_ISA(EvaluateMesh);

template <typename T>
class VertexBits : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(VertexBits, Scalars);

/// Every patch's triangles have its own grid's points, edges of neighbours included.
TYPED_TEST(VertexBits, are_those_of_each_patchs_grid) {
  using T = TypeParam;
  for (const Case& given : all_cases(9)) {
    const auto& [model, most] = given;
    SCOPED_TRACE(given.name());
    EvaluatedMesh<T> mesh(model, most, 2);
    mesh.evaluate_all();
    for (std::size_t p = 0; p < model.patches.size(); ++p) {
      const Grid<T> grid = Grid<T>::uniform(mesh.nu[p] + 1, mesh.nv[p] + 1, {p, 1});
      const auto samples = evaluate(mesh.set, grid, {Output::position, Output::normal});
      ASSERT_TRUE(samples);
      std::set<std::array<T, 3>> positions;
      std::set<std::array<std::array<T, 3>, 2>> both;
      for (const std::uint32_t vertex : mesh.vertices_of(p)) {
        positions.insert(mesh.position[vertex]);
        both.insert({mesh.position[vertex], mesh.normal[vertex]});
      }
      for (std::size_t j = 0; j <= mesh.nv[p]; ++j) {
        for (std::size_t i = 0; i <= mesh.nu[p]; ++i) {
          const std::size_t k = j * (mesh.nu[p] + 1) + i;
          EXPECT_TRUE(positions.contains(samples.position[k])) << i << ", " << j;
          const bool inner = i > 0 && i < mesh.nu[p] && j > 0 && j < mesh.nv[p];
          EXPECT_TRUE(!inner || both.contains({samples.position[k], samples.normal[k]}));
        }
      }
    }
  }
}

/// Sums over all patches that come to a vertex, found by their places.
class NormalOracle {
public:
  explicit NormalOracle(const EvaluatedMesh<double>& mesh, const MeshModel& model)
      : mesh_(mesh), model_(model) {
    std::set<std::uint32_t> rates(mesh.nu.begin(), mesh.nu.end());
    rates.insert(mesh.nv.begin(), mesh.nv.end());
    std::set<double> fractions;
    for (const std::uint32_t n : rates) {
      for (std::uint32_t i = 0; i <= n; ++i) {
        fractions.insert(static_cast<double>(i) / n);
      }
    }
    for (std::size_t p = 0; p < model.patches.size(); ++p) {
      for (const double t : fractions) {
        for (const auto& [u, v] : {std::array{t, 0.0}, {t, 1.0}, {0.0, t}, {1.0, t}}) {
          add(p, u, v);
        }
      }
    }
    std::sort(touching_.begin(), touching_.end(),
              [](const Touching& a, const Touching& b) { return a.position[0] < b.position[0]; });
  }

  /// The normal of a vertex; zero where one of its patches has none.
  [[nodiscard]] Point at(std::size_t vertex) const {
    const Point sum = sum_at(vertex);
    return length(sum) > 0.01 ? 1 / length(sum) * sum : Point{};
  }
  /// The sum of the unit normals there.
  [[nodiscard]] Point sum_at(std::size_t vertex) const {
    const Point& x = mesh_.position[vertex];
    std::set<std::array<double, 3>> seen;
    Point sum{};
    const auto is_left = [](const Touching& touching, double limit) {
      return touching.position[0] < limit;
    };
    auto from = std::lower_bound(touching_.begin(), touching_.end(), x[0] - 1e-9, is_left);
    for (; from != touching_.end() && from->position[0] <= x[0] + 1e-9; ++from) {
      const Touching& touching = *from;
      if (length(touching.position - x) < 1e-9 &&
          seen.insert({static_cast<double>(touching.patch), touching.u, touching.v}).second) {
        if (!(length(touching.normal) > 1e-6)) {
          return {};
        }
        sum = sum + 1 / length(touching.normal) * touching.normal;
      }
    }
    if (seen.empty()) {
      const auto [u, v] = mesh_.parameters[vertex];
      sum = sided_normal(mesh_.patch[vertex], u, v);
    }
    return sum;
  }

private:
  struct Touching {
    std::size_t patch;
    double u;
    double v;
    Point position;
    Point normal;
  };
  [[nodiscard]] Point sided_normal(std::size_t p, double u, double v) const {
    return (mesh_.topology.is_turned(p) ? -1.0 : 1.0) * surface_normal(model_.patches[p], u, v);
  }
  void add(std::size_t p, double u, double v) {
    touching_.push_back({p, u, v, surface(model_.patches[p], u, v), sided_normal(p, u, v)});
  }

  const EvaluatedMesh<double>& mesh_;
  const MeshModel& model_;
  std::vector<Touching> touching_;
};

TEST(MeshNormals, are_merged_over_all_patches_at_a_vertex) {
  std::size_t compared = 0;
  for (const MeshModel& model : models_and_shuffled()) {
    const bool apart = model.name.starts_with("touching") || model.name.starts_with("one patch");
    if (!model.orientable || apart) { // patches that are not joined, and two normals in one place
      continue;
    }
    for (const bool flip : {false, true}) {
      SCOPED_TRACE(model.name + (flip ? ", flipped" : ""));
      TopologyOptions how;
      how.orient = true;
      how.flip = flip;
      EvaluatedMesh<double> mesh(model, 5, 3, how);
      mesh.evaluate_all();
      const NormalOracle oracle(mesh, model);
      for (std::size_t k = 0; k < mesh.normal.size(); ++k) {
        const Point expected = oracle.at(k);
        EXPECT_NEAR(length(mesh.normal[k]), 1, 1e-12);
        if (length(expected) > 0) {
          EXPECT_LT(length(mesh.normal[k] - expected), 1e-8) << k;
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 3000U);
}

TEST_P(EvaluateMesh, merges_the_normals_of_patches_of_few_cells) {
  for (const Case& given : sheets()) {
    const auto& [model, most] = given;
    SCOPED_TRACE(given.name());
    TopologyOptions how;
    how.orient = true;
    EvaluatedMesh<double> mesh(model, most, 3, how);
    run<Options>({}, [&](const Options& options) {
      return evaluate_mesh(mesh.set, mesh.layout, mesh.outputs(), options);
    });
    const NormalOracle oracle(mesh, model);
    const MeshOutputs<double> all = mesh.outputs();
    for (std::size_t k = 0; k < mesh.normal.size(); ++k) {
      ASSERT_LT(length(mesh.normal[k] - oracle.at(k)), 1e-9) << k;
    }
    // Either output alone has the same bits.
    const auto position = mesh.position;
    const auto normal = mesh.normal;
    for (const bool alone : {false, true}) {
      MeshOutputs<double> one;
      (alone ? one.normal : one.position) = alone ? all.normal : all.position;
      mesh.position.assign(position.size(), {});
      mesh.normal.assign(normal.size(), {});
      run<Options>({}, [&](const Options& options) {
        return evaluate_mesh(mesh.set, mesh.layout, one, options);
      });
      EXPECT_EQ(alone ? mesh.normal : mesh.position, alone ? normal : position);
    }
  }
}

TEST(MeshNormals, of_sides_that_disagree_are_the_first_ones) {
  for (const MeshModel& model : mesh_models()) {
    if (model.name != "one patch twice") {
      continue;
    }
    // The second patch the other way round: its normals are opposite everywhere.
    MeshModel turned = model;
    for (auto& row : turned.patches[1]) {
      std::reverse(row.begin(), row.end());
    }
    EvaluatedMesh<double> mesh(turned, 4, 5);
    mesh.evaluate_all();
    const std::size_t own = mesh.layout.first_vertex(1);
    for (std::size_t k = 0; k < own; ++k) {
      const auto [u, v] = mesh.parameters[k];
      const Point n = surface_normal(turned.patches[0], u, v);
      EXPECT_LT(length(mesh.normal[k] - 1 / length(n) * n), 1e-12);
    }
  }
}

/// Faces of a cube, some of them inside out: where two disagree along an edge, the normal is that
/// of the lower one.
TEST(MeshNormals, of_faces_inside_out_are_not_merged) {
  std::size_t alone = 0;
  std::size_t merged = 0;
  for (unsigned seed = 1; seed < 6; ++seed) {
    for (const MeshModel& original : mesh_models()) {
      if (original.name != "cube") {
        continue;
      }
      const MeshModel model = shuffled(original, seed);
      EvaluatedMesh<double> mesh(model, 5, seed);
      mesh.evaluate_all();
      const auto outwards = [&](const Point& n, std::size_t k) {
        return dot(n, mesh.position[k]) > 0;
      };
      const NormalOracle oracle(mesh, model);
      for (std::size_t k = 0; k < mesh.normal.size(); ++k) {
        const auto [u, v] = mesh.parameters[k];
        const bool on_u = u == 0 || u == 1;
        const bool on_v = v == 0 || v == 1;
        if (on_u == on_v) {
          continue; // inside, or a corner
        }
        const Point own = surface_normal(model.patches[mesh.patch[k]], u, v);
        const Point sum = oracle.sum_at(k);
        // Normals of both faces point away from the middle, or both towards it: by far more than
        // where they are on different sides.
        const bool agree = std::fabs(dot(sum, mesh.position[k])) > length(mesh.position[k]);
        agree ? ++merged : ++alone;
        const Point expected = agree ? sum : own;
        EXPECT_EQ(outwards(mesh.normal[k], k), outwards(own, k));
        EXPECT_LT(length(mesh.normal[k] - 1 / length(expected) * expected), 1e-9);
      }
    }
  }
  EXPECT_GT(alone, 20U);
  EXPECT_GT(merged, 20U);
}

TEST(MeshTriangles, are_counter_clockwise_about_the_normals) {
  for (const MeshModel& model : models_and_shuffled()) {
    if (model.name.find("cube") == std::string::npos && !model.name.starts_with("torus 4")) {
      continue;
    }
    for (const bool flip : {false, true}) {
      SCOPED_TRACE(model.name + (flip ? ", flipped" : ""));
      TopologyOptions how;
      how.orient = true;
      how.flip = flip;
      EvaluatedMesh<float> mesh(model, 1, 3, how);
      std::fill(mesh.nu.begin(), mesh.nu.end(), 20U);
      std::fill(mesh.nv.begin(), mesh.nv.end(), 20U);
      ASSERT_EQ(lay_out_mesh(mesh.topology, {mesh.nu, mesh.nv, {}}, mesh.layout), Status::ok);
      mesh.evaluate_all();
      for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
        std::array<Point, 3> t;
        Point normal{};
        for (std::size_t i = 0; i < 3; ++i) {
          t[i] = to_point(mesh.position[mesh.triangles[k + i]]);
          normal = normal + to_point(mesh.normal[mesh.triangles[k + i]]);
        }
        EXPECT_GT(dot(cross(t[1] - t[0], t[2] - t[0]), normal), 0);
      }
    }
  }
}

} // namespace
} // namespace simdbezier::tests::evaluate_mesh_test
