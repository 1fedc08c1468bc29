// Binary patches that are written.
#pragma once

#include <cstdint>
#include <span>

#include <tools/formats/patch_file.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

/// Numbers are floats where floats hold all of them.
void write_sbp(const PatchFile& file, std::span<const std::uint32_t> order, OutputFile& out);

} // namespace simdbezier::tools
