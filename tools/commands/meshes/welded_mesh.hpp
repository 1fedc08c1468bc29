// One mesh without gaps of all patches of a file.
#pragma once

#include <cstdint>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/commands/arguments.hpp>
#include <tools/commands/meshes/mesh_faces.hpp>
#include <tools/commands/meshes/mesh_plan.hpp>
#include <tools/commands/meshes/mesh_source.hpp>
#include <tools/commands/meshes/vertex_places.hpp>
#include <tools/parts/model_part.hpp>
#include <tools/parts/part_links.hpp>

namespace simdbezier::tools {

/// Is planned when it is made; vertices are computed when they are written. Takes the part, because
/// its points are freed as soon as the plan is made.
///
/// Of a part that is not the whole model, only own patches count and are written. Vertices that
/// earlier parts own are named by foreign(): until place() says their numbers, faces have the
/// numbers behind the part's own vertices, which begin at 0.
template <typename T>
class WeldedMesh final : public MeshSource<T> {
public:
  /// Throws Failure that names the place in the file or the argument at fault.
  WeldedMesh(ModelPart part, const Arguments& arguments, MeshStats& stats);

  [[nodiscard]] MeshContents contents() const override;
  [[nodiscard]] const PartLinks& links() const override { return links_; }
  void write(MeshWriter<T>& writer, StageSeconds& seconds, Progress& progress) override;

  /// Says the numbers of the part's first vertex, and of the foreign ones.
  void place(std::uint32_t first_vertex, std::span<const std::uint32_t> foreign) {
    faces_.place(first_vertex, foreign);
  }
  /// Returns the values of the foreign vertices, MeshContents::stride() each.
  [[nodiscard]] std::vector<T> foreign_values();

private:
  void plan(ModelPart& part);
  void leave_room_for_storage(std::span<const ControlNets<T>> nets, MeshOptions options,
                              const PlannedModel& model);
  void find_links(const std::vector<ModelPart::Lent>& lent);
  void tell_stats();
  void evaluate(SetRange block, std::size_t stride, StageSeconds& seconds);

  [[nodiscard]] SetRange block_from(std::size_t patch) const;
  void write_vertices(SetRange block, MeshWriter<T>& writer, StageSeconds& seconds);
  void write_faces(SetRange block, MeshWriter<T>& writer, StageSeconds& seconds);

  const Arguments& arguments_;
  MeshStats& stats_;
  SetRange own_;                       // of the plan's patches
  std::string name_;                   // the file's, for messages
  MeshBox box_;                        // the model's
  std::vector<std::uint32_t> numbers_; // of patches in the model, if these are not all of its own
  std::size_t numbered_ = 0;           // patches in the model
  MeshPlan<T> plan_;
  double deviation_ = 0; // of own patches
  PartLinks links_;
  MeshFaces faces_;
  std::vector<T> values_;
  VertexPlaces<T> places_;
};

} // namespace simdbezier::tools
