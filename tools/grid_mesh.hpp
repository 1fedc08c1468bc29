// Meshes whose patches stay apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <tools/grid_blocks.hpp>
#include <tools/mesh_file.hpp>

namespace simdbezier::tools {

/// Every patch is a grid of vertices of its own, in grid order:
///
///     d --- c      a = (i, j), b = (i+1, j): u runs along a row, v across the rows.
///     |   / |      Triangles a b c and a c d are counter-clockwise about du x dv.
///     | /   |
///     a --- b
struct GridMesh {
  std::size_t patches = 0;
  GridSize grid;
  bool normals = true;

  [[nodiscard]] std::uint64_t vertices_per_patch() const noexcept { return grid.nu * grid.nv; }
  [[nodiscard]] std::uint64_t vertices() const noexcept { return patches * vertices_per_patch(); }
  [[nodiscard]] std::uint64_t triangles() const noexcept {
    return patches * (grid.nu - 1) * (grid.nv - 1) * 2;
  }
  [[nodiscard]] MeshContents contents() const {
    MeshContents contents;
    contents.vertices = vertices();
    contents.faces = triangles();
    contents.normals = normals;
    return contents;
  }

  /// Calls f({a, b, c}) for a patch's triangles, vertices counted from 0 in the whole mesh, which
  /// has at most kMostMeshVertices.
  template <typename F>
  void for_each_triangle(std::size_t patch, F&& f) const {
    for (std::size_t j = 0; j + 1 < grid.nv; ++j) {
      for (std::size_t i = 0; i + 1 < grid.nu; ++i) {
        const auto a = static_cast<std::uint32_t>(patch * vertices_per_patch() + j * grid.nu + i);
        const std::uint32_t b = a + 1;
        const auto d = static_cast<std::uint32_t>(a + grid.nu);
        const std::uint32_t c = d + 1;
        f(std::array{a, b, c});
        f(std::array{a, c, d});
      }
    }
  }
};

} // namespace simdbezier::tools
