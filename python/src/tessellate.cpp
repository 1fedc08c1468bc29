// tessellate(): a mesh of patches or of splines.
#include <algorithm>
#include <cmath>

#include <simdbezier/mesh.hpp>

#include "python/src/arguments/calls.hpp"
#include "python/src/py_splines.hpp"

namespace simdbezier::python {
namespace {

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

/// Reads degrees, infinite ones if there are none: all normals are merged then.
double crease_degrees(const py::object& crease) {
  const double degrees = positive(number_or_infinity(crease, "crease"), true, "crease");
  if (degrees > 180 && !crease.is_none()) {
    throw_value_error("crease", "expected degrees from 0 to 180, found " +
                                    py::str(crease).cast<std::string>());
  }
  return degrees;
}

std::string blamed(Status status, const MeshOptions& options, const char* weights) {
  const bool relative = std::isfinite(options.relative_tolerance);
  const bool absolute = std::isfinite(options.rates.tolerance) || !options.rates.tolerances.empty();
  switch (status.code()) {
  case Status::bad_tolerance: // all else that it is about has been checked
    return relative && absolute                                     ? "tolerance or relative"
           : relative                                               ? "relative"
           : !absolute && std::isfinite(options.rates.longest_edge) ? "longest_edge"
                                                                    : "tolerance";
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

void require_space(int components) {
  if (components != 3) {
    throw_value_error("points", "expected three components, found " + std::to_string(components) +
                                    homogeneous_hint(components));
  }
}

/// The mesh that make() makes while other threads run.
template <typename T, typename Make>
py::object made_mesh(const MeshOptions& options, const char* weights, Make make) {
  Mesh<T> mesh;
  {
    const py::gil_scoped_release release;
    mesh = make();
  }
  const std::string argument = blamed(mesh.report.status, options, weights);
  if (!mesh && mesh.report.item > 0) {
    throw_value_error(argument, std::string(to_string(mesh.report.status)) + " (patch " +
                                    std::to_string(mesh.report.item) + ")");
  }
  require_ok(mesh.report.status, argument);
  return mesh_object(std::move(mesh));
}

template <typename T, typename S>
py::object tessellated(const PointViews<S, ControlNets>& nets, const GivenTolerance& tolerance,
                       const MeshOptions& options) {
  std::size_t patches = 0;
  for (const ControlNets<S>& view : nets.views) {
    patches += view.count;
  }
  tolerance.require_count(patches, "patches");
  require_space(nets.views.front().components);
  return made_mesh<T>(options, nets.weights_argument(), [&] {
    return simdbezier::tessellate<T>(std::span<const ControlNets<S>>(nets.views), options);
  });
}

/// Splines, all of them in S.
template <typename T, typename S>
py::object tessellated(const std::vector<const GivenSpline*>& splines,
                       const GivenTolerance& tolerance, const MeshOptions& options) {
  std::vector<py::array> arrays;
  std::vector<SplineSurface<S>> surfaces;
  std::size_t patches = 0;
  for (const GivenSpline* const one : splines) {
    const char* const dtype = std::is_same_v<S, float> ? "float32" : "float64";
    arrays.emplace_back(one->points.array.attr("astype")(dtype, py::arg("copy") = false));
    surfaces.push_back(one->surface<S>(arrays.back()));
    patches += span_count(surfaces.back()).patches();
    require_space(one->points.components);
  }
  tolerance.require_count(patches, "patches");
  Report report;
  const auto make = [&] {
    Mesh<T> mesh =
        simdbezier::tessellate<T>(std::span<const SplineSurface<S>>(surfaces), options, &report);
    mesh.report.status = report ? mesh.report.status : Status(Status::ok); // reported below
    return mesh;
  };
  py::object mesh = made_mesh<T>(options, "points", make);
  require_points(report, *splines[report.item],
                 splines.size() == 1 ? "points" : "points[" + std::to_string(report.item) + "]");
  return mesh;
}

/// The splines that an argument is, or is a list of; none where it is something else.
std::vector<const GivenSpline*> given_splines(const py::object& points) {
  std::vector<const GivenSpline*> splines;
  if (const GivenSpline* const one = spline_surface_of(points)) {
    return {one};
  }
  if (is_spline_curve(points)) {
    throw_type_error("points", "expected surfaces, found a SplineCurve, which evaluate() samples");
  }
  if (!py::isinstance<py::list>(points) && !py::isinstance<py::tuple>(points)) {
    return splines;
  }
  std::size_t others = 0;
  for (const py::handle one : points) {
    const GivenSpline* const spline = spline_surface_of(one);
    spline == nullptr ? ++others : (splines.push_back(spline), others);
  }
  if (!splines.empty() && others > 0) {
    throw_type_error("points", "expected splines alone, or none");
  }
  return splines;
}

py::object tessellate_points(const py::object& points, const py::object& tolerance,
                             const py::object& weights, const py::object& relative,
                             const py::object& grid, const py::object& crease,
                             const py::object& normals, const py::object& parameters,
                             const py::object& orient, const py::object& flip,
                             const py::object& snap, const py::object& split_edges,
                             const py::object& point_size, const py::object& drop_repeated,
                             const py::object& longest_edge, const py::object& thorough,
                             const py::object& dtype, const py::object& threads,
                             const py::object& homogeneous) {
  const std::vector<const GivenSpline*> splines = given_splines(points);
  if (!splines.empty() && (!weights.is_none() || flag(homogeneous, "homogeneous"))) {
    throw_value_error(weights.is_none() ? "homogeneous" : "weights",
                      "expected none beside splines, which have their own");
  }
  AnyPointViews<ControlNets> any;
  if (splines.empty()) {
    any = control_nets({points, weights, homogeneous});
  }
  MeshOptions options;
  const GivenTolerance tolerances(tolerance);
  options.rates.tolerance = tolerances.all;
  options.rates.tolerances = span_of(tolerances.each);
  options.relative_tolerance =
      positive(number_or_infinity(relative, "relative"), false, "relative");
  set_grid(grid, options);
  options.crease_degrees = crease_degrees(crease);
  options.rates.longest_edge =
      positive(number_or_infinity(longest_edge, "longest_edge"), false, "longest_edge");
  options.rates.thorough = flag(thorough, "thorough");
  options.normals = flag(normals, "normals");
  options.parameters = flag(parameters, "parameters");
  options.topology.orient = flag(orient, "orient");
  options.topology.flip = flag(flip, "flip");
  options.topology.snap = positive(number(snap, "snap"), true, "snap");
  options.split_edges = flag(split_edges, "split_edges");
  options.topology.point_size = positive(number(point_size, "point_size"), true, "point_size");
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
  if (options.rates.thorough && tolerance.is_none() && relative.is_none()) {
    throw_value_error("thorough", "expected with tolerance or relative, found without");
  }
  if (!splines.empty()) {
    const auto all = [&](const auto& is) { return std::ranges::all_of(splines, is); };
    const bool points_are_float = all([](auto* one) { return one->points_are_float(); });
    const bool is_float = wants_float(dtype, all([](auto* one) { return one->results_are_float; }));
    if (points_are_float) {
      return is_float ? tessellated<float, float>(splines, tolerances, options)
                      : tessellated<double, float>(splines, tolerances, options);
    }
    return is_float ? tessellated<float, double>(splines, tolerances, options)
                    : tessellated<double, double>(splines, tolerances, options);
  }
  const bool is_float = wants_float(dtype, any.index() == 0);
  return std::visit(
      [&](const auto& nets) {
        return is_float ? tessellated<float>(nets, tolerances, options)
                        : tessellated<double>(nets, tolerances, options);
      },
      any);
}

} // namespace

void add_tessellate(py::module_& module) {
  define(module, "tessellate", &tessellate_points, py::arg("points"),
         py::arg("tolerance") = py::none(), py::arg("weights") = py::none(), py::kw_only(),
         py::arg("relative") = py::none(), py::arg("grid") = py::none(),
         py::arg("crease") = py::none(), py::arg("normals") = true, py::arg("parameters") = false,
         py::arg("orient") = false, py::arg("flip") = false, py::arg("snap") = 0.0,
         py::arg("split_edges") = false, py::arg("point_size") = 0.0,
         py::arg("drop_repeated") = false, py::arg("longest_edge") = py::none(),
         py::arg("thorough") = false, py::arg("dtype") = py::none(), py::arg("threads") = 0,
         py::arg("homogeneous") = false,
         "A closed mesh of all patches, or of a SplineSurface or several, within a tolerance of "
         "their surface.");
}

} // namespace simdbezier::python
