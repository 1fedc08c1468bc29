// The patches themselves as VTK's Bézier quadrilaterals, in a .vtu file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <simdbezier/simdbezier.hpp>
#include <tools/commands/arguments.hpp>
#include <tools/commands/meshes/mesh_stats.hpp>
#include <tools/formats/patch_file.hpp>
#include <tools/mesh_files/vtu_file.hpp>
#include <tools/process/progress.hpp>

namespace simdbezier::tools {

/// Every patch is a cell of its own, with points of its own. VTK takes points as they are and
/// weights beside them, so homogeneous points are divided, in double, and then rounded to Stored;
/// the deviation of the file is a bound on what that does to the surface. If one patch has weights,
/// those of the others are 1.
template <typename Stored>
class BezierCells {
public:
  /// The file has to outlive it. Throws Failure where Stored cannot hold a patch.
  BezierCells(const PatchFile& file, const Arguments& arguments, MeshStats& stats);

  void write(Progress& progress);
  [[nodiscard]] bool is_terminal() const { return out_->is_terminal(); }
  void complete() { out_->complete(); }
  void finish() { out_->commit(); }

private:
  /// A patch of the file; point k has its values from point(k) on, u fastest.
  struct Patch {
    const ControlNets<double>* nets;
    const double* values;
    [[nodiscard]] const double* point(std::size_t k) const {
      return values + static_cast<std::ptrdiff_t>(k) * nets->point_stride;
    }
    [[nodiscard]] std::size_t points() const {
      return static_cast<std::size_t>((nets->degree_u + 1) * (nets->degree_v + 1));
    }
  };

  template <typename Visit>
  void for_patches(Visit&& visit) const;
  [[nodiscard]] double deviation_of(const Patch& patch) const;
  [[nodiscard]] std::vector<VtuSection> sections() const;
  void write_points(Progress& progress);
  void write_weights();

  const PatchFile& file_;
  std::string path_;
  std::uint64_t points_ = 0;
  bool rational_ = false; // one patch at least
  std::optional<VtuFile> out_;
};

} // namespace simdbezier::tools
