// Files of patches that are written.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Returns "bez, bpt, … or sbp", every name behind `prefix`: the formats that can be written.
[[nodiscard]] std::string written_patch_formats(const std::string& prefix);
/// Returns the format of that name, if it can be written.
[[nodiscard]] std::optional<PatchFormat> written_patch_format(const std::string& name);

/// Writes all patches in this order, with all digits of their numbers. Throws Failure where the
/// format cannot hold a patch as it is.
void write_patches(const PatchFile& file, std::span<const std::uint32_t> order,
                   const std::string& out, PatchFormat format);

} // namespace simdbezier::tools
