// What the calls of mesh_layout.hpp check.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include <simdbezier/mesh_layout.hpp>

#include "src/mesh/layout/layout_builder.hpp"
#include "src/mesh/layout/mesh_data.hpp"

namespace simdbezier::detail {

/// Whether numbers of vertices fit `indices`.
template <typename Index>
Status check_indices(const MeshLayout& layout, std::span<const Index> indices,
                     std::size_t needed) noexcept {
  if (layout.size().vertices > std::numeric_limits<Index>::max()) {
    return Status::size_overflow;
  }
  if (needed > 0 && indices.data() == nullptr) {
    return Status::null_output;
  }
  return indices.size() < needed ? Status::output_too_small : Status::ok;
}

} // namespace simdbezier::detail
