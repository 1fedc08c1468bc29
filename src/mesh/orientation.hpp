// Which way round patches are.
#pragma once

#include <simdbezier/status.hpp>

#include "src/mesh/topology_data.hpp"

namespace simdbezier::detail {

/// Counts edges along which normals disagree, finds whether turning patches can mend that, and
/// marks those to be turned where that is asked for: ok | not_orientable.
Status orient(bool turn, TopologyData& topology);

} // namespace simdbezier::detail
