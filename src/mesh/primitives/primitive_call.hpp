// What the calls of mesh_layout.hpp check.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include <simdbezier/mesh_layout.hpp>

#include "src/calls/call.hpp"
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

/// The patches of a layout that a call is about.
struct PatchRange {
  std::size_t first = 0;
  std::size_t count = 0;

  /// Returns false where the layout has no such patches.
  [[nodiscard]] bool resolve(const MeshLayout& layout, SetRange patches) noexcept {
    const std::size_t all = layout.data() == nullptr ? 0 : layout.data()->patches();
    return resolve_range(patches, all, first, count);
  }
};

} // namespace simdbezier::detail
