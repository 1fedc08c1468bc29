// Writers of the meshes of shards into their places in one file.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/mpi/rank_file.hpp>
#include <tools/mpi/shard_place.hpp>

namespace simdbezier::tools {

/// Returns whether several processes can write one file of the format.
[[nodiscard]] bool is_written_by_ranks(MeshFormat format);
/// Returns the names of those, for messages.
[[nodiscard]] std::string formats_of_ranks();
/// Returns the size of the whole file, or an upper bound.
template <typename T>
[[nodiscard]] std::uint64_t ranked_bytes(MeshFormat format, const MeshContents& whole);
/// Writes, on one rank and before all others, what is not the mesh's numbers; the deviation of
/// `whole` is the one to be stated. Returns where arrays begin, in formats in which a library
/// decides that.
template <typename T>
[[nodiscard]] std::vector<std::uint64_t> write_head(RankFile& file, MeshFormat format,
                                                    const MeshContents& whole);

/// A writer for a shard, whose contents `shard` are. arrays: what write_head() has returned. Faces
/// have the whole mesh's numbers, but for STL, in which they have the shard's, behind which
/// `foreign` are: values of further vertices.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>>
make_rank_writer(RankFile& file, MeshFormat format, const MeshContents& whole,
                 std::span<const std::uint64_t> arrays, const MeshContents& shard,
                 const ShardPlace& place, std::span<const T> foreign);

} // namespace simdbezier::tools
