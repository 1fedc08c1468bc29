// Statuses as Python's exceptions, whose text begins with the argument at fault.
#pragma once

#include <string>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <simdbezier/patch_set.hpp>
#include <simdbezier/status.hpp>

namespace simdbezier::python {

namespace py = pybind11;

/// Bytes that are no UTF-8, which names of files may have, are escaped in texts of all errors.
[[noreturn]] void throw_text(PyObject* type, const std::string& text);
[[noreturn]] void throw_value_error(const std::string& argument, const std::string& fault);
[[noreturn]] void throw_type_error(const std::string& argument, const std::string& fault);
/// An index outside of a set: an IndexError that is a ValueError as well.
[[noreturn]] void throw_index_error(const std::string& argument, const std::string& fault);

/// Throws where the status is not ok: MemoryError, or ValueError about the argument.
void require_ok(Status status, const std::string& argument);
/// Throws where the report is not ok, and names the control point at fault, or `parameter` where
/// none is. weights: the argument that weights came with.
void require_ok(const Report& report, const std::string& weights, const std::string& parameter);

/// Makes the exception that throw_index_error() throws part of the module.
void add_errors(py::module_& module);

} // namespace simdbezier::python
