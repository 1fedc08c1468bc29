// Patches in an order in which neighbours in space are mostly near each other in the file.
#pragma once

#include <cstdint>
#include <vector>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Returns the numbers of all patches in the order in which Hilbert's curve through their box
/// passes the middles of their own boxes; those in one place stay in the order of the file.
[[nodiscard]] std::vector<std::uint32_t> curve_order(const PatchFile& file);

} // namespace simdbezier::tools
