// Parts of meshes as the command line asks for them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <tools/commands/arguments.hpp>
#include <tools/commands/meshes/mesh_stats.hpp>
#include <tools/parts/model_part.hpp>
#include <tools/parts/patch_source.hpp>

namespace simdbezier::tools {

/// Opens the input, or reads it where it cannot be read piece by piece.
[[nodiscard]] std::unique_ptr<PatchSource> open_source(const Arguments& arguments);

/// The same with points that count from the origin that is asked for, which is written to the
/// arguments and the statistics.
[[nodiscard]] std::unique_ptr<PatchSource> open_moved_source(Arguments& arguments,
                                                             MeshStats& stats);

/// Lets the file's points count from the origin that is asked for, and the camera's place as well.
void move_to_origin(PatchFile& patches, MeshArguments& mesh, MeshStats& stats);

/// Throws Failure that begins with `option` where there are fewer patches than shards.
void expect_shards(const PatchSource& source, std::size_t shards, const char* option);

/// Returns some of a model's patches, with ghosts where the mesh is to have no gaps.
template <typename T>
[[nodiscard]] ModelPart find_part(const PatchSource& source, const Arguments& arguments,
                                  SetRange own);

/// Throws Failure where the cells of a patch would depend on what storing does to other patches.
template <typename T>
void expect_exact_storage(const PatchSource& source, const Arguments& arguments,
                          const char* option);

/// Returns what parts of one mesh have in common: it tells apart models, options, instruction sets
/// with different results, and programs.
[[nodiscard]] std::string part_fingerprint(const PatchSource& source, const Arguments& arguments);

} // namespace simdbezier::tools
