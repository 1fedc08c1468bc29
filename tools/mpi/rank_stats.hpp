// What ranks say that they have done.
#pragma once

#include <cstdint>

#include <tools/commands/arguments.hpp>
#include <tools/commands/meshes/mesh_stats.hpp>
#include <tools/mpi/ranks.hpp>

namespace simdbezier::tools {

/// Collective. The first rank prints what all ranks together have done, and each of them, where
/// that is asked for. written: bytes of this rank.
void print_rank_stats(const Ranks& ranks, const Arguments& arguments, MeshStats stats,
                      std::uint64_t written);

} // namespace simdbezier::tools
