// Finds which patches' normals agree.
#pragma once

#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {

/// Counts edges along which normals disagree, and turns patches where that is asked for:
/// ok | not_orientable.
Status orient(const TopologyOptions& options, int threads, TopologyData& topology);

/// Marks corners and sides whose normals still disagree with those of the first patch there. Edges
/// of more than two sides are taken as they are: no rule says which of their sides belong together.
void mark_apart(TopologyData& topology);

} // namespace simdbezier::detail
