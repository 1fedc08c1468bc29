// See errors.hpp.
#include "python/src/arguments/errors.hpp"

namespace simdbezier::python {
namespace {

/// Lives as long as the interpreter.
PyObject* index_error = nullptr;

[[noreturn]] void throw_error(PyObject* type, const std::string& argument,
                              const std::string& fault) {
  throw_text(type, argument + ": " + fault);
}

} // namespace

void throw_text(PyObject* type, const std::string& text) {
  const auto message = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
  if (message) {
    PyErr_SetObject(type, message.ptr());
  }
  throw py::error_already_set();
}

void throw_value_error(const std::string& argument, const std::string& fault) {
  throw_error(PyExc_ValueError, argument, fault);
}

void throw_type_error(const std::string& argument, const std::string& fault) {
  throw_error(PyExc_TypeError, argument, fault);
}

void throw_index_error(const std::string& argument, const std::string& fault) {
  throw_error(index_error, argument, fault);
}

void require_ok(Status status, const std::string& argument) {
  if (status) {
    return;
  }
  const std::string text(to_string(status));
  switch (status.code()) {
  case Status::out_of_memory:
  case Status::size_overflow:
    throw_error(PyExc_MemoryError, argument, text);
  case Status::bad_patch_index:
  case Status::bad_patch_range:
    throw_index_error(argument, text);
  case Status::unknown_isa:
  case Status::unsupported_isa:
    throw_error(PyExc_RuntimeError, "SIMDBEZIER_ISA", text);
  default:
    throw_value_error(argument, text);
  }
}

void require_ok(const Report& report, const std::string& weights, const std::string& parameter) {
  if (report) {
    return;
  }
  switch (report.status.code()) {
  case Status::non_finite_input:
  case Status::coefficient_overflow:
    if (report.point < 0) {
      require_ok(report.status, parameter);
    }
    throw_value_error("points", std::string(to_string(report.status)) + " (patch " +
                                    std::to_string(report.item) + ", point " +
                                    std::to_string(report.point) + ", component " +
                                    std::to_string(report.component) + ")");
  case Status::bad_weight:
    throw_value_error(weights, std::string(to_string(report.status)) + " (patch " +
                                   std::to_string(report.item) + ", point " +
                                   std::to_string(report.point) + ")");
  default:
    require_ok(report.status, "points");
  }
}

void add_errors(py::module_& module) {
  const py::tuple bases =
      py::make_tuple(py::handle(PyExc_IndexError), py::handle(PyExc_ValueError));
  index_error = PyErr_NewExceptionWithDoc("simdbezier.PatchIndexError",
                                          "A patch or curve outside of a set was named.",
                                          bases.ptr(), nullptr);
  if (index_error == nullptr) {
    throw py::error_already_set();
  }
  module.add_object("PatchIndexError", py::reinterpret_borrow<py::object>(index_error));
}

} // namespace simdbezier::python
