// What the module's PatchSet and CurveSet share: packing, and evaluation into numpy's arrays.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <simdbezier/options.hpp>

#include "python/src/calls.hpp"
#include "python/src/module.hpp"
#include "python/src/wanted_outputs.hpp"

namespace simdbezier::python {

/// Points as pack() takes them: all nets, or the one view of curves that there is.
template <typename S>
[[nodiscard]] std::span<const ControlNets<S>> packable(const PointViews<S, ControlNets>& points) {
  return points.views;
}
template <typename S>
[[nodiscard]] const ControlCurves<S>& packable(const PointViews<S, ControlCurves>& points) {
  return points.views.front();
}

/// A set of floats or doubles. Kind says what it is a set of:
///   Set<T>, Out<T>               the set and its outputs in the library
///   kIndex                       the argument that names one of its elements
///   kNeeds                       the components that not all outputs do without, in words
///   names()                      the outputs
///   has(name, components)        whether an output exists for points of so many components
///   set_values(out, arrays)      adds the outputs of one number a sample
template <typename Kind>
class PySet : public EmptyUntilConstructed {
public:
  template <typename T>
  using Set = typename Kind::template Set<T>;

  [[nodiscard]] std::size_t size() const {
    return std::visit([](const auto& set) { return set.size(); }, set_);
  }
  [[nodiscard]] int components() const {
    return std::visit([](const auto& set) { return set.components(); }, set_);
  }
  [[nodiscard]] py::dtype dtype() const {
    return set_.index() == 0 ? py::dtype::of<float>() : py::dtype::of<double>();
  }

protected:
  template <template <typename> class View>
  PySet(const AnyPointViews<View>& points, const py::object& dtype, const py::object& local_origin,
        const py::object& relative_to, const py::object& threads) {
    const PackOptions options = pack_options(local_origin, relative_to, threads);
    const bool is_float = wants_float(dtype, points.index() == 0);
    std::visit(
        [&](const auto& views) {
          is_float ? pack_as<float>(views, options) : pack_as<double>(views, options);
        },
        points);
  }

  /// How many components points have, and of what type they are, for a text about the set.
  [[nodiscard]] std::string type_text() const {
    return plural(static_cast<std::size_t>(components()), "component", "components") + ", " +
           py::str(py::object(dtype())).cast<std::string>();
  }

  /// Evaluates where `where` says. samples: the dimensions of results in front of the components.
  template <typename T, typename Where>
  static py::dict evaluate_at(const Set<T>& set, const Where& where,
                              const std::vector<py::ssize_t>& samples, const py::object& outputs,
                              const py::object& out, const NamedArrays& inputs,
                              const py::object& threads) {
    using Out = typename Kind::template Out<T>;
    const OutputNames& known = Kind::names();
    const int components = set.components();
    const std::vector<std::string> wanted = wanted_outputs(known, outputs, out);
    for (const std::string& name : wanted) {
      if (!Kind::has(name, components)) {
        throw_value_error("outputs", "'" + name + "' needs " + Kind::kNeeds + ", the set has " +
                                         std::to_string(components) + homogeneous_hint(components));
      }
    }
    const OutputArrays<T> arrays(known, wanted, out, samples, components, inputs);
    Options options;
    options.threads = thread_count(threads);
    const auto evaluate = [&](Out& to) {
      Kind::set_values(to, arrays);
      const py::gil_scoped_release release;
      return simdbezier::evaluate(set, where, to, options);
    };
    const Status status = evaluate_by_threes<Out>(known, arrays, components, evaluate);
    require_ok(status, status == Status::bad_patch_index ? Kind::kIndex : "out");
    return arrays.result();
  }

  std::variant<Set<float>, Set<double>> set_;

private:
  template <typename T, typename Views>
  void pack_as(const Views& points, const PackOptions& options) {
    Set<T> packed;
    PackReport report;
    {
      const py::gil_scoped_release release;
      report = pack(packable(points), packed, options);
    }
    require_ok(report, points.weights_argument(), "relative_to");
    set_ = std::move(packed);
  }
};

} // namespace simdbezier::python
