// SplineCurve: B-spline and NURBS curves in their own parameter.
#include <algorithm>

#include "python/src/py_set.hpp"
#include "python/src/py_splines.hpp"

namespace simdbezier::python {
namespace {

/// A curve as a surface that is the same for all v, whose derivatives by u have any order.
GivenSpline as_surface(const GivenSpline& curve) {
  GivenSpline surface = curve;
  surface.v = {1, {}, false, {}, "", ""};
  surface.points.array = py::module_::import("numpy").attr("stack")(
      py::make_tuple(curve.points.array, curve.points.array));
  return surface;
}

class PySplineCurve : public EmptyUntilConstructed {
public:
  PySplineCurve(const py::object& points, const py::object& degree, const py::object& knots,
                const py::object& weights, const py::object& homogeneous,
                const py::object& periodic, const py::object& range,
                const py::object& knot_tolerance, const py::object& dtype) {
    given_.points = own_points({points, weights, homogeneous}, 2);
    given_.u = spline_direction(degree, knots, range, periodic, "");
    given_.tolerance = number(knot_tolerance, "knot_tolerance");
    given_.results_are_float = wants_float(dtype, given_.points_are_float());
    require_knots(locate(given_.curve_axis(), 0, nullptr, {}), given_);
  }

  [[nodiscard]] std::size_t spans() const { return span_count(given_.curve_axis()).u; }
  [[nodiscard]] int components() const { return given_.points.components; }
  [[nodiscard]] int degree() const { return given_.u.degree; }
  [[nodiscard]] py::dtype dtype() const {
    return given_.results_are_float ? py::dtype::of<float>() : py::dtype::of<double>();
  }

  [[nodiscard]] const AnyCurveSet& set() const {
    return packed_.get(given_, [this](AnyCurveSet& set) {
      return given_.points_are_float() ? pack_as<float>(set) : pack_as<double>(set);
    });
  }
  [[nodiscard]] py::array_t<double> intervals() const {
    static_cast<void>(set());
    py::array_t<double> rows({static_cast<py::ssize_t>(intervals_.size()), py::ssize_t{2}});
    for (std::size_t k = 0; k < intervals_.size(); ++k) {
      rows.mutable_data()[2 * k] = intervals_[k].begin;
      rows.mutable_data()[2 * k + 1] = intervals_[k].end;
    }
    return rows;
  }
  [[nodiscard]] py::object to_bezier() const {
    return given_.points_are_float() ? pieces<float>() : pieces<double>();
  }

  [[nodiscard]] py::dict locate_all(const py::object& t) const {
    const py::array_t<double> ts = parameters<double>(t, "t");
    const FoundPlaces places = find(ts);
    py::dict result;
    result["curve"] = py::array_t<std::uint32_t>(ts.size(), places.patch.data());
    result["t"] = py::array_t<double>(ts.size(), places.u.data());
    result["length"] = py::array_t<double>(ts.size(), places.length_u.data());
    return result;
  }

  [[nodiscard]] py::dict evaluate(const py::object& t, const py::object& outputs,
                                  const py::object& out, const py::object& threads,
                                  const py::object& derivatives) const {
    const py::array_t<double> ts = parameters<double>(t, "t");
    const std::vector<WantedDerivative> wanted = wanted_derivatives(derivatives, true);
    require_addressable(static_cast<std::size_t>(ts.size()), std::max(components(), 1), "t");
    const FoundPlaces places = find(ts);
    py::dict result;
    if (!only_derivatives(wanted, outputs, out)) {
      result = std::visit(
          [&](const auto& of) { return evaluate_some(of, ts, outputs, out, threads); }, set());
    }
    if (!wanted.empty()) {
      add_derivatives(derivative_set(), places, wanted, {ts.size()}, threads, result);
    }
    return result;
  }

  [[nodiscard]] std::string text() const {
    return "<simdbezier.SplineCurve: " + plural(spans(), "piece", "pieces") + " of degree " +
           std::to_string(degree()) + (given_.points.weights == Weights::none ? "" : ", rational") +
           ", " + plural(static_cast<std::size_t>(components()), "component", "components") + ", " +
           py::str(py::object(dtype())).cast<std::string>() + ">";
  }

private:
  template <typename S>
  [[nodiscard]] std::vector<py::ssize_t> shape() const {
    return {static_cast<py::ssize_t>(spans()), degree() + 1, given_.values()};
  }

  /// Fills pieces, `values` being all of their memory.
  template <typename S>
  Report cut(S* values, std::span<Interval> intervals) const {
    const std::size_t count = spans() * static_cast<std::size_t>((degree() + 1) * given_.values());
    return simdbezier::to_bezier(given_.curve<S>(given_.points.array),
                                 Values<S>(std::span<S>(values, count)), intervals);
  }

