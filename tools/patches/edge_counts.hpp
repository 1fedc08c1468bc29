// Which patches meet along which edges.
#pragma once

#include <cstddef>

#include <tools/formats/patch_file.hpp>

namespace simdbezier::tools {

/// Every patch counts its four edges, so shared edges are counted from each side.
struct EdgeCounts {
  std::size_t shared = 0;       ///< one other edge has as many control points, bit-equal in either
                                ///< direction, and the same weights where there are any
  std::size_t non_manifold = 0; ///< more than one other has them
  std::size_t boundary = 0;     ///< no other edge has them
  std::size_t collapsed = 0;    ///< its control points are one point
};

[[nodiscard]] EdgeCounts count_edges(const PatchFile& file);

} // namespace simdbezier::tools
