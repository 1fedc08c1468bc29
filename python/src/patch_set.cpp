// PatchSet: packed patches, evaluated into numpy's arrays.
#include <cmath>

#include <simdbezier/evaluate.hpp>

#include "python/src/derivatives.hpp"
#include "python/src/py_set.hpp"

namespace simdbezier::python {
namespace {

class PyPatchSet : public PySet<Patches> {
public:
  PyPatchSet(const py::object& points, const py::object& weights, const py::object& dtype,
             const py::object& local_origin, const py::object& relative_to,
             const py::object& threads, const py::object& homogeneous)
      : PySet(control_nets({points, weights, homogeneous}), dtype, local_origin, relative_to,
              threads) {}
  explicit PyPatchSet(AnyPatchSet&& set) : PySet(std::move(set)) {}

  [[nodiscard]] PatchShape shape(const py::object& patch) const {
    const std::size_t index = index_of(patch);
    return std::visit([&](const auto& set) { return set.shape(index); }, set_);
  }

  [[nodiscard]] py::dict evaluate_grid(const py::object& nu, const py::object& nv,
                                       const py::object& outputs, const py::object& out,
                                       const py::object& threads) const {
    return std::visit(
        [&]<typename T>(const PatchSet<T>& set) {
          const GivenGrid<T> given(set, nu, nv);
          return evaluate_at(set, given.grid(), given.shape(), outputs, out, given.inputs(),
                             threads);
        },
        set_);
  }
  [[nodiscard]] py::dict evaluate_grid_derivatives(const py::object& nu, const py::object& nv,
                                                   const py::object& derivatives,
                                                   const py::object& out,
                                                   const py::object& threads) const {
    return std::visit(
        [&]<typename T>(const PatchSet<T>& set) {
          const GivenGrid<T> given(set, nu, nv);
          return evaluate_derivatives_at(set, given.grid(), wanted_pairs(derivatives, out),
                                         given.shape(), out, given.inputs(), threads);
        },
        set_);
  }

  [[nodiscard]] py::dict evaluate(const py::object& patch, const py::object& u, const py::object& v,
                                  const py::object& outputs, const py::object& out,
                                  const py::object& threads) const {
    return std::visit(
        [&]<typename T>(const PatchSet<T>& set) {
          const GivenSamples<T> given(patch, u, v);
          return evaluate_at(set, given.samples(), given.shape(), outputs, out, given.inputs(),
                             threads);
        },
        set_);
  }
  [[nodiscard]] py::dict evaluate_derivatives(const py::object& patch, const py::object& u,
                                              const py::object& v, const py::object& derivatives,
                                              const py::object& out,
                                              const py::object& threads) const {
    return std::visit(
        [&]<typename T>(const PatchSet<T>& set) {
          const GivenSamples<T> given(patch, u, v);
          return evaluate_derivatives_at(set, given.samples(), wanted_pairs(derivatives, out),
                                         given.shape(), out, given.inputs(), threads);
        },
        set_);
  }

  [[nodiscard]] std::string text() const {
    const std::size_t count = size();
    std::string degrees;
    if (count > 0) {
      const PatchShape first = shape(py::int_(0));
      bool same = true;
      for (std::size_t k = 1; same && k < count; ++k) {
        same = shape(py::int_(k)) == first;
      }
      degrees = same ? " of degree " + std::to_string(first.degree_u) + " x " +
                           std::to_string(first.degree_v) + (first.rational ? ", rational" : "")
                     : " of several shapes";
    }
    return "<simdbezier.PatchSet: " + plural(count, "patch", "patches") + degrees + ", " +
           type_text() + ">";
  }

private:
  /// A number of uniform parameters, or an array of any.
  template <typename T>
  struct GridSide {
    std::size_t count = 0;
    py::array_t<T> given; ///< empty where they are uniform

    GridSide(const py::object& side, const char* argument) {
      if (!has_dimensions(side)) {
        count = integer(side, 2, argument);
        return;
      }
      given = parameters<T>(side, argument);
      count = static_cast<std::size_t>(given.size());
      if (count == 0) {
        throw_value_error(argument, "expected one parameter or more, found none");
      }
      for (const T parameter : span_of(given)) {
        if (!std::isfinite(parameter)) {
          throw_value_error(argument, "expected finite parameters, found " +
                                          py::str(py::float_(parameter)).cast<std::string>());
        }
      }
    }
    [[nodiscard]] const T* first() const { return given.size() > 0 ? given.data() : nullptr; }
    void add_to(NamedArrays& inputs, const char* argument) const {
      if (given.size() > 0) {
        inputs.push_back({argument, given});
      }
    }
  };

  /// A grid as a call is given it.
  template <typename T>
  struct GivenGrid {
    GridSide<T> columns;
    GridSide<T> rows;
    std::size_t patches;

