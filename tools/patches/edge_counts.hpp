// How the patches of a file are connected.
#pragma once

#include <cstddef>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// What find_topology() finds, of edges with equal control points.
[[nodiscard]] TopologyCounts joined_counts(const PatchFile& file);

/// Every patch counts its four edges, so shared edges are counted from each side.
struct EdgeCounts {
  std::size_t shared;       ///< one other edge has as many control points, equal in either
                            ///< direction, and the same weights where there are any
  std::size_t non_manifold; ///< more than one other has them
  std::size_t boundary;     ///< no other edge has them
  std::size_t collapsed;    ///< its control points are one point

  explicit EdgeCounts(const TopologyCounts& joined);
};

} // namespace simdbezier::tools
