// SplineSurface: B-spline and NURBS surfaces in their own parameters.
#include <algorithm>

#include "python/src/py_set.hpp"
#include "python/src/py_splines.hpp"

namespace simdbezier::python {
namespace {

/// The parameters of samples or of a grid.
struct SurfaceParameters {
  SurfaceParameters(const py::object& given_u, const py::object& given_v)
      : u(parameters<double>(given_u, "U")), v(parameters<double>(given_v, "V")) {}

  [[nodiscard]] NamedArrays inputs() const { return {{"U", u}, {"V", v}}; }
  [[nodiscard]] std::vector<std::pair<const char*, const double*>> named() const {
    return {{"U", u.data()}, {"V", v.data()}};
  }
  /// The same as single samples: all pairs of a grid.
  [[nodiscard]] std::pair<std::vector<double>, std::vector<double>> samples(bool grid) const {
    const auto us = span_of(u);
    const auto vs = span_of(v);
    std::pair<std::vector<double>, std::vector<double>> all{{us.begin(), us.end()},
                                                            {vs.begin(), vs.end()}};
    if (grid) {
      all = {};
      for (const double at : vs) {
        all.first.insert(all.first.end(), us.begin(), us.end());
        all.second.insert(all.second.end(), us.size(), at);
      }
    }
    return all;
  }

  py::array_t<double> u;
  py::array_t<double> v;
};

class PySplineSurface : public EmptyUntilConstructed {
public:
  PySplineSurface(const py::object& points, const py::object& degrees, const py::object& knots,
                  const py::object& weights, const py::object& homogeneous,
                  const py::object& periodic, const py::object& ranges,
                  const py::object& knot_tolerance, const py::object& dtype) {
    given_.points = own_points({points, weights, homogeneous}, 3);
    const auto direction = [&](std::size_t k, const char* index) {
      return spline_direction(
          element_of_pair(degrees, k, "degrees"), element_of_pair(knots, k, "knots"),
          element_of_pair(ranges, k, "ranges"), element_of_pair(periodic, k, "periodic"), index);
    };
    given_.u = direction(0, "[0]");
    given_.v = direction(1, "[1]");
    given_.tolerance = number(knot_tolerance, "knot_tolerance");
    given_.results_are_float = wants_float(dtype, given_.points_are_float());
    require_knots(locate(given_.surface_axes(), 0, nullptr, nullptr, {}), given_);
  }

  [[nodiscard]] const GivenSpline& given() const { return given_; }
  [[nodiscard]] SpanCounts spans() const { return span_count(given_.surface_axes()); }
  [[nodiscard]] int components() const { return given_.points.components; }
  [[nodiscard]] py::dtype dtype() const {
    return given_.results_are_float ? py::dtype::of<float>() : py::dtype::of<double>();
  }

  /// The patches, packed by whoever asks first.
  [[nodiscard]] const AnyPatchSet& set() const {
    return packed_.get(given_, [this](AnyPatchSet& set) {
      return given_.points_are_float() ? pack_as<float>(set) : pack_as<double>(set);
    });
  }
  [[nodiscard]] py::array_t<double> intervals() const {
    static_cast<void>(set());
    py::array_t<double> rows({static_cast<py::ssize_t>(intervals_.size()), py::ssize_t{4}});
    double* row = rows.mutable_data();
    for (const PatchInterval& of : intervals_) {
      for (const double end : {of.u.begin, of.u.end, of.v.begin, of.v.end}) {
        *row++ = end;
      }
    }
    return rows;
  }

  [[nodiscard]] py::object to_bezier() const {
    return given_.points_are_float() ? nets<float>() : nets<double>();
  }

  [[nodiscard]] py::dict locate_all(const py::object& u, const py::object& v) const {
    const SurfaceParameters at(u, v);
    require_equal(at);
    const FoundPlaces places = find(at, false);
    py::dict result;
    result["patch"] = py::array_t<std::uint32_t>(at.u.size(), places.patch.data());
    result["u"] = py::array_t<double>(at.u.size(), places.u.data());
    result["v"] = py::array_t<double>(at.u.size(), places.v.data());
    result["length_u"] = py::array_t<double>(at.u.size(), places.length_u.data());
    result["length_v"] = py::array_t<double>(at.u.size(), places.length_v.data());
    return result;
  }

