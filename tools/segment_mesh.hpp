// Meshes of control points whose patches share rows and columns, as in OBJ and RIB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <tools/patch_file.hpp>

namespace simdbezier::tools {

/// One direction of a mesh: patch k of it has the points k * step to k * step + degree, counted
/// around the end where the mesh is closed.
struct MeshDirection {
  int degree = 3;
  std::size_t points = 0;
  std::size_t step = 3;
  std::size_t patches = 0;

  [[nodiscard]] std::size_t point(std::size_t patch, std::size_t k) const noexcept {
    return (patch * step + k) % points;
  }
};

/// A point with its weight, or 1 where there is none, and its line.
struct MeshPoint {
  std::array<double, 4> value = {0, 0, 0, 1};
  std::size_t line = 0;
};

/// Appends the patches of a mesh, u fastest; at(index) gives the MeshPoint of a place in the mesh,
/// u fastest.
template <typename F>
void add_mesh(PatchFile& file, const MeshDirection& u, const MeshDirection& v, Weights weights,
              F&& at) {
  const auto patch = [&](std::size_t patch_u, std::size_t patch_v) {
    for (std::size_t j = 0; j <= static_cast<std::size_t>(v.degree); ++j) {
      for (std::size_t i = 0; i <= static_cast<std::size_t>(u.degree); ++i) {
        const MeshPoint& point = at(v.point(patch_v, j) * u.points + u.point(patch_u, i));
        file.points.insert(file.points.end(), point.value.begin(),
                           point.value.end() - (weights == Weights::none ? 1 : 0));
        file.add_line(point.line);
      }
    }
    file.close_patch(u.degree, v.degree, weights);
  };
  for (std::size_t patch_v = 0; patch_v < v.patches; ++patch_v) {
    for (std::size_t patch_u = 0; patch_u < u.patches; ++patch_u) {
      patch(patch_u, patch_v);
    }
  }
}

} // namespace simdbezier::tools
