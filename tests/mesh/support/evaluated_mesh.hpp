// A model with random rates, and the vertices and triangles of its mesh.
#pragma once

#include <array>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <simdbezier/evaluate_mesh.hpp>
#include <simdbezier/mesh_layout.hpp>

#include "tests/mesh/support/mesh_models.hpp"

namespace simdbezier::tests {

/// A model with rates, and its mesh.
template <typename T>
struct EvaluatedMesh {
  std::vector<double> values;
  Topology topology;
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  MeshLayout layout;
  PatchSet<T> set;
  std::vector<std::array<T, 3>> position;
  std::vector<std::array<T, 3>> normal;
  std::vector<std::array<T, 2>> parameters;
  std::vector<std::uint32_t> patch;
  std::vector<std::uint32_t> triangles;

  EvaluatedMesh(const MeshModel& model, std::uint32_t most, unsigned seed,
                const TopologyOptions& how = {})
      : values(model.values()) {
    const std::size_t patches = model.patches.size();
    const auto nets = ControlNets<double>::packed(values.data(), patches, 3, 3);
    EXPECT_EQ(find_topology(nets, topology, how), Status::ok);
    std::mt19937 random(seed);
    for (std::size_t p = 0; p < patches; ++p) {
      nu.push_back(1 + static_cast<std::uint32_t>(random() % most));
      nv.push_back(1 + static_cast<std::uint32_t>(random() % most));
    }
    std::size_t raised = 0;
    EXPECT_EQ(separate_vertices(topology, nu, nv, raised), Status::ok);
    EXPECT_EQ(lay_out_mesh(topology, {nu, nv, {}}, layout), Status::ok);
    EXPECT_TRUE(pack(nets, set));
  }

  [[nodiscard]] MeshOutputs<T> outputs() {
    const std::size_t vertices = layout.size().vertices;
    position.resize(vertices);
    normal.resize(vertices);
    parameters.resize(vertices);
    patch.resize(vertices);
    MeshOutputs<T> out;
    out.position = Vectors<T>::xyz(position);
    out.normal = Vectors<T>::xyz(normal);
    out.parameters = Vectors<T>::pairs(std::span<T>(parameters.front().data(), 2 * vertices));
    out.patch = patch;
    return out;
  }
  void evaluate_all(const Options& options = {}) {
    EXPECT_EQ(evaluate_mesh(set, layout, outputs(), options), Status::ok);
    triangles.resize(3 * layout.size().triangles);
    EXPECT_EQ(write_triangles(layout, std::span(triangles), {.threads = 1}), Status::ok);
  }
  /// Vertices of a patch's triangles.
  [[nodiscard]] std::set<std::uint32_t> vertices_of(std::size_t p) const {
    return {triangles.begin() + static_cast<std::ptrdiff_t>(3 * layout.first_triangle(p)),
            triangles.begin() + static_cast<std::ptrdiff_t>(3 * layout.first_triangle(p + 1))};
  }
};

} // namespace simdbezier::tests
