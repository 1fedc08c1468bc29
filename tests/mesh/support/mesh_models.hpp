// Small models with known topology, as bicubic control points in space.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <simdbezier/control_nets.hpp>

namespace simdbezier::tests {

/// Points of a bicubic patch: [j][i].
using PatchPoints = std::array<std::array<std::array<double, 3>, 4>, 4>;

/// Patches, and what is true of every mesh of them.
struct MeshModel {
  std::string name;
  std::vector<PatchPoints> patches;
  long euler = 0;        ///< vertices - edges + triangles
  std::size_t loops = 0; ///< closed curves of open edges
  bool manifold = true;
  bool orientable = true;
  bool repeated = false; ///< whether it has patches twice
  bool agree = true;     ///< whether normals of neighbours agree as the patches are given

  /// All values in one array, which has to outlive the view.
  [[nodiscard]] std::vector<double> values() const;
};

/// One patch; a bulged cube; tori of one patch and more; a ball whose poles are points; a pillow of
/// two patches; a ring that is turned by half; three sheets on one edge; two patches that touch in
/// a corner; a patch twice.
[[nodiscard]] std::vector<MeshModel> mesh_models();

/// The model with its patches in another order, each transposed and reversed at random, so that
/// neighbours meet along all pairs of sides in both directions.
[[nodiscard]] MeshModel shuffled(const MeshModel& model, unsigned seed);

} // namespace simdbezier::tests
