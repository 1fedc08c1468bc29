// Models around an origin of their own: far from 0, numbers are coarse.
#pragma once

#include <array>

#include <tools/formats/patch_file.hpp>
#include <tools/mesh_files/mesh_file.hpp>

namespace simdbezier::tools {

/// Returns the middle of the box, up to a sixteenth of its diagonal, in so few digits that points
/// of the model mostly keep all of theirs when they count from there.
[[nodiscard]] std::array<double, 3> own_origin(const MeshBox& box);

/// Lets all points count from the origin, and adds to PatchFile::moved_error what that rounds.
/// Throws Failure where a point is too far from it.
void move_patches(PatchFile& file, const std::array<double, 3>& origin);

} // namespace simdbezier::tools
