// flatten(): curves as polylines within a tolerance, and Polylines, which it returns.
#include <algorithm>
#include <cstdint>
#include <cstdio>

#include <simdbezier/flatten.hpp>

#include "python/src/arguments/calls.hpp"
#include "python/src/py_set.hpp"
#include "python/src/py_splines.hpp"

namespace simdbezier::python {
namespace {

/// Polylines as simdbezier::Polylines has them, but of any number of components.
template <typename T>
struct Lines {
  std::vector<T> values; ///< those of all points, point after point
  std::size_t components = 0;
  std::vector<std::int64_t> first; ///< each polyline's first point, and the end of the last one
  std::vector<double> deviations;
};

class PyPolylines : public EmptyUntilConstructed {
public:
  template <typename T>
  explicit PyPolylines(Lines<T>&& lines) : lines_(std::move(lines)) {}

  template <typename Ask>
  [[nodiscard]] auto ask(Ask question) const {
    return std::visit(question, lines_);
  }

  [[nodiscard]] std::size_t size() const {
    return ask([](const auto& lines) { return lines.deviations.size(); });
  }
  [[nodiscard]] double deviation() const {
    return ask([](const auto& lines) {
      const auto& all = lines.deviations;
      return all.empty() ? 0.0 : *std::max_element(all.begin(), all.end());
    });
  }
  [[nodiscard]] std::string text() const {
    char within[32];
    std::snprintf(within, sizeof within, "%.3g", deviation());
    return ask([&]<typename T>(const Lines<T>& lines) {
      const auto points = static_cast<std::size_t>(lines.first.empty() ? 0 : lines.first.back());
      return "<simdbezier.Polylines: " + plural(size(), "polyline", "polylines") + " of " +
             plural(points, "point", "points") + ", within " + within + " of the curves, " +
             scalar_name<T>() + ">";
    });
  }

private:
  std::variant<Lines<float>, Lines<double>> lines_;
};

/// A view of the points from `begin` to `end`, which keeps the polylines.
template <typename T>
py::object points_of(const Lines<T>& lines, std::int64_t begin, std::int64_t end,
                     const py::object& self) {
  const auto components = static_cast<py::ssize_t>(lines.components);
  return py::array_t<T>({static_cast<py::ssize_t>(end - begin), components},
                        lines.values.data() + begin * components, self);
}

template <typename V>
py::object column(const std::vector<V>& values, const py::object& self) {
  return py::array_t<V>(static_cast<py::ssize_t>(values.size()), values.data(), self);
}

/// Makes a property or a method of PyPolylines, which is what read(lines, self, …) returns.
template <typename Read>
auto reader(Read read) {
  return [read](const py::object& self) -> py::object {
    return self.cast<const PyPolylines&>().ask(
        [&](const auto& lines) -> py::object { return read(lines, self); });
  };
}

py::object polyline_at(const py::object& self, const py::object& index) {
  const auto& polylines = self.cast<const PyPolylines&>();
  const std::size_t k = sequence_index(polylines.size(), index, "index",
                                       plural(polylines.size(), "polyline", "polylines"));
  return polylines.ask([&](const auto& lines) -> py::object {
    return points_of(lines, lines.first[k], lines.first[k + 1], self);
  });
}

/// Evaluates curves at as many uniform parameters each as `counts` says.
template <typename T>
Status evaluate_lines(const CurveSet<T>& set, std::span<const std::uint32_t> counts,
                      const Options& options, Lines<T>& lines) {
  const int components = set.components();
  Status status;
  for (int first = 0; status && first < components; first += 3) {
    T* const x = lines.values.data() + first;
    const int count = std::min(3, components - first);
    CurveOutputs<T> out;
    out.position = {x, count > 1 ? x + 1 : nullptr, count > 2 ? x + 2 : nullptr, components};
    out.first_component = first;
    status = evaluate(set, CurveGrids{counts}, out, options);
  }
  return status;
}

template <typename T, typename S>
Report make_lines(const ControlCurves<S>& curves, FlattenOptions wanted, const Options& options,
                  Lines<T>& lines) {
  CurveSet<T> set;
  if (const Report report = pack(curves, set, {.threads = options.threads}); !report) {
    return report;
  }
  std::vector<double> errors(set.size());
  if (const Status status = position_errors(set, std::span<double>(errors), options); !status) {
    return {status};
  }
  wanted.errors = errors;
  std::vector<std::uint32_t> counts(set.size());
  lines.deviations.resize(set.size());
  if (const Report report = choose_polylines(curves, wanted, counts, lines.deviations, options);
      !report) {
    return report;
  }
  lines.components = static_cast<std::size_t>(curves.components);
  lines.first.push_back(0);
  for (const std::uint32_t count : counts) {
    lines.first.push_back(lines.first.back() + count);
  }
  lines.values.resize(static_cast<std::size_t>(lines.first.back()) * lines.components);
  return {set.empty() ? Status(Status::ok) : evaluate_lines(set, counts, options, lines)};
}

template <typename T, typename S>
py::object flattened(const PointViews<S, ControlCurves>& points, const FlattenOptions& wanted,
                     const Options& options) {
  Lines<T> lines;
  Report report;
  {
    const py::gil_scoped_release release;
    report = make_lines(packable(points), wanted, options, lines);
  }
  if (report.status == Status::bad_tolerance) {
    throw_value_error("tolerance", std::string(to_string(report.status)) + " (curve " +
                                       std::to_string(report.item) + ")");
  }
  require_ok(report, points.weights_argument(), "points");
  return py::cast(PyPolylines(std::move(lines)));
}

py::object flatten_points(const py::object& points, const py::object& tolerance,
                          const py::object& weights, const py::object& dtype,
                          const py::object& threads, const py::object& homogeneous) {
  if (is_spline_curve(points)) {
    throw_type_error("points",
                     "expected control points, found a SplineCurve, whose to_bezier() has them");
  }
  const AnyPointViews<ControlCurves> any = control_curves({points, weights, homogeneous});
  if (tolerance.is_none()) {
    throw_type_error("tolerance", "expected a number, or one for each curve, found None");
  }
  const GivenTolerance given(tolerance);
  const bool is_float = wants_float(dtype, any.index() == 0);
  Options options;
  options.threads = thread_count(threads);
  return std::visit(
      [&](const auto& of) {
        given.require_count(packable(of).count, "curves");
        FlattenOptions wanted;
        wanted.tolerance = given.all;
        wanted.tolerances = span_of(given.each);
        return is_float ? flattened<float>(of, wanted, options)
                        : flattened<double>(of, wanted, options);
      },
      any);
}

} // namespace

void add_polylines(py::module_& module) {
  py::class_<PyPolylines> type(
      module, "Polylines",
      "Polylines of curves, a sequence of arrays (points, components). Its arrays are its own "
      "memory.");
  type.def("__repr__", &PyPolylines::text)
      .def("__len__", &PyPolylines::size)
      .def("__getitem__", &polyline_at, "The points of one polyline: (points, components).")
      .def("__iter__",
           [](const py::object& self) {
             return py::reinterpret_steal<py::object>(PySeqIter_New(self.ptr()));
           })
      .def_property_readonly("points", reader([](const auto& lines, const py::object& self) {
                               return points_of(lines, 0,
                                                lines.first.empty() ? 0 : lines.first.back(), self);
                             }),
                             "Those of all polylines, one after the other: (points, components).")
      .def_property_readonly("first", reader([](const auto& lines, const py::object& self) {
                               return column(lines.first, self);
                             }),
                             "Where each polyline begins among the points, and the end of the last "
                             "one: (curves + 1,)")
      .def_property_readonly("deviation", &PyPolylines::deviation,
                             "All polylines are certified to be this close to their curves.")
      .def_property_readonly("deviations", reader([](const auto& lines, const py::object& self) {
                               return column(lines.deviations, self);
                             }),
                             "The same for single curves: (curves,)");
  define(module, "flatten", &flatten_points, py::arg("points"), py::arg("tolerance"),
         py::arg("weights") = py::none(), py::kw_only(), py::arg("dtype") = py::none(),
         py::arg("threads") = 0, py::arg("homogeneous") = false,
         "Polylines of curves (curves, points, components) within a tolerance, which is one number "
         "or one each. Their points lie on the curves at uniform parameters, ends included, as few "
         "as the bound allows.");
}

} // namespace simdbezier::python