    GivenGrid(const PatchSet<T>& set, const py::object& nu, const py::object& nv)
        : columns(nu, "nu"), rows(nv, "nv"), patches(set.size()) {
      require_addressable(sample_count(set, grid()), set.components(), "nu or nv");
    }
    [[nodiscard]] Grid<T> grid() const {
      return {columns.count, rows.count, columns.first(), rows.first()};
    }
    [[nodiscard]] std::vector<py::ssize_t> shape() const {
      return {static_cast<py::ssize_t>(patches), static_cast<py::ssize_t>(rows.count),
              static_cast<py::ssize_t>(columns.count)};
    }
    [[nodiscard]] NamedArrays inputs() const {
      NamedArrays all;
      columns.add_to(all, "nu");
      rows.add_to(all, "nv");
      return all;
    }
  };

  /// Single samples as a call is given them.
  template <typename T>
  struct GivenSamples {
    py::array_t<T> us;
    py::array_t<T> vs;
    py::array_t<std::uint32_t> patches;

    GivenSamples(const py::object& patch, const py::object& u, const py::object& v)
        : us(parameters<T>(u, "u")), vs(parameters<T>(v, "v")),
          patches(indices(patch, static_cast<std::size_t>(us.size()), "patch")) {
      require_length("v", vs.size(), us.size());
      require_length("patch", patches.size(), us.size());
    }
    [[nodiscard]] Samples<T> samples() const {
      return {span_of(patches), span_of(us), span_of(vs)};
    }
    [[nodiscard]] std::vector<py::ssize_t> shape() const { return {us.size()}; }
    [[nodiscard]] NamedArrays inputs() const { return {{"patch", patches}, {"u", us}, {"v", vs}}; }
  };

  static void require_length(const std::string& argument, py::ssize_t found, py::ssize_t expected) {
    if (found != expected) {
      throw_value_error(argument, "expected " + std::to_string(expected) +
                                      " values, as many as u, found " + std::to_string(found));
    }
  }
};

} // namespace

py::object patch_set_object(AnyPatchSet set) { return py::cast(PyPatchSet(std::move(set))); }

void add_patch_set(py::module_& module) {
  const py::tuple position = py::make_tuple("position");
  py::class_<PyPatchSet> type(module, "PatchSet",
                              "Bezier patches, packed to be evaluated many times. Immutable.");
  using Object = const py::object&;
  define_constructor<PyPatchSet, Object, Object, Object, Object, Object, Object, Object>(
      type, py::arg("points"), py::arg("weights") = py::none(), py::arg("dtype") = py::none(),
      py::kw_only(), py::arg("local_origin") = false, py::arg("relative_to") = py::none(),
      py::arg("threads") = 0, py::arg("homogeneous") = false);
  type.def("__len__", &PyPatchSet::size)
      .def("__repr__", &PyPatchSet::text)
      .def_property_readonly("components", &PyPatchSet::components, "Components of every point.")
      .def_property_readonly("dtype", &PyPatchSet::dtype, "The type of all results.");
  define(
      type, "degrees",
      [](const PyPatchSet& set, const py::object& patch) {
        const PatchShape shape = set.shape(patch);
        return py::make_tuple(shape.degree_u, shape.degree_v);
      },
      py::arg("patch"), "Degrees of one patch: (along a row, across rows).");
  define(
      type, "is_rational",
      [](const PyPatchSet& set, const py::object& patch) { return set.shape(patch).rational; },
      py::arg("patch"), "Whether one patch has weights.");
  define(
      type, "evaluate_grid", &PyPatchSet::evaluate_grid, py::arg("nu"), py::arg("nv"),
      py::arg("outputs") = position, py::arg("out") = py::none(), py::arg("threads") = 0,
      "Every patch on a grid: a dict of arrays (patches, nv, nu, components). nu and nv are "
      "numbers of uniform parameters, ends included, or arrays of parameters from 0 to 1, in any "
      "order. Arrays in `out` are written to without a copy, where samples are evenly "
      "spaced, and returned.");
  define(type, "evaluate", &PyPatchSet::evaluate, py::arg("patch"), py::arg("u"), py::arg("v"),
         py::arg("outputs") = position, py::arg("out") = py::none(), py::arg("threads") = 0,
         "Single samples in any order: a dict of arrays (samples, components). `patch` is one "
         "number for all of them, or one each.");
  define(type, "evaluate_derivatives", &PyPatchSet::evaluate_derivatives, py::arg("patch"),
         py::arg("u"), py::arg("v"), py::arg("derivatives"), py::arg("out") = py::none(),
         py::arg("threads") = 0,
         "Partial derivatives of any order at single samples: a dict of arrays (samples, "
         "components). `derivatives` are pairs of orders in u and v, such as (2, 1), which are "
         "keys of the results, and of `out`.");
  define(type, "evaluate_grid_derivatives", &PyPatchSet::evaluate_grid_derivatives, py::arg("nu"),
         py::arg("nv"), py::arg("derivatives"), py::arg("out") = py::none(), py::arg("threads") = 0,
         "The same for every patch on the grid that evaluate_grid() takes: arrays (patches, nv, "
         "nu, components).");
  define(type, "error_bounds", &PyPatchSet::error_bounds, py::arg("patch") = py::none(),
         "Certified bounds on |computed - exact| of every component: a dict with position, du "
         "and dv, arrays (components,) of one patch, or (patches, components) of all if no patch "
         "is named.");
}

} // namespace simdbezier::python
