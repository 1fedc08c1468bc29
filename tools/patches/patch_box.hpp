// The box of control points.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include <tools/formats/patch_file.hpp>
#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

/// Returns the box of all control points, or of those of some patches, in Cartesian coordinates; -0
/// counts as 0, as in the library.
[[nodiscard]] MeshBox box_of(const PatchFile& file, std::size_t first = 0,
                             std::size_t patches = PatchFile::kAll);

/// Returns whether an origin inside of the box would at least halve the largest coordinate.
[[nodiscard]] bool is_far(const MeshBox& box);

/// Throws Failure if numbers of T make one point of a model that is none. It advises --origin where
/// that can help and `can_move` says that there is one.
template <typename T>
void expect_no_point(const MeshBox& box, const std::string& name, bool can_move) {
  const auto is_one = [&](std::size_t c) {
    return static_cast<T>(box.low[c]) == static_cast<T>(box.high[c]);
  };
  const bool fits = largest_coordinate(box) <= double{std::numeric_limits<T>::max()};
  if (fits && box.low != box.high && is_one(0) && is_one(1) && is_one(2)) {
    bad_input(name +
              ": expected a model that numbers of --precision do not make one point, found "
              "one of size " +
              shortest(diagonal_of(box)) +
              (can_move && is_far(box) ? " far from the origin (--origin auto moves it)" : ""));
  }
}

} // namespace simdbezier::tools
