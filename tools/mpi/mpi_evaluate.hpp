// simdbezier-mpi evaluate: values at samples, as CSV.
#pragma once

#include <tools/commands/arguments.hpp>
#include <tools/mpi/ranks.hpp>

namespace simdbezier::tools {

/// Collective. Writes the bytes of run_evaluate(). Throws Failure, the same on all ranks.
void run_mpi_evaluate(Ranks& ranks, const Arguments& arguments);

} // namespace simdbezier::tools
