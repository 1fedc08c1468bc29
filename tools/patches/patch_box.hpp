// The box of control points.
#pragma once

#include <cstddef>

#include <tools/formats/patch_file.hpp>
#include <tools/mesh_files/mesh_file.hpp>

namespace simdbezier::tools {

/// Returns the box of all control points, or of those of some patches, in Cartesian coordinates; -0
/// counts as 0, as in the library.
[[nodiscard]] MeshBox box_of(const PatchFile& file, std::size_t first = 0,
                             std::size_t patches = PatchFile::kAll);

/// Returns whether an origin inside of the box would at least halve the largest coordinate.
[[nodiscard]] bool is_far(const MeshBox& box);

} // namespace simdbezier::tools
