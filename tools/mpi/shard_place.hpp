// Where a shard stands in the mesh of all.
#pragma once

#include <cstdint>

namespace simdbezier::tools {

/// What a shard has to know of the whole file.
struct ShardPlace {
  std::uint64_t first_vertex = 0;
  std::uint64_t first_face = 0;
  std::uint64_t quads_before = 0; ///< among_quads of all shards before
};

} // namespace simdbezier::tools
