// From rates to the numbers of vertices.
#pragma once

#include "src/mesh/mesh_data.hpp"

namespace simdbezier::detail {

/// One value a patch, each 1 to kMostSegments.
bool are_rates(const Topology& topology, std::span<const std::uint32_t> rates) noexcept;

/// Fills a layout for rates that are: ok | size_overflow.
Status build_layout(const Topology& topology, const PatchRates& rates, MeshData& mesh);

} // namespace simdbezier::detail
