// Numbers the vertices of a mesh of given rates.
#pragma once

#include "src/mesh/layout/mesh_data.hpp"

namespace simdbezier::detail {

/// Whether a mesh, which may be none, has these patches; a range to the end gets its count.
bool has_range(const MeshData* mesh, SetRange& patches) noexcept;

/// One value a patch, each 1 to kMostSegments.
bool are_rates(const Topology& topology, std::span<const std::uint32_t> rates) noexcept;

/// Fills a layout for rates that are_rates() accepts: ok | size_overflow.
Status build_layout(const Topology& topology, const PatchRates& rates, MeshData& mesh,
                    int threads = 1);

/// Numbers the vertices of a layout whose segments are known. corner_groups: of each corner of a
/// patch the lowest one that it shares a vertex with. side_vertices, where edges are split, hold
/// the number of a side's group at each point, and then its vertex; one thread numbers these.
/// Returns ok | size_overflow.
Status number_vertices(std::span<const std::uint32_t> corner_groups, MeshData& mesh,
                       int threads = 1);

} // namespace simdbezier::detail
