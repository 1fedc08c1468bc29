// Meshes to be written, and the writing of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>

namespace simdbezier::tests {

/// What a sample has beside positions.
struct SampleShape {
  std::uint32_t vertices = 24;
  std::uint32_t faces = 30;
  unsigned corners = 3;
  bool normals = true;
  bool uv = false;
  bool patches = false;
  tools::VertexStorage storage = tools::VertexStorage::full;
  bool floats = false;
};

struct SampleMesh {
  tools::MeshContents contents;
  std::vector<double> values;       ///< contents.stride() a vertex
  std::vector<std::uint32_t> patch; ///< if there are any
  std::vector<std::uint32_t> corners;

  [[nodiscard]] const double* vertex(std::size_t number) const {
    return &values[number * contents.stride()];
  }
};

/// Numbers without a pattern, zeros of both signs and numbers next to zero among them; all of them
/// are floats where `floats` says so. The last vertex is named by a face.
[[nodiscard]] SampleMesh make_sample(const SampleShape& shape, bool floats);

/// Hands the mesh over in blocks of so many vertices or faces.
template <typename T>
void write_sample(const SampleMesh& mesh, tools::MeshWriter<T>& writer, std::size_t block);

/// The bytes of the file that make_mesh_writer() leaves.
template <typename T>
[[nodiscard]] std::string written(const SampleMesh& mesh, tools::MeshFormat format,
                                  std::size_t block = 1000000);

} // namespace simdbezier::tests
