// Meshes on their way to a file: block by block, so that memory does not grow with them.
#pragma once

#include <tools/commands/meshes/mesh_stats.hpp>
#include <tools/mesh_files/mesh_file.hpp>
#include <tools/parts/part_links.hpp>
#include <tools/process/progress.hpp>

namespace simdbezier::tools {

/// A mesh that has been planned and can be evaluated piece by piece.
template <typename T>
class MeshSource {
public:
  MeshSource() = default;
  virtual ~MeshSource() = default;
  MeshSource(const MeshSource&) = delete;
  MeshSource& operator=(const MeshSource&) = delete;

  [[nodiscard]] virtual MeshContents contents() const = 0;
  /// What joins it with other parts of a model.
  [[nodiscard]] virtual const PartLinks& links() const {
    static const PartLinks none;
    return none;
  }
  /// Hands all vertices and faces to the writer, adds to `seconds`, and moves the bar.
  virtual void write(MeshWriter<T>& writer, StageSeconds& seconds, Progress& progress) = 0;
};

} // namespace simdbezier::tools
