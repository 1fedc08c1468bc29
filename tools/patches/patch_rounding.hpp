// How far a surface moves when its control points are rounded.
#pragma once

#include <cstddef>
#include <vector>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Returns for each of these patches a bound on the distance between a position that is evaluated
/// in T and the surface that the file describes, whose control points are moved (move_patches())
/// and rounded to T first. Throws Failure where T cannot hold one of them.
template <typename T>
[[nodiscard]] std::vector<double> rounding_errors(const PatchFile& file, std::size_t first,
                                                  std::size_t count);

} // namespace simdbezier::tools
