// Meshes of control points whose patches share rows and columns, as in OBJ and RIB.
#pragma once

#include <cstddef>

namespace simdbezier::tools {

/// One direction of a mesh: patch k has the points k * step to k * step + degree, counted on from
/// the beginning where the mesh is closed.
struct MeshDirection {
  std::size_t points = 0;
  std::size_t step = 3;
  std::size_t patches = 0;

  [[nodiscard]] std::size_t point(std::size_t patch, std::size_t k) const noexcept {
    return (patch * step + k) % points;
  }
};

} // namespace simdbezier::tools
