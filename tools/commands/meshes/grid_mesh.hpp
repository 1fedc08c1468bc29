// Meshes whose patches stay apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tools/commands/arguments.hpp>
#include <tools/commands/meshes/mesh_source.hpp>
#include <tools/commands/meshes/vertex_places.hpp>
#include <tools/parts/model_part.hpp>
#include <tools/patches/grid_blocks.hpp>

namespace simdbezier::tools {

/// The patches of a part, which may be a whole model, without ghosts. Every patch is a grid of
/// vertices of its own, in grid order:
///
///     d --- c      a = (i, j), b = (i+1, j): u runs along a row, v across the rows.
///     |   / |      Triangles a b c and a c d are counter-clockwise about du x dv.
///     | /   |
///     a --- b
template <typename T>
class GridMesh final : public MeshSource<T> {
public:
  /// The part has to outlive it. Throws Failure where there are too many vertices, or where T
  /// cannot hold a patch.
  GridMesh(const ModelPart& part, const Arguments& arguments, MeshStats& stats);

  [[nodiscard]] MeshContents contents() const override;
  void write(MeshWriter<T>& writer, StageSeconds& seconds, Progress& progress) override;
  /// Says the number of the part's first vertex in the numbers that faces are to have.
  void place(std::uint32_t first_vertex) { first_vertex_ = first_vertex; }

private:
  /// Measures what takes time and is wanted for statistics only.
  void measure(const PatchFile& file, MeshStats& stats) const;
  [[nodiscard]] std::uint64_t vertices_per_patch() const noexcept { return grid_.nu * grid_.nv; }
  void write_block(const GridBlock& block, MeshWriter<T>& writer, StageSeconds& seconds);
  void turn_normals(std::size_t stride);
  void put_parameters(const GridBlock& block, std::size_t stride);
  /// Writes the faces of these patches, a bounded number at a time.
  void write_faces(std::size_t first, std::size_t count, MeshWriter<T>& writer,
                   StageSeconds& seconds);
  void append_cell(std::uint32_t a);

  const Arguments& arguments_;
  std::size_t patches_;
  std::size_t first_patch_; // in the model
  std::size_t numbered_;    // patches in the model
  std::uint32_t first_vertex_ = 0;
  GridSize grid_;
  MeshBox box_;
  GridEvaluator<T> evaluator_;
  std::vector<T> values_;
  std::vector<std::uint32_t> patch_;
  VertexCurvatures<T> curvatures_;
  std::vector<std::uint32_t> corners_;
};

} // namespace simdbezier::tools
