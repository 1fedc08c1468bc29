// Writers of the meshes of shards into their places in one file.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/mpi/rank_file.hpp>

namespace simdbezier::tools {

/// What a shard has to know of the whole file.
struct ShardPlace {
  std::uint64_t first_vertex = 0;
  std::uint64_t first_face = 0;
  std::uint64_t quads_before = 0; ///< among_quads of all shards before
};

/// Returns whether several processes can write one file of the format.
[[nodiscard]] bool is_written_by_ranks(MeshFormat format);
/// Returns the size of the whole file.
template <typename T>
[[nodiscard]] std::uint64_t ranked_bytes(MeshFormat format, const MeshContents& whole);
/// Writes what stands before all vertices; the deviation of `whole` is the one to be stated.
template <typename T>
void write_head(RankFile& file, MeshFormat format, const MeshContents& whole);

/// A writer for a shard, whose contents `shard` are. Faces have the whole mesh's numbers, but for
/// STL, in which they have the shard's, behind which `foreign` are: values of further vertices.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>>
make_rank_writer(RankFile& file, MeshFormat format, const MeshContents& whole,
                 const MeshContents& shard, const ShardPlace& place, std::span<const T> foreign);

} // namespace simdbezier::tools
