// See mesh_files.hpp.
#include "python/src/mesh_files.hpp"

#include <algorithm>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/failure.hpp>

#include "python/src/errors.hpp"

namespace simdbezier::python {
namespace {

constexpr std::size_t kBlock = 4096;

template <typename T>
tools::MeshBox box_of(const Mesh<T>& mesh) {
  tools::MeshBox box;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto less = [c](const auto& a, const auto& b) { return a[c] < b[c]; };
    const auto [low, high] =
        std::minmax_element(mesh.positions.begin(), mesh.positions.end(), less);
    box.low[c] = mesh.positions.empty() ? 0 : static_cast<double>((*low)[c]);
    box.high[c] = mesh.positions.empty() ? 0 : static_cast<double>((*high)[c]);
  }
  return box;
}

template <typename T>
tools::MeshContents contents_of(const Mesh<T>& mesh) {
  tools::MeshContents contents;
  contents.vertices = mesh.positions.size();
  contents.faces = mesh.triangles.size();
  contents.normals = !mesh.normals.empty();
  contents.uv = !mesh.parameters.empty();
  contents.patches = mesh.patches.empty() ? 0 : mesh.deviations.size();
  contents.box = box_of(mesh);
  contents.deviation = mesh.deviation;
  contents.generator = "simdbezier";
  return contents;
}

/// Vertices [first, last) as writers take them.
template <typename T>
void write_vertices(const Mesh<T>& mesh, std::size_t first, std::size_t last,
                    std::vector<T>& values, tools::MeshWriter<T>& writer) {
  values.clear();
  for (std::size_t k = first; k < last; ++k) {
    values.insert(values.end(), mesh.positions[k].begin(), mesh.positions[k].end());
    if (!mesh.normals.empty()) {
      values.insert(values.end(), mesh.normals[k].begin(), mesh.normals[k].end());
    }
    if (!mesh.parameters.empty()) {
      values.insert(values.end(), mesh.parameters[k].begin(), mesh.parameters[k].end());
    }
  }
  const std::span<const std::uint32_t> patches =
      mesh.patches.empty() ? std::span<const std::uint32_t>()
                           : std::span(mesh.patches).subspan(first, last - first);
  writer.vertices({values, patches});
}

[[noreturn]] void throw_os_error(const std::string& message) {
  const py::gil_scoped_acquire acquire;
  throw_text(PyExc_OSError, message);
}

} // namespace

template <typename T>
void save_mesh(const Mesh<T>& mesh, const std::string& path) {
  const auto format = tools::mesh_format_of(path);
  if (!format) {
    const py::gil_scoped_acquire acquire;
    const bool text_form = path.size() >= 5 && path.substr(path.size() - 5) == ".gltf";
    throw_value_error("path", "expected a name that ends in " + tools::mesh_format_names(".") +
                                  ", found '" + path + "'" +
                                  (text_form ? "; .glb is glTF in one file" : ""));
  }
  const auto& triangles = mesh.triangles;
  const auto is_outside = [&](const auto& triangle) {
    return std::max({triangle[0], triangle[1], triangle[2]}) >= mesh.positions.size();
  };
  if (std::any_of(triangles.begin(), triangles.end(), is_outside)) { // they may be written to
    const py::gil_scoped_acquire acquire;
    throw_value_error("triangles", "has the number of a vertex that is not there");
  }
  try {
    const auto writer = tools::make_mesh_writer<T>(path, *format, contents_of(mesh));
    std::vector<T> values;
    for (std::size_t first = 0; first < mesh.positions.size(); first += kBlock) {
      write_vertices(mesh, first, std::min(first + kBlock, mesh.positions.size()), values, *writer);
    }
    if (!mesh.triangles.empty()) {
      writer->faces({mesh.triangles.front().data(), 3 * mesh.triangles.size()});
    }
    writer->finish();
  } catch (const tools::Failure& failure) {
    throw_os_error(failure.what());
  }
}

template void save_mesh(const Mesh<float>&, const std::string&);
template void save_mesh(const Mesh<double>&, const std::string&);

} // namespace simdbezier::python