  [[nodiscard]] py::dict evaluate(const py::object& u, const py::object& v,
                                  const py::object& outputs, const py::object& out,
                                  const py::object& threads, const py::object& derivatives) const {
    const SurfaceParameters at(u, v);
    require_equal(at);
    return evaluate_at(at, false, {at.u.size()}, outputs, out, threads, derivatives);
  }
  [[nodiscard]] py::dict evaluate_grid(const py::object& u, const py::object& v,
                                       const py::object& outputs, const py::object& out,
                                       const py::object& threads,
                                       const py::object& derivatives) const {
    const SurfaceParameters at(u, v);
    return evaluate_at(at, true, {at.v.size(), at.u.size()}, outputs, out, threads, derivatives);
  }

  [[nodiscard]] std::string text() const {
    const SpanCounts counts = spans();
    return "<simdbezier.SplineSurface: " + std::to_string(counts.u) + " x " +
           std::to_string(counts.v) + " patches of degree " + std::to_string(given_.u.degree) +
           " x " + std::to_string(given_.v.degree) +
           (given_.points.weights == Weights::none ? "" : ", rational") + ", " +
           plural(static_cast<std::size_t>(components()), "component", "components") + ", " +
           py::str(py::object(dtype())).cast<std::string>() + ">";
  }

private:
  static void require_equal(const SurfaceParameters& at) {
    if (at.v.size() != at.u.size()) {
      throw_value_error("V", "expected " + std::to_string(at.u.size()) +
                                 " values, as many as U, found " + std::to_string(at.v.size()));
    }
  }

  template <typename S>
  Report pack_as(AnyPatchSet& packed) const {
    const SplineSurface<S> surface = given_.surface<S>(given_.points.array);
    intervals_.resize(span_count(surface).patches());
    const auto pack_to = [&]<typename T>(std::type_identity<T>) {
      PatchSet<T> set;
      const Report report = pack(surface, set, intervals_);
      packed = std::move(set);
      return report;
    };
    return given_.results_are_float ? pack_to(std::type_identity<float>())
                                    : pack_to(std::type_identity<double>());
  }

  template <typename S>
  [[nodiscard]] py::object nets() const {
    py::array_t<S> array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(spans().patches()),
                                                  given_.v.degree + 1, given_.u.degree + 1,
                                                  given_.values()});
    const MutableNets<S> out = MutableNets<S>::packed(
        array.mutable_data(), static_cast<std::size_t>(array.shape(0)), given_.u.degree,
        given_.v.degree, components(), given_.points.weights);
    Report report;
    {
      const py::gil_scoped_release release;
      report = simdbezier::to_bezier(given_.surface<S>(given_.points.array), out);
    }
    require_points(report, given_);
    return given_back(array, given_.points.weights);
  }

  [[nodiscard]] FoundPlaces find(const SurfaceParameters& at, bool grid) const {
    const auto [us, vs] = at.samples(grid);
    FoundPlaces places(us.size());
    // Those of a grid are known to be inside: they have been evaluated.
    require_parameters(
        locate(given_.surface_axes(), us.size(), us.data(), vs.data(), places.view()), given_,
        {{"U", us.data()}, {"V", vs.data()}});
    return places;
  }

  [[nodiscard]] py::dict evaluate_at(const SurfaceParameters& at, bool grid,
                                     const std::vector<py::ssize_t>& samples,
                                     const py::object& outputs, const py::object& out,
                                     const py::object& threads,
                                     const py::object& derivatives) const {
    const std::vector<WantedDerivative> wanted = wanted_derivatives(derivatives, false);
    const auto count_u = static_cast<std::size_t>(at.u.size());
    const auto count_v = static_cast<std::size_t>(grid ? at.v.size() : 1);
    std::size_t count = 0;
    require_addressable(__builtin_mul_overflow(count_u, count_v, &count) ? ~std::size_t{0} : count,
                        std::max(components(), 1), "U or V");
    const AnyPatchSet& any = set();
    py::dict result;
    if (!only_derivatives(wanted, outputs, out)) {
      const SplineSurface<double> axes = given_.surface_axes();
      Report report;
      const auto evaluate_some = [&]<typename T>(const PatchSet<T>& of) {
        return evaluate_outputs<Patches, T>(
            components(), samples, outputs, out, at.inputs(), threads,
            [&](const Outputs<T>& to, const Options& options) {
              report = grid ? simdbezier::evaluate_grid(of, axes, span_of(at.u), span_of(at.v), to,
                                                        options)
                            : evaluate_samples(of, axes, span_of(at.u), span_of(at.v), to, options);
              const bool known =
                  report.status == Status::bad_range || report.status == Status::non_finite_input;
              return known ? Status(Status::ok) : report.status;
            });
      };
      result = std::visit(evaluate_some, any);
      require_parameters(report, given_, at.named());
    }
    if (!wanted.empty()) {
      add_derivatives(any, find(at, grid), wanted, samples, threads, result);
    }
    return result;
  }

