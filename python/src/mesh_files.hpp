// Meshes as files, by the writers of the command-line program.
#pragma once

#include <string>
#include <vector>

#include <simdbezier/mesh.hpp>

#include <tools/mesh_files/mesh_file.hpp>

#include "python/src/arguments/errors.hpp"

namespace simdbezier::python {

/// The format that a file's name ends in. Raises ValueError for any other name.
[[nodiscard]] tools::MeshFormat mesh_format(const std::string& path);

/// Arrays of the caller's own: contiguous, little endian, with a value or row for each vertex.
struct PointArrays {
  std::vector<tools::PointData> kinds;
  std::vector<py::array> arrays;
};
/// `point_data`, a dict or None. Raises TypeError or ValueError about it, or one of its arrays.
[[nodiscard]] PointArrays point_arrays(const py::object& point_data, std::size_t vertices,
                                       tools::MeshFormat format);

/// Raises Python's ValueError (triangle out of the mesh) or OSError (failed write). It is called
/// without the interpreter's lock.
template <typename T>
void save_mesh(const Mesh<T>& mesh, const std::string& path, tools::MeshFormat format,
               const PointArrays& data);

} // namespace simdbezier::python
