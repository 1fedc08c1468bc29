// Meshes as files, by the writers of the command-line program.
#pragma once

#include <string>

#include <simdbezier/mesh.hpp>

namespace simdbezier::python {

/// Throws py::value_error where the name's ending is no format's, and OSError where writing fails.
template <typename T>
void save_mesh(const Mesh<T>& mesh, const std::string& path);

} // namespace simdbezier::python
