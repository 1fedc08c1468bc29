// simdbezier-mpi tessellate.
#pragma once

#include <tools/commands/arguments.hpp>
#include <tools/mpi/ranks.hpp>

namespace simdbezier::tools {

/// Collective. Throws Failure on all ranks.
void run_mpi_tessellate(Ranks& ranks, const Arguments& arguments);

} // namespace simdbezier::tools
