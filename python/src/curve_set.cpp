// CurveSet: packed curves, evaluated into numpy's arrays.
#include <simdbezier/curves.hpp>

#include "python/src/py_set.hpp"

namespace simdbezier::python {
namespace {

class PyCurveSet : public PySet<Curves> {
public:
  PyCurveSet(const py::object& points, const py::object& weights, const py::object& dtype,
             const py::object& local_origin, const py::object& relative_to,
             const py::object& threads, const py::object& homogeneous)
      : PySet(control_curves({points, weights, homogeneous}), dtype, local_origin, relative_to,
              threads) {}
  explicit PyCurveSet(AnyCurveSet&& set) : PySet(std::move(set)) {}

  [[nodiscard]] int degree() const {
    return std::visit([](const auto& set) { return set.degree(); }, set_);
  }
  [[nodiscard]] bool rational() const {
    return std::visit([](const auto& set) { return set.rational(); }, set_);
  }

  [[nodiscard]] py::dict evaluate_grid(const py::object& n, const py::object& outputs,
                                       const py::object& out, const py::object& threads) const {
    const std::size_t count = integer(n, 2, "n");
    return std::visit(
        [&]<typename T>(const CurveSet<T>& set) {
          const CurveGrid<T> grid = CurveGrid<T>::uniform(count);
          require_addressable(sample_count(set, grid), set.components(), "n");
          return evaluate_at(
              set, grid, {static_cast<py::ssize_t>(set.size()), static_cast<py::ssize_t>(count)},
              outputs, out, {}, threads);
        },
        set_);
  }

  [[nodiscard]] py::dict evaluate(const py::object& curve, const py::object& t,
                                  const py::object& outputs, const py::object& out,
                                  const py::object& threads) const {
    return std::visit(
        [&]<typename T>(const CurveSet<T>& set) {
          const py::array_t<T> ts = parameters<T>(t, "t");
          const py::array_t<std::uint32_t> curves =
              indices(curve, static_cast<std::size_t>(ts.size()), "curve");
          if (curves.size() != ts.size()) {
            throw_value_error("curve", "expected " + std::to_string(ts.size()) +
                                           " values, as many as t, found " +
                                           std::to_string(curves.size()));
          }
          return evaluate_at(set, CurveSamples<T>{span_of(curves), span_of(ts)}, {ts.size()},
                             outputs, out, {{"curve", curves}, {"t", ts}}, threads);
        },
        set_);
  }

  [[nodiscard]] std::string text() const {
    return "<simdbezier.CurveSet: " + plural(size(), "curve", "curves") + " of degree " +
           std::to_string(degree()) + (rational() ? ", rational" : "") + ", " + type_text() + ">";
  }
};

} // namespace

py::object curve_set_object(AnyCurveSet set) { return py::cast(PyCurveSet(std::move(set))); }

void add_curve_set(py::module_& module) {
  const py::tuple position = py::make_tuple("position");
  py::class_<PyCurveSet> type(module, "CurveSet",
                              "Bezier curves of one degree, packed to be evaluated many times. "
                              "Immutable.");
  using Object = const py::object&;
  define_constructor<PyCurveSet, Object, Object, Object, Object, Object, Object, Object>(
      type, py::arg("points"), py::arg("weights") = py::none(), py::arg("dtype") = py::none(),
      py::kw_only(), py::arg("local_origin") = false, py::arg("relative_to") = py::none(),
      py::arg("threads") = 0, py::arg("homogeneous") = false);
  type.def("__len__", &PyCurveSet::size)
      .def("__repr__", &PyCurveSet::text)
      .def_property_readonly("degree", &PyCurveSet::degree, "The degree of every curve.")
      .def_property_readonly("components", &PyCurveSet::components, "Components of every point.")
      .def_property_readonly("rational", &PyCurveSet::rational, "Whether curves have weights.")
      .def_property_readonly("dtype", &PyCurveSet::dtype, "The type of all results.");
  define(type, "evaluate_grid", &PyCurveSet::evaluate_grid, py::arg("n"),
         py::arg("outputs") = position, py::arg("out") = py::none(), py::arg("threads") = 0,
         "Every curve at n uniform parameters, ends included: a dict of arrays (curves, n, "
         "components). Arrays in `out` are written to without a copy, where samples are evenly "
         "spaced, and returned.");
  define(type, "evaluate", &PyCurveSet::evaluate, py::arg("curve"), py::arg("t"),
         py::arg("outputs") = position, py::arg("out") = py::none(), py::arg("threads") = 0,
         "Single samples in any order: a dict of arrays (samples, components). `curve` is one "
         "number for all of them, or one each.");
  define(type, "error_bounds", &PyCurveSet::error_bounds, py::arg("curve") = py::none(),
         "Certified bounds on |computed - exact| of every component: a dict with position, d1 "
         "and d2, arrays (components,) of one curve, or (curves, components) of all if no curve "
         "is named.");
}

} // namespace simdbezier::python
