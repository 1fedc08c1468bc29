// Triangle meshes: what all formats have in common, and one writer for each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <tools/grid_blocks.hpp>
#include <tools/output_file.hpp>

namespace simdbezier::tools {

/// Every patch is a grid of vertices of its own, in grid order:
///
///     d --- c      a = (i, j), b = (i+1, j): u runs along a row, v across the rows.
///     |   / |      Triangles a b c and a c d are counter-clockwise about du x dv.
///     | /   |
///     a --- b
struct Mesh {
  std::size_t patches = 0;
  GridSize grid;
  bool normals = true;

  /// Values of one vertex: x y z, and nx ny nz.
  [[nodiscard]] std::size_t stride() const noexcept { return normals ? 6 : 3; }
  [[nodiscard]] std::uint64_t vertices_per_patch() const noexcept { return grid.nu * grid.nv; }
  [[nodiscard]] std::uint64_t vertices() const noexcept { return patches * vertices_per_patch(); }
  [[nodiscard]] std::uint64_t triangles() const noexcept {
    return patches * (grid.nu - 1) * (grid.nv - 1) * 2;
  }

  /// Calls f({a, b, c}) for a patch's triangles. Vertices are counted from 0 in the whole mesh.
  template <typename F>
  void for_each_triangle(std::size_t patch, F&& f) const {
    for (std::size_t j = 0; j + 1 < grid.nv; ++j) {
      for (std::size_t i = 0; i + 1 < grid.nu; ++i) {
        const std::uint64_t a = patch * vertices_per_patch() + j * grid.nu + i;
        const std::uint64_t b = a + 1;
        const std::uint64_t d = a + grid.nu;
        const std::uint64_t c = d + 1;
        f(std::array{a, b, c});
        f(std::array{a, c, d});
      }
    }
  }
};

/// Takes the vertices of a mesh block by block.
template <typename T>
class MeshWriter {
public:
  virtual ~MeshWriter() = default;
  /// Takes the next vertices in order, stride() values each.
  virtual void vertices(std::span<const T> values) = 0;
  /// Is told that all vertices of these patches have been handed over.
  virtual void patches_done(std::size_t first, std::size_t count) = 0;
};

/// Wavefront OBJ, with v, vn and f lines patch by patch.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>> make_obj_writer(OutputFile& file, const Mesh& mesh);

/// Binary PLY in this machine's byte order and T's precision, with 32-bit indices: vertices, then
/// faces. The header is written at once.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>> make_ply_writer(OutputFile& file, const Mesh& mesh);

/// How many vertices a PLY file's indices can address.
inline constexpr std::uint64_t kMostPlyVertices = std::uint64_t{1} << 31;

} // namespace simdbezier::tools
