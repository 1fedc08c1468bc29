// See mesh_files.hpp.
#include "python/src/mesh_files.hpp"

#include <algorithm>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/failure.hpp>

#include "python/src/arguments/arrays.hpp"
#include "python/src/module.hpp"

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
tools::MeshContents contents_of(const Mesh<T>& mesh, const PointArrays& data) {
  tools::MeshContents contents;
  contents.vertices = mesh.positions.size();
  contents.faces = mesh.triangles.size();
  contents.normals = !mesh.normals.empty();
  contents.uv = !mesh.parameters.empty();
  contents.patches = mesh.patches.empty() ? 0 : mesh.deviations.size();
  contents.box = box_of(mesh);
  contents.deviation = mesh.deviation;
  contents.generator = "simdbezier";
  contents.data = data.kinds;
  return contents;
}

/// What is written at a time.
template <typename T>
struct Block {
  std::vector<T> values;
  std::vector<std::byte> data;
};

/// Vertices [first, last) as writers take them.
template <typename T>
void write_vertices(const Mesh<T>& mesh, const PointArrays& data, std::size_t first,
                    std::size_t last, Block<T>& block, tools::MeshWriter<T>& writer) {
  std::vector<T>& values = block.values;
  values.clear();
  block.data.clear();
  for (std::size_t k = first; k < last; ++k) {
    values.insert(values.end(), mesh.positions[k].begin(), mesh.positions[k].end());
    if (!mesh.normals.empty()) {
      values.insert(values.end(), mesh.normals[k].begin(), mesh.normals[k].end());
    }
    if (!mesh.parameters.empty()) {
      values.insert(values.end(), mesh.parameters[k].begin(), mesh.parameters[k].end());
    }
    for (std::size_t a = 0; a < data.arrays.size(); ++a) {
      const std::size_t bytes = data.kinds[a].type.bytes * data.kinds[a].components;
      const auto* const row = static_cast<const std::byte*>(data.arrays[a].data()) + k * bytes;
      block.data.insert(block.data.end(), row, row + bytes);
    }
  }
  const std::span<const std::uint32_t> patches =
      mesh.patches.empty() ? std::span<const std::uint32_t>()
                           : std::span(mesh.patches).subspan(first, last - first);
  writer.vertices({values, patches, block.data});
}

std::string text_of(const py::handle& object) { return py::repr(object).cast<std::string>(); }

/// The name of an array in a file, which text can have everywhere.
std::string array_name(const py::handle& key, const std::string& argument) {
  if (!py::isinstance<py::str>(key)) {
    throw_type_error("point_data", "expected names that are strings, found " + text_of(key));
  }
  if (py::len(key) == 0 || !key.attr("isprintable")().cast<bool>()) {
    throw_value_error(argument, "expected a name of printable characters");
  }
  const auto name = key.cast<std::string>();
  for (const char* const own : {"Normals", "TCoords", "patch"}) {
    if (name == own) {
      throw_value_error(argument, "expected a name that is not one of the mesh's own arrays");
    }
  }
  return name;
}

tools::NumberType number_type_of(const py::array& array, const std::string& argument) {
  const char kind = array.dtype().kind();
  const auto bytes = static_cast<std::size_t>(array.itemsize());
  const bool is_float = kind == 'f' && (bytes == sizeof(float) || bytes == sizeof(double));
  if (!is_float && kind != 'i' && kind != 'u') {
    throw_type_error(argument, "expected float32, float64 or integers, found " + dtype_name(array));
  }
  const std::string name = is_float ? "Float" : kind == 'i' ? "Int" : "UInt";
  return {name + std::to_string(8 * bytes), bytes};
}

[[noreturn]] void throw_os_error(const std::string& message) {
  const py::gil_scoped_acquire acquire;
  throw_text(PyExc_OSError, message);
}

} // namespace

tools::MeshFormat mesh_format(const std::string& path) {
  const auto format = tools::mesh_format_of(path);
  if (!format) {
    const bool text_form = path.size() >= 5 && path.substr(path.size() - 5) == ".gltf";
    throw_value_error("path", "expected a name that ends in " + tools::mesh_format_names(".") +
                                  ", found '" + path + "'" +
                                  (text_form ? "; .glb is glTF in one file" : ""));
  }
  return *format;
}

PointArrays point_arrays(const py::object& point_data, std::size_t vertices,
                         tools::MeshFormat format) {
  PointArrays data;
  if (point_data.is_none()) {
    return data;
  }
  if (!py::isinstance<py::dict>(point_data)) {
    throw_type_error("point_data", "expected a dict of arrays, found " + text_of(point_data));
  }
  if (!tools::mesh_abilities(format).point_data) {
    throw_value_error("point_data",
                      "expected a file in " +
                          tools::mesh_format_names("", &tools::MeshAbilities::point_data) +
                          ", found " + tools::mesh_format_name(format));
  }
  const auto contiguous_array = py::module_::import("numpy").attr("ascontiguousarray");
  for (const auto& [key, values] : py::reinterpret_borrow<py::dict>(point_data)) {
    const std::string argument = "point_data[" + text_of(key) + "]";
    const std::string name = array_name(key, argument);
    const py::array array = any_array(py::reinterpret_borrow<py::object>(values), argument);
    const tools::NumberType type = number_type_of(array, argument);
    const bool rows = array.ndim() == 2 && array.shape(1) > 0;
    if ((array.ndim() != 1 && !rows) || array.shape(0) != static_cast<py::ssize_t>(vertices)) {
      throw_value_error(argument, "expected a value or row for each of " +
                                      plural(vertices, "vertex", "vertices") + ", found shape " +
                                      shape_text(array));
    }
    data.kinds.push_back({name, type, rows ? static_cast<std::size_t>(array.shape(1)) : 1});
    data.arrays.push_back(contiguous_array(array, array.dtype().attr("newbyteorder")("<")));
  }
  return data;
}

template <typename T>
void save_mesh(const Mesh<T>& mesh, const std::string& path, tools::MeshFormat format,
               const PointArrays& data) {
  const auto& triangles = mesh.triangles;
  const auto is_outside = [&](const auto& triangle) {
    return std::max({triangle[0], triangle[1], triangle[2]}) >= mesh.positions.size();
  };
  if (std::any_of(triangles.begin(), triangles.end(), is_outside)) { // they may be written to
    const py::gil_scoped_acquire acquire;
    throw_value_error("triangles", "has the number of a vertex that is not there");
  }
  try {
    const auto writer = tools::make_mesh_writer<T>(path, format, contents_of(mesh, data));
    Block<T> block;
    for (std::size_t first = 0; first < mesh.positions.size(); first += kBlock) {
      write_vertices(mesh, data, first, std::min(first + kBlock, mesh.positions.size()), block,
                     *writer);
    }
    if (!mesh.triangles.empty()) {
      writer->faces({mesh.triangles.front().data(), 3 * mesh.triangles.size()});
    }
    writer->finish();
  } catch (const tools::Failure& failure) {
    throw_os_error(failure.what());
  }
}

template void save_mesh(const Mesh<float>&, const std::string&, tools::MeshFormat,
                        const PointArrays&);
template void save_mesh(const Mesh<double>&, const std::string&, tools::MeshFormat,
                        const PointArrays&);

} // namespace simdbezier::python
