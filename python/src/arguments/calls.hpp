// Functions that say in one line what is wrong with how they are called. pybind11 would print all
// arguments, arrays among them.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "python/src/arguments/errors.hpp"

namespace simdbezier::python {

/// The arguments that a function takes, self not among them.
class Signature {
public:
  template <typename... Extra>
  explicit Signature(std::string function, bool has_self, const Extra&... extra)
      : function_(std::move(function)), has_self_(has_self) {
    (note(extra), ...);
  }
  /// Throws a TypeError about arguments that do not fit.
  [[noreturn]] void refuse(const py::args& given, const py::kwargs& named) const;

private:
  struct Argument {
    std::string name;
    bool required;
  };
  [[noreturn]] void refuse(const std::string& fault) const;
  void note(const py::arg& one) { arguments_.push_back({one.name, true}); }
  void note(const py::arg_v& one) { arguments_.push_back({one.name, false}); }
  void note(const py::kw_only&) { positional_ = arguments_.size(); }
  void note(const char*) {} // the description

  std::string function_;
  bool has_self_;
  std::vector<Argument> arguments_;
  std::size_t positional_ = static_cast<std::size_t>(-1); ///< at most so many without a name
};

/// As scope.def(), and a second overload for all calls that do not fit the first one.
template <typename Scope, typename Function, typename... Extra>
Scope& define(Scope& scope, const char* name, Function function, const Extra&... extra) {
  constexpr bool kMethod = !std::is_same_v<Scope, py::module_>;
  const std::string owner =
      kMethod ? py::str(scope.attr("__name__")).cast<std::string>() + "." : "";
  const Signature signature(owner + name, kMethod, extra...);
  scope.def(name, function, extra...);
  scope.def(name, [signature](const py::args& given, const py::kwargs& named) {
    signature.refuse(given, named);
  });
  return scope;
}

/// The same for a constructor that takes so many objects.
template <typename Type, typename... Objects, typename... Extra>
void define_constructor(py::class_<Type>& scope, const Extra&... extra) {
  const Signature signature(py::str(scope.attr("__name__")).cast<std::string>(), false, extra...);
  scope.def(py::init<Objects...>(), extra...);
  scope.def(py::init([signature](const py::args& given, const py::kwargs& named)
                         -> std::unique_ptr<Type> { signature.refuse(given, named); }));
}

} // namespace simdbezier::python
