// Whether control nets have the joints of a topology that was found for others.
#pragma once

#include <cstddef>
#include <span>

#include <simdbezier/control_nets.hpp>

#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {

/// The lowest patch with a side that is joined with another one, or counts as a point, and is not
/// in these nets; topology.patches() where there is none. The nets are sound, and have as many
/// patches.
template <typename S>
std::size_t first_misfit(const TopologyData& topology, std::span<const ControlNets<S>> nets,
                         int threads);

} // namespace simdbezier::detail
