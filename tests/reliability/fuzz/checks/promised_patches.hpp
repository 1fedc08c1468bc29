// How many patches a file promises, counted without the readers: nothing may get lost on the way.
#pragma once

#include <cstddef>
#include <string_view>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::fuzz {

/// The requests Patch and PatchMesh of a .rib file, the statements surf of an .obj file, each of
/// which is one patch at least; 0 for other formats. Geometry of other kinds counts as more than
/// any file has: it must have been refused.
[[nodiscard]] std::size_t promised_patches(std::string_view text, tools::PatchFormat format);

} // namespace simdbezier::fuzz
