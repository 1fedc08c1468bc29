// Meshes that the program makes of models, read back.
#pragma once

#include <string>
#include <vector>

#include "tests/mesh/support/mesh_models.hpp"
#include "tests/mesh/support/triangle_census.hpp"
#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests {

/// A model as a .bez file.
[[nodiscard]] std::string bez_of(const MeshModel& model);

/// The bytes of the file that tessellate writes, without a word on either stream.
[[nodiscard]] std::string tessellated(const std::string& in, const std::string& extension,
                                      const std::vector<std::string>& options = {},
                                      const Circumstances& circumstances = {});

/// Returns the mesh that tessellate writes, read back from a PLY file.
[[nodiscard]] ReadMesh welded(const std::string& in, const std::vector<std::string>& options = {});

/// The census of a mesh of triangles.
[[nodiscard]] TriangleCensus census_of(const ReadMesh& mesh);

} // namespace simdbezier::tests
