// What the module's PatchSet and CurveSet share: packing, and evaluation into numpy's arrays.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <simdbezier/bounds.hpp>
#include <simdbezier/curves.hpp>
#include <simdbezier/evaluate.hpp>
#include <simdbezier/options.hpp>

#include "python/src/arguments/calls.hpp"
#include "python/src/arguments/wanted_outputs.hpp"
#include "python/src/module.hpp"

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

// Kinds of sets, which say of theirs:
//   Set<T>, Out<T>               the set and its outputs in the library
//   kIndex, kSeveral             the argument that names one of its elements, and several of them
//   kNeeds                       the components that not all outputs do without, in words
//   names()                      the outputs
//   has(name, components)        whether an output exists for points of so many components
//   set_values(out, arrays)      adds the outputs of one number a sample
//   kCertified, bounds(of)       the outputs that error_bounds() certifies, and their bounds

struct Patches {
  template <typename T>
  using Set = PatchSet<T>;
  template <typename T>
  using Out = Outputs<T>;
  static constexpr const char* kIndex = "patch";
  static constexpr const char* kSeveral = "patches";
  static constexpr const char* kNeeds = "three components";

  static const OutputNames& names() {
    static const OutputNames all{output_names<Output, kVectorOutputs>(),
                                 output_names<Curvature, kCurvatureKinds>()};
    return all;
  }
  static bool has(const std::string& name, int components) {
    Output output = names().is_value(name) ? Output::curvature : Output::status;
    for (std::size_t k = 0; k < kVectorOutputs; ++k) {
      output = name == names().vectors[k] ? static_cast<Output>(k) : output;
    }
    return components == 3 || !needs_space(output);
  }
  template <typename T>
  static void set_values(Outputs<T>& to, const OutputArrays<T>& arrays) {
    for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
      const auto curvature = static_cast<Curvature>(k);
      to.curvature[curvature] = arrays.values(output_name(curvature));
    }
  }
  static constexpr std::array kCertified = {"position", "du", "dv"};
  static std::array<const double*, 3> bounds(const ErrorBounds& of) {
    return {of.position, of.du, of.dv};
  }
};

struct Curves {
  template <typename T>
  using Set = CurveSet<T>;
  template <typename T>
  using Out = CurveOutputs<T>;
  static constexpr const char* kIndex = "curve";
  static constexpr const char* kSeveral = "curves";
  static constexpr const char* kNeeds = "two or three components";

  static const OutputNames& names() {
    static const OutputNames all{output_names<CurveOutput, kCurveVectorOutputs>(), {"curvature"}};
    return all;
  }
  static bool has(const std::string& name, int components) {
    return components == 2 || components == 3 || (name != "tangent" && name != "curvature");
  }
  template <typename T>
  static void set_values(CurveOutputs<T>& to, const OutputArrays<T>& arrays) {
    to.curvature = arrays.values("curvature");
  }
  static constexpr std::array kCertified = {"position", "d1", "d2"};
  static std::array<const double*, 3> bounds(const CurveErrorBounds& of) {
    return {of.position, of.d1, of.d2};
  }
};

/// Outputs of a call in numpy's arrays, which evaluate(to, options) computes for three components
/// after three others. samples: the dimensions of results in front of the components.
template <typename Kind, typename T, typename Evaluate>
py::dict evaluate_outputs(int components, const std::vector<py::ssize_t>& samples,
                          const py::object& outputs, const py::object& out,
                          const NamedArrays& inputs, const py::object& threads, Evaluate evaluate) {
  using Out = typename Kind::template Out<T>;
  const OutputNames& known = Kind::names();
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
  const Status status = evaluate_by_threes<Out>(known, arrays, components, [&](Out& to) {
    Kind::set_values(to, arrays);
    const py::gil_scoped_release release;
    return evaluate(to, options);
  });
  require_ok(status, status == Status::bad_patch_index ? Kind::kIndex : "out");
  return arrays.result();
}

/// A set of floats or doubles.
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

  /// Certified bounds of one element, or for None of all: a dict of arrays (components,), or
  /// (elements, components).
  [[nodiscard]] py::dict error_bounds(const py::object& element) const {
    const bool all = element.is_none();
    const std::size_t first = all ? 0 : index_of(element);
    const std::size_t count = all ? size() : 1;
    const auto width = static_cast<std::size_t>(components());
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(width)};
    if (all) {
      shape.insert(shape.begin(), static_cast<py::ssize_t>(count));
    }
    py::dict result;
    std::array<double*, Kind::kCertified.size()> to{};
    for (std::size_t k = 0; k < to.size(); ++k) {
      py::array_t<double> array(shape);
      to[k] = array.mutable_data();
      result[Kind::kCertified[k]] = array;
    }
    const auto certify = [&](const auto& set) {
      const py::gil_scoped_release release;
      for (std::size_t index = first; index < first + count; ++index) {
        const auto found = simdbezier::error_bounds(set, index);
        for (std::size_t k = 0; k < to.size(); ++k) {
          to[k] = std::copy_n(Kind::bounds(found)[k], width, to[k]);
        }
      }
    };
    std::visit(certify, set_);
    return result;
  }

protected:
  explicit PySet(std::variant<Set<float>, Set<double>>&& set) : set_(std::move(set)) {}
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

  /// The number of an element that is part of the set.
  [[nodiscard]] std::size_t index_of(const py::object& element) const {
    return element_of(size(), element, Kind::kIndex, plural(size(), Kind::kIndex, Kind::kSeveral));
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
    return evaluate_outputs<Kind, T>(set.components(), samples, outputs, out, inputs, threads,
                                     [&](const auto& to, const Options& options) {
                                       return simdbezier::evaluate(set, where, to, options);
                                     });
  }

  std::variant<Set<float>, Set<double>> set_;

private:
  template <typename T, typename Views>
  void pack_as(const Views& points, const PackOptions& options) {
    Set<T> packed;
    Report report;
    {
      const py::gil_scoped_release release;
      report = pack(packable(points), packed, options);
    }
    require_ok(report, points.weights_argument(), "relative_to");
    set_ = std::move(packed);
  }
};

} // namespace simdbezier::python
