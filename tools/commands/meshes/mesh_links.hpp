// Which vertices the mesh of a part shares with other parts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>
#include <tools/parts/model_part.hpp>
#include <tools/parts/part_links.hpp>

namespace simdbezier::tools {

struct MeshLinks {
  PartLinks links;
  /// Numbers of the vertices before the own ones: those that own patches have count on behind the
  /// own ones, others have kNoVertex.
  std::vector<std::uint32_t> before;
};

/// own, numbers, lent: see ModelPart.
[[nodiscard]] MeshLinks find_mesh_links(const MeshLayout& layout, SetRange own,
                                        std::span<const std::uint32_t> numbers,
                                        std::span<const ModelPart::Lent> lent);

} // namespace simdbezier::tools
