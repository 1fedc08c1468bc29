// Whether control nets have the joints of a topology that was found for others.
#pragma once

#include <cstddef>
#include <span>

#include <simdbezier/control_nets.hpp>
#include <simdbezier/status.hpp>

#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {

/// Whether topologies are found of such nets: ok | null_input | bad_components | size_overflow, and
/// what check_views() returns.
template <typename S>
Status check_model(std::span<const ControlNets<S>> nets) noexcept;

/// The lowest patch with a side that is joined with another one, or counts as a point, and is not
/// in these nets; topology.patches() where there is none. The nets are sound, and have as many
/// patches.
template <typename S>
std::size_t first_misfit(const TopologyData& topology, std::span<const ControlNets<S>> nets,
                         int threads);

} // namespace simdbezier::detail
