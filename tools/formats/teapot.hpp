// The 32-patch Utah teapot.
#pragma once

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Newell's teapot with bottom, z up, named "builtin:teapot".
[[nodiscard]] PatchFile teapot();

} // namespace simdbezier::tools
