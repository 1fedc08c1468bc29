// Mesh: the mesh's own memory as numpy's arrays, and mesh files.
#include <memory>

#include <simdbezier/mesh.hpp>

#include <tools/mesh_files/mesh_file.hpp>

#include "python/src/arguments/calls.hpp"
#include "python/src/mesh_files.hpp"
#include "python/src/module.hpp"

namespace simdbezier::python {
namespace {

class PyMesh : public EmptyUntilConstructed {
public:
  template <typename T>
  explicit PyMesh(Mesh<T>&& mesh) : mesh_(std::move(mesh)) {}

  template <typename Ask>
  [[nodiscard]] auto ask(Ask question) const {
    return std::visit(question, mesh_);
  }

  void save(const py::object& path, const py::object& point_data) const {
    const auto os = py::module_::import("os");
    if (!py::isinstance<py::str>(path) && !py::isinstance<py::bytes>(path) &&
        !py::isinstance(path, os.attr("PathLike"))) {
      throw_type_error("path", "expected a str, bytes or os.PathLike object, found " +
                                   py::repr(path).cast<std::string>());
    }
    const std::string name = os.attr("fsencode")(path).cast<py::bytes>();
    if (name.find('\0') != std::string::npos) {
      throw_value_error("path", "has a null character in it");
    }
    const tools::MeshFormat format = mesh_format(name);
    const std::size_t vertices = ask([](const auto& mesh) { return mesh.positions.size(); });
    const PointArrays data = point_arrays(point_data, vertices, format);
    const py::gil_scoped_release release;
    ask([&](const auto& mesh) { save_mesh(mesh, name, format, data); });
  }

  [[nodiscard]] std::string text() const {
    return ask([]<typename T>(const Mesh<T>& mesh) {
      char deviation[32];
      std::snprintf(deviation, sizeof deviation, "%.3g", mesh.deviation);
      return "<simdbezier.Mesh: " + plural(mesh.positions.size(), "vertex", "vertices") + ", " +
             plural(mesh.triangles.size(), "triangle", "triangles") + ", within " + deviation +
             " of the surface, " + scalar_name<T>() + ">";
    });
  }

private:
  std::variant<Mesh<float>, Mesh<double>> mesh_;
};

/// A view of a mesh's vector, which keeps the mesh.
template <typename V, std::size_t N>
py::object rows(const std::vector<std::array<V, N>>& values, const py::object& mesh) {
  return py::array_t<V>({static_cast<py::ssize_t>(values.size()), static_cast<py::ssize_t>(N)},
                        values.empty() ? nullptr : values.front().data(), mesh);
}

/// A view of a mesh's vector, or None where the mesh has none.
template <typename V, std::size_t N>
py::object rows_or_none(const std::vector<std::array<V, N>>& values, const py::object& mesh) {
  return values.empty() ? py::object(py::none()) : rows(values, mesh);
}

/// Makes a property of PyMesh, which is what read(mesh, self) returns.
template <typename Read>
auto property(Read read) {
  return [read](const py::object& self) -> py::object {
    return self.cast<const PyMesh&>().ask(
        [&](const auto& mesh) -> py::object { return read(mesh, self); });
  };
}

} // namespace

py::object mesh_object(AnyMesh mesh) {
  return std::visit([](auto& of) { return py::cast(PyMesh(std::move(of))); }, mesh);
}

void add_mesh(py::module_& module) {
  py::class_<PyMesh> type(module, "Mesh",
                          "A closed mesh of triangles. Its arrays are its own memory.");
  type.def("__repr__", &PyMesh::text)
      .def_property_readonly("positions", property([](const auto& mesh, const py::object& self) {
                               return rows(mesh.positions, self);
                             }),
                             "(vertices, 3)")
      .def_property_readonly("normals", property([](const auto& mesh, const py::object& self) {
                               return rows_or_none(mesh.normals, self);
                             }),
                             "(vertices, 3), or None")
      .def_property_readonly("parameters", property([](const auto& mesh, const py::object& self) {
                               return rows_or_none(mesh.parameters, self);
                             }),
                             "u, v of every vertex on its patch: (vertices, 2), or None")
      .def_property_readonly(
          "patches", property([](const auto& mesh, const py::object& self) -> py::object {
            if (mesh.patches.empty()) {
              return py::none();
            }
            return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(mesh.patches.size()),
                                              mesh.patches.data(), self);
          }),
          "The patch of every vertex: (vertices,), or None")
      .def_property_readonly("triangles", property([](const auto& mesh, const py::object& self) {
                               return rows(mesh.triangles, self);
                             }),
                             "(triangles, 3), counter-clockwise about the normals")
      .def_property_readonly("deviation", property([](const auto& mesh, const py::object&) {
                               return py::float_(mesh.deviation);
                             }),
                             "The mesh is certified to be this close to the surface.")
      .def_property_readonly("deviations", property([](const auto& mesh, const py::object& self) {
                               return py::array_t<double>(
                                   static_cast<py::ssize_t>(mesh.deviations.size()),
                                   mesh.deviations.data(), self);
                             }),
                             "The same for single patches: (patches,)")
      .def_property_readonly("split_edges", property([](const auto& mesh, const py::object&) {
                               return py::int_(mesh.splits.splits);
                             }),
                             "How many edges patches were cut for (split_edges=True).")
      .def_property_readonly("unjoined_edges", property([](const auto& mesh, const py::object&) {
                               return py::int_(mesh.splits.unjoined);
                             }),
                             "How many edges along parts of others stayed open.")
      .def_property_readonly("largest_gap", property([](const auto& mesh, const py::object&) {
                               return py::float_(mesh.splits.largest_gap);
                             }),
                             "At least the largest distance of one of these from that part.");
  define(type, "save", &PyMesh::save, py::arg("path"), py::arg("point_data") = py::none(),
         ("Writes a file of the format that its name ends in: " + tools::mesh_format_names(".") +
          ". point_data: a dict of arrays (vertices,) or (vertices, k) to be written as well (" +
          tools::mesh_format_names(".", &tools::MeshAbilities::point_data) + ").")
             .c_str());
  add_tessellate(module);
}

} // namespace simdbezier::python
