// What joins the mesh of a part with those of other parts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>

namespace simdbezier::tools {

/// A vertex that an earlier part owns: that of an edge or a corner of a patch, which has several
/// where normals or parameters differ.
struct ForeignVertex {
  std::uint32_t patch = 0;  ///< its number in the model
  std::uint32_t slot = 0;   ///< 0 to 3: PatchVertices::corners, 4 to 7: PatchVertices::edges
  std::uint32_t offset = 0; ///< from the first vertex there
};

/// Where the vertices of an own patch begin, from the first one of the part. There are many of them
/// in memory at a time, so that numbers are as narrow as those of faces.
struct LentVertices {
  std::uint32_t patch = 0;                  ///< its number in the model
  std::array<std::uint32_t, 8> begins = {}; ///< by slot; kNoVertex: the patch does not own them
};

struct PartLinks {
  std::vector<ForeignVertex> foreign; ///< in the order of their numbers behind the own vertices
  std::vector<LentVertices> lent;     ///< ascending
};

} // namespace simdbezier::tools
