// tessellate() and Mesh: the mesh's own memory as numpy's arrays, and mesh files.
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <simdbezier/mesh.hpp>

#include <tools/mesh_files/mesh_file.hpp>

#include "python/src/calls.hpp"
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

/// Reads one tolerance, or one a patch.
void set_tolerance(const py::object& tolerance, py::array_t<double>& several,
                   MeshOptions& options) {
  if (has_dimensions(tolerance)) { // one a patch
    several = parameters<double>(tolerance, "tolerance");
    options.tolerances = span_of(several);
  } else {
    options.tolerance = positive(number_or_infinity(tolerance, "tolerance"), false, "tolerance");
  }
}

/// Reads n or (nu, nv) samples.
void set_grid(const py::object& grid, MeshOptions& options) {
  if (grid.is_none()) {
    return;
  }
  const bool pair = py::isinstance<py::sequence>(grid);
  if (pair && py::len(grid) != 2) {
    throw_value_error("grid", "expected one number, or two");
  }
  const auto samples = [&](int k) {
    const py::object value = pair ? py::object(grid[py::int_(k)]) : grid;
    const std::size_t count = integer(value, 2, "grid");
    if (count > kMostSegments + 1) {
      throw_value_error("grid", "expected at most " + std::to_string(kMostSegments + 1) +
                                    ", found " + std::to_string(count));
    }
    return static_cast<std::uint32_t>(count);
  };
  options.nu = samples(0);
  options.nv = samples(1);
}

/// Reads degrees; all normals are merged without them.
double crease_angle(const py::object& crease) {
  const double degrees = positive(number_or_infinity(crease, "crease"), true, "crease");
  if (degrees > 180 && !crease.is_none()) {
    throw_value_error("crease", "expected degrees from 0 to 180, found " +
                                    py::str(crease).cast<std::string>());
  }
  return degrees * std::numbers::pi / 180;
}

std::string blamed(Status status, const MeshOptions& options, const char* weights) {
  const bool relative = std::isfinite(options.relative_tolerance);
  const bool absolute = std::isfinite(options.tolerance) || !options.tolerances.empty();
  switch (status.code()) {
  case Status::bad_tolerance: // all else that it is about has been checked
    return relative && absolute ? "tolerance or relative" : relative ? "relative" : "tolerance";
  case Status::bad_grid:
    return "grid";
  case Status::snap_too_large:
    return "snap";
  case Status::not_orientable:
    return "orient";
  case Status::bad_weight:
    return weights;
  default:
    return "points";
  }
}

template <typename T, typename S>
PyMesh tessellated(const PointViews<S, ControlNets>& nets, const MeshOptions& options) {
  std::size_t patches = 0;
  for (const ControlNets<S>& view : nets.views) {
    patches += view.count;
  }
  if (!options.tolerances.empty() && options.tolerances.size() != patches) {
    throw_value_error("tolerance", "expected a number, or one for each of " +
                                       std::to_string(patches) + " patches, found " +
                                       std::to_string(options.tolerances.size()));
  }
  if (nets.views.front().components != 3) {
    const int found = nets.views.front().components;
    throw_value_error("points", "expected three components, found " + std::to_string(found) +
                                    homogeneous_hint(found));
  }
  Mesh<T> mesh;
  {
    const py::gil_scoped_release release;
    mesh = simdbezier::tessellate<T>(std::span<const ControlNets<S>>(nets.views), options);
  }
  const std::string argument = blamed(mesh.status, options, nets.weights_argument());
  if (!mesh && mesh.fault_patch > 0) {
    throw_value_error(argument, std::string(to_string(mesh.status)) + " (patch " +
                                    std::to_string(mesh.fault_patch) + ")");
  }
  require_ok(mesh.status, argument);
  return PyMesh(std::move(mesh));
}

PyMesh tessellate_points(const py::object& points, const py::object& tolerance,
                         const py::object& weights, const py::object& relative,
                         const py::object& grid, const py::object& crease,
                         const py::object& normals, const py::object& parameters,
                         const py::object& orient, const py::object& flip, const py::object& snap,
                         const py::object& split_edges, const py::object& point_size,
                         const py::object& drop_repeated, const py::object& longest_edge,
                         const py::object& dtype, const py::object& threads,
                         const py::object& homogeneous) {
  const AnyPointViews<ControlNets> any = control_nets({points, weights, homogeneous});
  MeshOptions options;
  py::array_t<double> tolerances;
  set_tolerance(tolerance, tolerances, options);
  options.relative_tolerance =
      positive(number_or_infinity(relative, "relative"), false, "relative");
  set_grid(grid, options);
  options.crease_angle = crease_angle(crease);
  options.longest_edge =
      positive(number_or_infinity(longest_edge, "longest_edge"), false, "longest_edge");
  options.normals = flag(normals, "normals");
  options.parameters = flag(parameters, "parameters");
  options.orient = flag(orient, "orient");
  options.flip = flag(flip, "flip");
  options.snap = positive(number(snap, "snap"), true, "snap");
  options.split_edges = flag(split_edges, "split_edges");
  options.point_size = positive(number(point_size, "point_size"), true, "point_size");
  options.drop_repeated = flag(drop_repeated, "drop_repeated");
  options.threads = thread_count(threads);
  const bool measured = !tolerance.is_none() || !relative.is_none() || !longest_edge.is_none();
  if (!measured && grid.is_none()) {
    throw_type_error("tolerance", "how fine the mesh is has to be said by tolerance, relative, "
                                  "longest_edge or grid");
  }
  if (!grid.is_none() && measured) {
    throw_value_error("grid", "expected without tolerance, relative and longest_edge");
  }
  const bool is_float = wants_float(dtype, any.index() == 0);
  return std::visit(
      [&](const auto& nets) {
        return is_float ? tessellated<float>(nets, options) : tessellated<double>(nets, options);
      },
      any);
}

} // namespace

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
                             "The same for single patches: (patches,)");
  define(type, "save", &PyMesh::save, py::arg("path"), py::arg("point_data") = py::none(),
         ("Writes a file of the format that its name ends in: " + tools::mesh_format_names(".") +
          ". point_data: a dict of arrays (vertices,) or (vertices, k) to be written as well (" +
          tools::mesh_format_names(".", &tools::MeshAbilities::point_data) + ").")
             .c_str());
  define(module, "tessellate", &tessellate_points, py::arg("points"),
         py::arg("tolerance") = py::none(), py::arg("weights") = py::none(), py::kw_only(),
         py::arg("relative") = py::none(), py::arg("grid") = py::none(),
         py::arg("crease") = py::none(), py::arg("normals") = true, py::arg("parameters") = false,
         py::arg("orient") = false, py::arg("flip") = false, py::arg("snap") = 0.0,
         py::arg("split_edges") = false, py::arg("point_size") = 0.0,
         py::arg("drop_repeated") = false, py::arg("longest_edge") = py::none(),
         py::arg("dtype") = py::none(), py::arg("threads") = 0, py::arg("homogeneous") = false,
         "A closed mesh of all patches, within a tolerance of their surface.");
}

} // namespace simdbezier::python
