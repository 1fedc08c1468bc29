// See calls.hpp.
#include "python/src/arguments/calls.hpp"

#include <algorithm>

namespace simdbezier::python {

void Signature::refuse(const std::string& fault) const {
  throw_text(PyExc_TypeError, function_ + "(): " + fault);
}

void Signature::refuse(const py::args& given, const py::kwargs& named) const {
  std::string names;
  for (const Argument& one : arguments_) {
    names += (names.empty() ? "" : ", ") + one.name;
  }
  const std::size_t self = has_self_ ? 1 : 0;
  const std::size_t placed = given.size() - std::min(given.size(), self);
  const std::size_t most = std::min(positional_, arguments_.size());
  if (placed > most) {
    refuse("expected at most " + std::to_string(most) + " arguments without a name, found " +
           std::to_string(placed));
  }
  for (const auto& item : named) {
    const auto name = py::str(item.first).cast<std::string>();
    const auto found = std::find_if(arguments_.begin(), arguments_.end(),
                                    [&](const Argument& one) { return one.name == name; });
    if (found == arguments_.end()) {
      refuse("no argument is called '" + name + "', expected " + names);
    }
    if (found < arguments_.begin() + static_cast<std::ptrdiff_t>(placed)) {
      refuse("'" + name + "' is given twice");
    }
  }
  for (std::size_t k = placed; k < arguments_.size(); ++k) {
    if (arguments_[k].required && !named.contains(arguments_[k].name)) {
      refuse("'" + arguments_[k].name + "' is missing, expected " + names);
    }
  }
  refuse("called with another object as self");
}

} // namespace simdbezier::python
