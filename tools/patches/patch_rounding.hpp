// How far a surface moves when its control points are rounded.
#pragma once

#include <cstddef>
#include <vector>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Returns for every patch a bound on the distance between the surface that the file describes and
/// the one of its control points, which are moved (move_patches()) and rounded to T. Throws Failure
/// that names the place where T cannot hold one of them.
template <typename T>
[[nodiscard]] std::vector<double> point_errors(const PatchFile& file);
/// The same for some patches and for positions, to which evaluation in T adds its errors.
template <typename T>
[[nodiscard]] std::vector<double> rounding_errors(const PatchFile& file, std::size_t first,
                                                  std::size_t count);

} // namespace simdbezier::tools
