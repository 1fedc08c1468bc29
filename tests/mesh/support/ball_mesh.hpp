// The model of a ball, for tests that need normals in all directions.
#pragma once

#include <simdbezier/evaluate_mesh.hpp>

#include "tests/mesh/support/evaluated_mesh.hpp"

namespace simdbezier::tests {

inline MeshModel ball() {
  for (MeshModel& model : mesh_models()) {
    if (model.name == "ball 4 x 2") {
      return model;
    }
  }
  return {};
}

/// The box of its control points.
inline QuantisationBox box_of(const EvaluatedMesh<float>& mesh, VertexFormat format) {
  QuantisationBox box;
  const auto nets = ControlNets<double>::packed(std::span<const double>(mesh.values));
  EXPECT_EQ(quantisation_box(std::span<const ControlNets<double>>(&nets, 1), format, box),
            Status::ok);
  return box;
}

} // namespace simdbezier::tests