  GivenSpline given_;
  mutable PackedOnce<AnyPatchSet> packed_;
  mutable std::vector<PatchInterval> intervals_;
};

void add_properties(py::class_<PySplineSurface>& type) {
  type.def("__len__", [](const PySplineSurface& spline) { return spline.spans().patches(); })
      .def("__repr__", &PySplineSurface::text)
      .def_property_readonly(
          "spans",
          [](const PySplineSurface& spline) {
            return py::make_tuple(spline.spans().u, spline.spans().v);
          },
          "Patches along u and along v. Patch number: v * spans[0] + u.")
      .def_property_readonly("components", &PySplineSurface::components,
                             "Components of every point.")
      .def_property_readonly("dtype", &PySplineSurface::dtype, "The type of all results.")
      .def_property_readonly("intervals", &PySplineSurface::intervals,
                             "What each patch stands for: (patches, 4), from U to U and V to V.")
      .def_property_readonly(
          "patch_set", [](const PySplineSurface& spline) { return patch_set_object(spline.set()); },
          "The patches as a PatchSet, packed once.");
}

} // namespace

const GivenSpline* spline_surface_of(const py::handle& object) {
  return py::isinstance<PySplineSurface>(object) ? &object.cast<const PySplineSurface&>().given()
                                                 : nullptr;
}

void add_spline_surface(py::module_& module) {
  const py::tuple position = py::make_tuple("position");
  const py::tuple cubic = py::make_tuple(3, 3);
  const py::tuple neither = py::make_tuple(false, false);
  const auto points = py::arg("points");
  const auto degrees = py::arg("degrees") = cubic;
  const auto knots = py::arg("knots") = py::none();
  const auto weights = py::arg("weights") = py::none();
  const auto homogeneous = py::arg("homogeneous") = false;
  const auto periodic = py::arg("periodic") = neither;
  const auto ranges = py::arg("ranges") = py::none();
  const auto tolerance = py::arg("knot_tolerance") = 0.0;
  py::class_<PySplineSurface> type(
      module, "SplineSurface",
      "A B-spline or NURBS surface with knots. Points are (rows, columns, components), and u runs "
      "along the columns of a row: degrees[0], knots[0] and U belong to the second axis of the "
      "points, degrees[1], knots[1] and V to the first. Arrays whose first axis is u, as SciPy and "
      "geomdl have them, are handed over as points.swapaxes(0, 1). There are n + degree + 1 knots "
      "for n points, n + 1 where it is periodic; None: uniform ones. Points and knots are copied. "
      "Immutable.");
  using Object = const py::object&;
  define_constructor<PySplineSurface, Object, Object, Object, Object, Object, Object, Object,
                     Object, Object>(type, points, degrees, knots, weights, homogeneous, periodic,
                                     ranges, tolerance, py::arg("dtype") = py::none());
  add_properties(type);
  define(type, "to_bezier", &PySplineSurface::to_bezier,
         "The patches' control points: (patches, degree v + 1, degree u + 1, components), of the "
         "points' type. With weights beside the points a pair of points and weights; homogeneous "
         "points stay homogeneous.");
  define(type, "locate", &PySplineSurface::locate_all, py::arg("U"), py::arg("V"),
         "Where parameters lie: a dict of arrays with patch, u and v on it, and the lengths of its "
         "interval. dS/dU is dS/du / length_u.");
  define(type, "evaluate", &PySplineSurface::evaluate, py::arg("U"), py::arg("V"),
         py::arg("outputs") = position, py::arg("out") = py::none(), py::arg("threads") = 0,
         py::arg("derivatives") = py::none(),
         "Single samples in the spline's own parameters: a dict of arrays (samples, components). "
         "Derivatives are by U and V; `derivatives` are pairs of orders, which are keys of the "
         "results. At a knot the right side counts, at the end of the domain the left one.");
  define(type, "evaluate_grid", &PySplineSurface::evaluate_grid, py::arg("U"), py::arg("V"),
         py::arg("outputs") = position, py::arg("out") = py::none(), py::arg("threads") = 0,
         py::arg("derivatives") = py::none(),
         "All pairs of U and V, likewise: arrays (len(V), len(U), components).");
  define(
      module, "spline_to_bezier",
      [](Object p, Object d, Object k, Object w, Object h, Object closed, Object parts,
         Object equal) {
        return PySplineSurface(p, d, k, w, h, closed, parts, equal, py::none()).to_bezier();
      },
      points, degrees, knots, weights, homogeneous, periodic, ranges, tolerance,
      "SplineSurface(…).to_bezier().");
}

} // namespace simdbezier::python
