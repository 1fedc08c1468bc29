// What of a mesh does not depend on the order of its patches, and what does: see evaluate_mesh().
#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "tests/mesh/support/evaluated_mesh.hpp"
#include "tests/mesh/support/mesh_oracle.hpp"

namespace simdbezier::tests::patch_order_test {
namespace {

/// Which patch of the model, u and v.
using Place = std::array<double, 3>;

struct Values {
  Point position;
  Point normal;
  bool lowest = false; ///< whether the patch is the lowest at its position
};

/// The vertices of each patch of a mesh whose patches come in another order.
std::map<Place, Values> vertices_of(const MeshModel& model, const std::vector<std::size_t>& order,
                                    const TopologyOptions& how) {
  MeshModel ordered = model;
  std::transform(order.begin(), order.end(), ordered.patches.begin(),
                 [&](std::size_t p) { return model.patches[p]; });
  EvaluatedMesh<double> mesh(ordered, 1, 1, how);
  for (std::size_t p = 0; p < order.size(); ++p) { // unequal rates along the edges
    mesh.nu[p] = 3 + static_cast<std::uint32_t>(order[p] % 3);
    mesh.nv[p] = 4;
  }
  EXPECT_EQ(lay_out_mesh(mesh.topology, {mesh.nu, mesh.nv, {}}, mesh.layout), Status::ok);
  EXPECT_EQ(split_parameters(mesh.layout, mesh.layout), Status::ok);
  mesh.evaluate_all();
  std::map<Place, Values> vertices;
  std::map<Point, std::uint32_t> lowest;
  for (std::size_t k = 0; k < mesh.position.size(); ++k) {
    const auto [at, added] = lowest.insert({mesh.position[k], mesh.patch[k]});
    at->second = std::min(at->second, mesh.patch[k]);
  }
  for (std::size_t k = 0; k < mesh.position.size(); ++k) {
    const auto& [u, v] = mesh.parameters[k];
    vertices[{static_cast<double>(order[mesh.patch[k]]), u, v}] = {
        mesh.position[k], mesh.normal[k], lowest[mesh.position[k]] == mesh.patch[k]};
  }
  EXPECT_EQ(vertices.size(), mesh.position.size());
  return vertices;
}

/// The patches' own unit normals where they meet, by the position of a mesh in the model's order.
std::map<Point, std::vector<Point>> normals_at(const MeshModel& model,
                                               const std::map<Place, Values>& vertices) {
  std::map<Point, std::vector<Point>> normals;
  for (const auto& [place, values] : vertices) {
    const Point n =
        surface_normal(model.patches[static_cast<std::size_t>(place[0])], place[1], place[2]);
    normals[values.position].push_back(1 / length(n) * n);
  }
  return normals;
}

struct Counts {
  std::size_t equal = 0;
  std::size_t rounded = 0;
  std::size_t lowest = 0;
};

void compare(const MeshModel& model, const TopologyOptions& how, unsigned seed, Counts& counts) {
  std::vector<std::size_t> order(model.patches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto given = vertices_of(model, order, how);
  const auto own = normals_at(model, given);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  const auto vertices = vertices_of(model, order, how);
  ASSERT_EQ(vertices.size(), given.size());
  double outside = 0; // of the connected part, which its lowest patch decides
  for (const auto& [place, values] : vertices) {
    const Values& before = given.at(place);
    EXPECT_EQ(values.position, before.position);
    const std::vector<Point>& normals = own.at(before.position);
    const bool agree =
        how.orient || std::all_of(normals.begin(), normals.end(),
                                  [&](const auto& n) { return dot(n, normals[0]) > 0; });
    outside = outside == 0 ? (dot(values.normal, before.normal) > 0 ? 1 : -1) : outside;
    const double sign = how.orient ? outside : 1;
    if (agree && normals.size() <= 2) {
      EXPECT_EQ(values.normal, sign * before.normal);
      ++counts.equal;
    } else if (agree) {
      EXPECT_LT(length(values.normal - sign * before.normal), 1e-15);
      ++counts.rounded;
    } else if (normals.size() == 2 && values.lowest) {
      const Point n =
          surface_normal(model.patches[static_cast<std::size_t>(place[0])], place[1], place[2]);
      EXPECT_LT(length(values.normal - 1 / length(n) * n), 1e-12);
      ++counts.lowest;
    }
  }
}

TEST(PatchOrder, changes_normals_only_where_the_lowest_patch_decides) {
  Counts counts;
  for (const MeshModel& original : mesh_models()) {
    if (original.name != "torus 4 x 3" && original.name != "sheet" && original.name != "cube") {
      continue;
    }
    for (unsigned seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE(original.name + ", " + std::to_string(seed));
      const MeshModel model = seed == 0 ? original : shuffled(original, seed); // and turned
      TopologyOptions how;
      compare(model, how, seed + 1, counts);
      how.orient = true;
      compare(model, how, seed + 1, counts);
    }
  }
  EXPECT_GT(counts.equal, 5000U);
  EXPECT_GT(counts.rounded, 500U);
  EXPECT_GT(counts.lowest, 500U);
}

} // namespace
} // namespace simdbezier::tests::patch_order_test