  template <typename S>
  Report pack_as(AnyCurveSet& packed) const {
    intervals_.resize(spans());
    std::vector<S> values(intervals_.size() *
                          static_cast<std::size_t>((degree() + 1) * given_.values()));
    if (const Report report = cut(values.data(), intervals_); !report) {
      return report;
    }
    const auto curves = ControlCurves<S>::packed(std::span<const S>(values), degree(), components(),
                                                 given_.points.weights);
    const auto pack_to = [&]<typename T>(std::type_identity<T>) -> Report {
      CurveSet<T> set;
      const Report report = pack(curves, set);
      packed = std::move(set);
      return {report.status};
    };
    return given_.results_are_float ? pack_to(std::type_identity<float>())
                                    : pack_to(std::type_identity<double>());
  }

  template <typename S>
  [[nodiscard]] py::object pieces() const {
    py::array_t<S> array(shape<S>());
    S* const values = array.mutable_data();
    Report report;
    {
      const py::gil_scoped_release release;
      report = cut(values, {});
    }
    require_points(report, given_);
    return given_back(array, given_.points.weights);
  }

  [[nodiscard]] FoundPlaces find(const py::array_t<double>& ts) const {
    FoundPlaces places(static_cast<std::size_t>(ts.size()));
    require_parameters(locate(given_.curve_axis(), places.patch.size(), ts.data(), places.view()),
                       given_, {{"t", ts.data()}});
    return places;
  }

  template <typename T>
  [[nodiscard]] py::dict evaluate_some(const CurveSet<T>& of, const py::array_t<double>& ts,
                                       const py::object& outputs, const py::object& out,
                                       const py::object& threads) const {
    return evaluate_outputs<Curves, T>(
        components(), {ts.size()}, outputs, out, {{"t", ts}}, threads,
        [&](const CurveOutputs<T>& to, const Options& options) {
          return evaluate_samples(of, given_.curve_axis(), span_of(ts), to, options).status;
        });
  }

  /// What derivatives of any order are evaluated from.
  [[nodiscard]] AnyPatchSet derivative_set() const {
    const GivenSpline surface = as_surface(given_);
    const auto pack_to = [&]<typename S, typename T>(std::type_identity<S>,
                                                     std::type_identity<T>) -> AnyPatchSet {
      PatchSet<T> set;
      require_points(pack(surface.surface<S>(surface.points.array), set), given_);
      return set;
    };
    const auto pack_from = [&]<typename S>(std::type_identity<S> from) {
      return given_.results_are_float ? pack_to(from, std::type_identity<float>())
                                      : pack_to(from, std::type_identity<double>());
    };
    return given_.points_are_float() ? pack_from(std::type_identity<float>())
                                     : pack_from(std::type_identity<double>());
  }

  GivenSpline given_;
  mutable PackedOnce<AnyCurveSet> packed_;
  mutable std::vector<Interval> intervals_;
};

} // namespace

bool is_spline_curve(const py::handle& object) { return py::isinstance<PySplineCurve>(object); }

void add_spline_curve(py::module_& module) {
  py::class_<PySplineCurve> type(
      module, "SplineCurve",
      "A B-spline or NURBS curve with knots. Points are (points, components); there are n + degree "
      "+ 1 knots for n points, n + 1 where it is periodic; None: uniform ones. Points and knots "
      "are copied. Immutable.");
  using Object = const py::object&;
  define_constructor<PySplineCurve, Object, Object, Object, Object, Object, Object, Object, Object,
                     Object>(type, py::arg("points"), py::arg("degree") = 3,
                             py::arg("knots") = py::none(), py::arg("weights") = py::none(),
                             py::arg("homogeneous") = false, py::arg("periodic") = false,
                             py::arg("range") = py::none(), py::arg("knot_tolerance") = 0.0,
                             py::arg("dtype") = py::none());
  type.def("__len__", &PySplineCurve::spans)
      .def("__repr__", &PySplineCurve::text)
      .def_property_readonly("spans", &PySplineCurve::spans, "Pieces of the curve.")
      .def_property_readonly("degree", &PySplineCurve::degree, "The degree of all pieces.")
      .def_property_readonly("components", &PySplineCurve::components, "Components of every point.")
      .def_property_readonly("dtype", &PySplineCurve::dtype, "The type of all results.")
      .def_property_readonly("intervals", &PySplineCurve::intervals,
                             "What each piece stands for: (pieces, 2).")
      .def_property_readonly(
          "curve_set", [](const PySplineCurve& spline) { return curve_set_object(spline.set()); },
          "The pieces as a CurveSet, packed once.");
  define(type, "to_bezier", &PySplineCurve::to_bezier,
         "The pieces' control points: (pieces, degree + 1, components), of the points' type. With "
         "weights beside the points a pair of points and weights; homogeneous points stay "
         "homogeneous.");
  define(type, "locate", &PySplineCurve::locate_all, py::arg("t"),
         "Where parameters lie: a dict of arrays with curve, t on it, and the length of its "
         "interval.");
  define(type, "evaluate", &PySplineCurve::evaluate, py::arg("t"),
         py::arg("outputs") = py::make_tuple("position"), py::arg("out") = py::none(),
         py::arg("threads") = 0, py::arg("derivatives") = py::none(),
         "Samples in the spline's own parameter, in any order: a dict of arrays (samples, "
         "components). Derivatives are by it; `derivatives` are orders, which are keys of the "
         "results. At a knot the right side counts, at the end of the domain the left one.");
}

} // namespace simdbezier::python
