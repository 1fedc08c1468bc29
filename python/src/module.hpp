// The parts of the module, and what they share.
#pragma once

#include <cstring>
#include <new>
#include <string>
#include <variant>

#include <simdbezier/curves.hpp>
#include <simdbezier/mesh.hpp>
#include <simdbezier/patch_set.hpp>

#include "python/src/arguments/arrays.hpp"
#include "python/src/arguments/call_arguments.hpp"

namespace simdbezier::python {

void add_patch_set(py::module_& module);
void add_curve_set(py::module_& module);
void add_polylines(py::module_& module);
void add_nets(py::module_& module);
void add_mesh(py::module_& module);
void add_tessellate(py::module_& module);
void add_spline_surface(py::module_& module);
void add_spline_curve(py::module_& module);

using AnyPatchSet = std::variant<PatchSet<float>, PatchSet<double>>;
using AnyCurveSet = std::variant<CurveSet<float>, CurveSet<double>>;
using AnyMesh = std::variant<Mesh<float>, Mesh<double>>;
/// Python's objects of sets and meshes that are there.
[[nodiscard]] py::object patch_set_object(AnyPatchSet set);
[[nodiscard]] py::object curve_set_object(AnyCurveSet set);
[[nodiscard]] py::object mesh_object(AnyMesh mesh);

/// How sets are packed, from the keywords that patches and curves share.
[[nodiscard]] PackOptions pack_options(const py::object& local_origin,
                                       const py::object& relative_to, const py::object& threads);

/// A base of what the module's objects hold. Python code that calls __new__ and not __init__ makes
/// objects for which pybind11 takes memory without constructing anything in it; bytes of 0 are a
/// set or mesh that is empty.
struct EmptyUntilConstructed {
  static void* operator new(std::size_t bytes) {
    return std::memset(::operator new(bytes), 0, bytes);
  }
  static void operator delete(void* memory) noexcept { ::operator delete(memory); }
};

/// Joins a count and its noun in the right number: "1 patch", "2 patches".
[[nodiscard]] std::string plural(std::size_t count, const std::string& one,
                                 const std::string& several);

} // namespace simdbezier::python
