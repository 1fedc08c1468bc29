// The module simdbezier._core: python/simdbezier/__init__.py makes the package of it.
#include "python/src/module.hpp"

#include <pybind11/stl.h>

#include <simdbezier/options.hpp>
#include <simdbezier/version.hpp>

namespace simdbezier::python {

PackOptions pack_options(const py::object& local_origin, const py::object& relative_to,
                         const py::object& threads) {
  PackOptions options;
  options.local_origin = flag(local_origin, "local_origin");
  options.threads = thread_count(threads);
  if (!relative_to.is_none()) {
    const py::array any = float_array(relative_to, 1, "relative_to");
    const auto point = contiguous<double>(any, "relative_to");
    if (point.size() < 1 || point.size() > 3) {
      throw_value_error("relative_to", "expected 1 to 3 numbers");
    }
    std::copy_n(point.data(), point.size(), options.relative_to);
  }
  return options;
}

std::string plural(std::size_t count, const std::string& one, const std::string& several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

namespace {

std::vector<std::string> isa_names() {
  std::vector<std::string> names;
  for (const Isa isa : available_isas()) {
    names.emplace_back(to_string(isa));
  }
  return names;
}

std::string version() {
  return std::to_string(SIMDBEZIER_VERSION_MAJOR) + "." + std::to_string(SIMDBEZIER_VERSION_MINOR) +
         "." + std::to_string(SIMDBEZIER_VERSION_PATCH);
}

} // namespace
} // namespace simdbezier::python

PYBIND11_MODULE(_core, module) {
  using namespace simdbezier::python;
  py::options options;
  options.disable_function_signatures(); // the stubs have them
  module.attr("__version__") = version();
  module.def("available_isas", &isa_names,
             "Names of the instruction sets that this machine can run, narrowest first.");
  add_errors(module);
  add_patch_set(module);
  add_curve_set(module);
  add_polylines(module);
  add_nets(module);
  add_mesh(module);
  add_spline_surface(module);
  add_spline_curve(module);
}
