// The parts of the module, and what they share.
#pragma once

#include <string>

#include "python/src/arrays.hpp"

namespace simdbezier::python {

void add_patch_set(py::module_& module);
void add_curve_set(py::module_& module);
void add_nets(py::module_& module);
void add_mesh(py::module_& module);

/// An integer from `least` on; booleans and floats are none.
[[nodiscard]] std::size_t integer(const py::object& value, std::size_t least,
                                  const std::string& argument);

/// How sets are packed, from the keywords that patches and curves share.
[[nodiscard]] PackOptions pack_options(bool local_origin, const py::object& relative_to,
                                       int threads);

/// "degree 3", "degrees 3 x 2, rational".
[[nodiscard]] std::string plural(std::size_t count, const std::string& one,
                                 const std::string& several);

/// A row of bounds as numpy has them.
[[nodiscard]] inline py::array_t<double> bounds_of(const double* bounds, int components) {
  return py::array_t<double>(components, bounds);
}

} // namespace simdbezier::python
