// Which patches meet along which edges.
#pragma once

#include <cstddef>

#include <tools/patch_file.hpp>

namespace simdbezier::tools {

/// Every patch counts its four edges, so shared edges are counted from each side.
struct EdgeCounts {
  std::size_t shared = 0;    ///< another edge has bit-equal control points, in either direction,
                             ///< and as many of them; with weights, those too
  std::size_t boundary = 0;  ///< no other edge has
  std::size_t collapsed = 0; ///< its control points are one point
};

[[nodiscard]] EdgeCounts count_edges(const PatchFile& file);

} // namespace simdbezier::tools
