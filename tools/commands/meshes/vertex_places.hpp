// Where the vertices of a mesh lie on their patches, and curvatures there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/commands/mesh_arguments.hpp>
#include <tools/mesh_files/mesh_file.hpp>

namespace simdbezier::tools {

/// Says in the contents which patch numbers and curvatures the mesh of a file of so many patches
/// has.
template <typename T>
void describe_vertices(const MeshArguments& mesh, std::size_t patches, MeshContents& contents);

/// The curvatures of a block of vertices, on their way to a file that calls them as `evaluate`
/// calls their columns.
template <typename T>
class VertexCurvatures {
public:
  /// Returns where so many vertices' curvatures go.
  [[nodiscard]] Curvatures<T> outputs(std::size_t vertices);
  /// Lets a vertex's normal point to the other side.
  void turn(std::size_t vertex);
  /// Returns VertexBlock::data, which is valid until the next call. floats: whether they are stored
  /// as floats.
  [[nodiscard]] std::span<const std::byte> records(bool floats);

private:
  std::array<std::vector<T>, kCurvatureKinds> values_;
  std::vector<std::byte> records_;
};

/// What MeshArguments ask for beside positions and normals, of a block of vertices of one mesh
/// without gaps.
template <typename T>
class VertexPlaces {
public:
  explicit VertexPlaces(const MeshArguments& mesh) : mesh_(mesh) {}

  /// Lets evaluate_mesh() find patches and parameters, if they are needed.
  void ask(std::size_t vertices, MeshOutputs<T>& out);
  /// Finds the curvatures there, about normals that are turned where their patches are.
  void find_curvatures(const PatchSet<T>& set, const Topology& topology, const Options& options);
  /// Takes the file's own patches from then on. pieces: what each patch is of those that it was cut
  /// from; numbers: of each patch in the file. Both are empty where there is no difference.
  void find_in_file(std::span<const PatchPiece> pieces, std::span<const std::uint32_t> numbers);
  /// Puts u and v at the end of every vertex, which has so many values, and returns all of them.
  [[nodiscard]] VertexBlock<T> block(std::span<T> values, std::size_t stride);

private:
  const MeshArguments& mesh_;
  std::vector<std::uint32_t> patch_;
  std::vector<T> u_;
  std::vector<T> v_;
  VertexCurvatures<T> curvatures_;
};

} // namespace simdbezier::tools
