// See call_arguments.hpp.
#include "python/src/arguments/call_arguments.hpp"

#include <cmath>
#include <limits>

namespace simdbezier::python {
namespace {

std::string text_of(const py::object& value) { return py::repr(value).cast<std::string>(); }

/// Goes on where an object refused to be a number. What else its own code throws is the caller's.
void clear_refusal() {
  for (PyObject* const refusal : {PyExc_TypeError, PyExc_ValueError, PyExc_OverflowError}) {
    if (PyErr_ExceptionMatches(refusal) != 0) {
      PyErr_Clear();
      return;
    }
  }
  throw py::error_already_set();
}

/// What is larger or smaller than a signed index is clipped.
py::ssize_t index_of(const py::object& value, const std::string& argument) {
  if (!py::isinstance<py::bool_>(value) && PyIndex_Check(value.ptr()) != 0) {
    const py::ssize_t number = PyNumber_AsSsize_t(value.ptr(), nullptr);
    if (number != -1 || PyErr_Occurred() == nullptr) {
      return number;
    }
    clear_refusal(); // arrays say whether they are integers only when they are asked for it
  }
  throw_type_error(argument, "expected an integer, found " + text_of(value));
}

} // namespace

std::size_t integer(const py::object& value, std::size_t least, const std::string& argument) {
  const py::ssize_t number = index_of(value, argument);
  if (number < static_cast<py::ssize_t>(least)) {
    throw_value_error(argument, "expected " + std::to_string(least) + " or more, found " +
                                    py::str(value).cast<std::string>());
  }
  return static_cast<std::size_t>(number);
}

std::size_t element_of(std::size_t size, const py::object& value, const std::string& argument,
                       const std::string& size_text) {
  const py::ssize_t number = index_of(value, argument);
  if (number < 0 || static_cast<std::size_t>(number) >= size) {
    throw_index_error(argument, "the set has " + size_text + ", found number " +
                                    py::str(value).cast<std::string>());
  }
  return static_cast<std::size_t>(number);
}

std::size_t sequence_index(std::size_t size, const py::object& value, const std::string& argument,
                           const std::string& size_text) {
  const py::ssize_t number = index_of(value, argument);
  const auto end = static_cast<py::ssize_t>(size);
  if (number < -end || number >= end) {
    throw_index_error(argument, "there are " + size_text + ", found number " +
                                    py::str(value).cast<std::string>());
  }
  return static_cast<std::size_t>(number < 0 ? number + end : number);
}

double number(const py::object& value, const char* argument) {
  const double found = PyFloat_AsDouble(value.ptr());
  if (found == -1.0 && PyErr_Occurred() != nullptr) {
    clear_refusal();
    throw_type_error(argument, "expected a number, found " + text_of(value));
  }
  return found;
}

double number_or_infinity(const py::object& value, const char* argument) {
  if (value.is_none()) {
    return std::numeric_limits<double>::infinity();
  }
  const double found = number(value, argument);
  require_finite(found, std::numeric_limits<double>::max(), argument);
  return found;
}

void require_finite(double value, double most, const char* argument) {
  if (!(std::fabs(value) <= most)) {
    throw_value_error(argument, "expected a finite number, found " +
                                    py::str(py::float_(value)).cast<std::string>());
  }
}

double positive(double value, bool or_zero, const char* argument) {
  if (!(value > 0 || (or_zero && value == 0))) {
    throw_value_error(argument, std::string("expected a number ") +
                                    (or_zero ? "of 0 or more" : "above 0") + ", found " +
                                    py::str(py::float_(value)).cast<std::string>());
  }
  return value;
}

bool flag(const py::object& value, const char* argument) {
  try {
    return value.cast<bool>();
  } catch (const py::cast_error&) {
    throw_type_error(argument, "expected True or False, found " + text_of(value));
  }
}

int thread_count(const py::object& value) {
  const py::ssize_t count = index_of(value, "threads");
  if (count > std::numeric_limits<int>::max()) {
    throw_value_error("threads", "expected at most " +
                                     std::to_string(std::numeric_limits<int>::max()) + ", found " +
                                     py::str(value).cast<std::string>());
  }
  return count < 0 ? 0 : static_cast<int>(count);
}

} // namespace simdbezier::python
