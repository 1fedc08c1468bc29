// Single numbers and switches that functions are called with. What is no such thing is a TypeError,
// and what is out of range a ValueError, whose text begins with the argument's name.
#pragma once

#include <string>

#include "python/src/arguments/errors.hpp"

namespace simdbezier::python {

/// An integer from `least` on, those beyond what an index holds as the largest one; booleans and
/// floats are none.
[[nodiscard]] std::size_t integer(const py::object& value, std::size_t least,
                                  const std::string& argument);

/// The number of a patch or curve of a set of `size`, or an index error that says `size_text`.
[[nodiscard]] std::size_t element_of(std::size_t size, const py::object& value,
                                     const std::string& argument, const std::string& size_text);

/// The same of a sequence, where -1 is the last element.
[[nodiscard]] std::size_t sequence_index(std::size_t size, const py::object& value,
                                         const std::string& argument, const std::string& size_text);

[[nodiscard]] double number(const py::object& value, const char* argument);
/// A finite number, or infinity for None.
[[nodiscard]] double number_or_infinity(const py::object& value, const char* argument);
/// Throws where a number is not finite, or above `most` in magnitude.
void require_finite(double value, double most, const char* argument);
/// `value`, which has to be above 0, or may be 0 as well; infinity is above.
double positive(double value, bool or_zero, const char* argument);

[[nodiscard]] bool flag(const py::object& value, const char* argument);
/// `threads`, as Options have it.
[[nodiscard]] int thread_count(const py::object& value);

} // namespace simdbezier::python
