// What a list of triangles is as a surface, counted from the list alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace simdbezier::tests {

struct TriangleCensus {
  std::size_t out_of_range = 0; ///< vertex numbers
  std::size_t degenerate = 0;   ///< triangles with two equal vertices
  std::size_t unused = 0;       ///< vertices
  std::size_t open = 0;         ///< edges of one triangle
  std::size_t crowded = 0;      ///< edges of more than two triangles
  std::size_t disagreeing = 0;  ///< edges of two triangles that run the same way
  std::size_t repeated = 0;     ///< triangles on the same three vertices as an earlier one
  std::size_t loops = 0;        ///< closed curves of open edges
  long euler = 0;
};

template <typename Index>
[[nodiscard]] TriangleCensus count_triangles(std::span<const Index> triangles,
                                             std::size_t vertices);

} // namespace simdbezier::tests
