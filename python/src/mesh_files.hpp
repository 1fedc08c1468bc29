// Meshes as files, by the writers of the command-line program.
#pragma once

#include <string>

#include <simdbezier/mesh.hpp>

namespace simdbezier::python {

/// Raises Python's ValueError (unknown ending, triangle out of the mesh) or OSError (failed write).
template <typename T>
void save_mesh(const Mesh<T>& mesh, const std::string& path);

} // namespace simdbezier::python
