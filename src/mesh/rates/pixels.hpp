// Tolerances from what a camera sees.
#pragma once

#include <span>

#include <simdbezier/rates.hpp>

namespace simdbezier::detail {

/// pixel_tolerances() of patches some of which are turned in a mesh: Camera::skip_back goes by the
/// normals that the mesh has. topology: of these nets, or an empty one if no patch is turned.
template <typename S>
Status view_tolerances(std::span<const ControlNets<S>> nets, const Topology& topology,
                       const Camera& camera, double pixels, std::span<double> out,
                       const RunOptions& options) noexcept;

} // namespace simdbezier::detail
