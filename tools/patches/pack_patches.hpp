// Patches of a file as packed sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/patch_set.hpp>
#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Packs all patches, or some, for evaluation in T. For float the control points are rounded to
/// float first. Throws Failure naming the place of a control point that T cannot hold.
template <typename T>
[[nodiscard]] PatchSet<T> pack_patches(const PatchFile& file, std::size_t first = 0,
                                       std::size_t patches = PatchFile::kAll);
/// The same for any of them, in ascending order.
template <typename T>
[[nodiscard]] PatchSet<T> pack_patches(const PatchFile& file,
                                       std::span<const std::uint32_t> patches);

/// The number of patches that are packed at a time where a file has many, because packed patches
/// take several times the memory of the file.
inline constexpr std::size_t kBlockPatches = std::size_t{1} << 12;

} // namespace simdbezier::tools
