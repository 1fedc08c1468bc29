// VTKHDF, which is HDF5 as VTK and ParaView read it, by many processes. HDF5 makes the file on one
// of them; all then write their parts of its arrays, which have their final size and place.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/mpi/rank_file.hpp>
#include <tools/mpi/shard_place.hpp>

namespace simdbezier::tools {

/// Whether the program is built with HDF5. Without it, the functions below are not there.
inline constexpr bool kHasHdf = SIMDBEZIER_HDF5 != 0;

/// Returns an upper bound of the size of the whole file.
template <typename T>
[[nodiscard]] std::uint64_t hdf_bytes(const MeshContents& whole);
/// Replaces the file by one in which only the mesh's numbers are missing. Returns where each array
/// begins. Throws Failure.
template <typename T>
[[nodiscard]] std::vector<std::uint64_t> write_hdf_head(const RankFile& file,
                                                        const MeshContents& whole);
/// A writer for a shard, see make_rank_writer().
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>>
make_hdf_shard_writer(RankFile& file, const MeshContents& whole,
                      std::span<const std::uint64_t> arrays, const MeshContents& shard,
                      const ShardPlace& place);

} // namespace simdbezier::tools
