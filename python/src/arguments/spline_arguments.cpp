// See py_splines.hpp.
#include "python/src/py_splines.hpp"

#include <algorithm>
#include <cmath>

#include <simdbezier/evaluate.hpp>

namespace simdbezier::python {
namespace {

std::string text_of(double value) { return py::str(py::float_(value)).cast<std::string>(); }

Interval range_of(const py::object& range, const std::string& argument) {
  if (range.is_none()) {
    return {};
  }
  const py::array_t<double> ends = parameters<double>(range, argument);
  if (ends.size() != 2) {
    throw_value_error(argument, "expected two numbers, found " + std::to_string(ends.size()));
  }
  if (!(ends.data()[0] < ends.data()[1])) { // an empty one would stand for the whole domain
    throw_value_error(argument, "expected ascending numbers, found " + text_of(ends.data()[0]) +
                                    " and " + text_of(ends.data()[1]));
  }
  return {ends.data()[0], ends.data()[1]};
}

/// What is wrong with knots.
[[noreturn]] void throw_knots(const SplineDirection& direction, std::size_t points,
                              std::size_t knot, double tolerance) {
  const std::vector<double>& knots = direction.knots;
  const std::size_t expected = direction.expected_knots(points);
  if (knots.size() != expected) {
    const bool shortened = !direction.periodic && knots.size() + 2 == expected;
    throw_value_error(direction.knots_name,
                      "expected " + std::to_string(expected) + " knots for " +
                          plural(points, "point", "points") + " of degree " +
                          std::to_string(direction.degree) + ", found " +
                          std::to_string(knots.size()) +
                          (shortened ? "; openNURBS leaves the first and the last one out: repeat "
                                       "them"
                                     : ""));
  }
  const std::string number = "number " + std::to_string(knot) + ", " + text_of(knots[knot]);
  if (!(std::abs(knots[knot]) <= 0x1p1000)) {
    throw_value_error(direction.knots_name, number + ", is not finite or beyond 2^1000");
  }
  if (knot > 0 && knots[knot] < knots[knot - 1]) {
    throw_value_error(direction.knots_name,
                      number + ", is below the one before it, " + text_of(knots[knot - 1]));
  }
  const Interval domain = direction.domain(points);
  if (!(domain.begin < domain.end)) {
    throw_value_error(direction.knots_name, "the domain begins and ends at " + text_of(domain.end));
  }
  throw_value_error(direction.knots_name,
                    number + ", occurs more than " + std::to_string(direction.degree + 1) +
                        " times" +
                        (tolerance > 0 ? ", together with those within knot_tolerance" : ""));
}

/// Whether it is the product of a point and its weight that overflows, rather than a patch made of
/// sound ones. Of such a patch, reports have no point.
template <typename S>
bool product_overflows(const Report& report, const OwnPoints& points, std::ptrdiff_t values) {
  if (points.weights != Weights::cartesian || report.component >= points.components) {
    return false;
  }
  const S* const point = static_cast<const S*>(points.array.data()) +
                         static_cast<std::ptrdiff_t>(report.point) * values;
  return !std::isfinite(static_cast<S>(static_cast<double>(point[report.component]) *
                                       static_cast<double>(point[points.components])));
}

template <typename T>
void divide(py::array_t<T>& array, int components, const FoundPlaces& places,
            const WantedDerivative& orders) {
  T* value = array.mutable_data();
  for (std::size_t k = 0; k < places.patch.size(); ++k) {
    const T divisor = divisor_at<T>(places, k, orders.u, orders.v);
    for (int c = 0; c < components; ++c, ++value) {
      *value /= divisor;
    }
  }
}

} // namespace

Interval SplineDirection::domain(std::size_t points) const {
  if (!range.empty()) {
    return range;
  }
  const std::size_t before = periodic ? 0 : static_cast<std::size_t>(degree);
  return knots.empty() ? Interval{0, static_cast<double>(points - before)}
                       : Interval{knots[before], knots[points]};
}

py::object element_of_pair(const py::object& pair, std::size_t k, const char* argument) {
  if (pair.is_none()) {
    return pair;
  }
  if (!py::isinstance<py::sequence>(pair) || py::isinstance<py::str>(pair) || py::len(pair) != 2) {
    throw_value_error(argument, "expected a pair: of u, along a row, and of v");
  }
  return pair[py::int_(k)];
}

SplineDirection spline_direction(const py::object& degree, const py::object& knots,
                                 const py::object& range, const py::object& periodic,
                                 const std::string& index) {
  SplineDirection direction;
  const std::string degree_name = index.empty() ? "degree" : "degrees" + index;
  const std::size_t given = integer(degree, 1, degree_name);
  if (given > std::size_t{kMostDegree}) {
    throw_value_error(degree_name, "expected 1 to " + std::to_string(kMostDegree) + ", found " +
                                       std::to_string(given));
  }
  direction.degree = static_cast<int>(given);
  direction.knots_name = "knots" + index;
  direction.range_name = index.empty() ? "range" : "ranges" + index;
  if (!knots.is_none()) {
    const py::array_t<double> array = parameters<double>(knots, direction.knots_name);
    direction.knots.assign(array.data(), array.data() + array.size());
    if (direction.knots.empty()) { // which would stand for uniform ones
      throw_value_error(direction.knots_name, "expected numbers, or None for uniform knots");
    }
  }
  direction.range = range_of(range, direction.range_name);
  direction.periodic = flag(periodic, ("periodic" + index).c_str());
  return direction;
}

void require_knots(const Report& report, const GivenSpline& spline) {
  const bool is_v = report.component == 1;
  const bool is_curve = spline.points.array && spline.points.array.ndim() == 2;
  const SplineDirection& direction = is_v ? spline.v : spline.u;
  const std::size_t points = is_v ? spline.rows() : spline.columns();
  switch (report.status.code()) {
  case Status::bad_knots:
    throw_knots(direction, points, static_cast<std::size_t>(report.point), spline.tolerance);
  case Status::bad_grid:
    throw_value_error(
        "points", "expected " + std::to_string(direction.degree + (direction.periodic ? 0 : 1)) +
                      (is_curve ? ""
                       : is_v   ? " rows"
                                : " columns") +
                      " or more for degree " + std::to_string(direction.degree) + ", found " +
                      std::to_string(points));
  case Status::bad_range: {
    const double begin = direction.range.begin;
    const double end = direction.range.end;
    SplineDirection whole = direction;
    whole.range = {};
    const Interval domain = whole.domain(points);
    throw_value_error(direction.range_name, "expected a part of " + text_of(domain.begin) + " to " +
                                                text_of(domain.end) + ", found " + text_of(begin) +
                                                " to " + text_of(end));
  }
  case Status::bad_tolerance:
    throw_value_error("knot_tolerance", "expected a number of 0 or more");
  default:
    require_ok(report.status, "points");
  }
}

void require_points(const Report& report, const GivenSpline& spline, const std::string& argument) {
  const bool is_product = report.status == Status::coefficient_overflow &&
                          (spline.points_are_float()
                               ? product_overflows<float>(report, spline.points, spline.values())
                               : product_overflows<double>(report, spline.points, spline.values()));
  if (is_product || report.status == Status::non_finite_input ||
      report.status == Status::bad_weight) {
    const bool is_weight = report.status == Status::bad_weight;
    const bool beside = is_weight && spline.points.weights == Weights::cartesian;
    const auto point = static_cast<std::size_t>(report.point);
    const std::size_t columns = std::max<std::size_t>(spline.columns(), 1);
    const bool is_curve = spline.points.array && spline.points.array.ndim() == 2;
    throw_value_error(beside ? "weights" : argument,
                      std::string(to_string(report.status)) +
                          (is_curve ? " (point " + std::to_string(point)
                                    : " (row " + std::to_string(point / columns) + ", column " +
                                          std::to_string(point % columns)) +
                          (is_weight ? "" : ", component " + std::to_string(report.component)) +
                          ")");
  }
  require_ok(report.status, argument);
}

void require_parameters(const Report& report, const GivenSpline& spline,
                        const std::vector<std::pair<const char*, const double*>>& parameters) {
  if (report.status == Status::bad_range || report.status == Status::non_finite_input) {
    const bool is_v = report.component == 1;
    const auto& [name, values] = parameters[is_v ? 1 : 0];
    const Interval domain =
        is_v ? spline.v.domain(spline.rows()) : spline.u.domain(spline.columns());
    throw_value_error(name, "number " + std::to_string(report.point) + ", " +
                                text_of(values[static_cast<std::size_t>(report.point)]) +
                                ", is outside of " + text_of(domain.begin) + " to " +
                                text_of(domain.end));
  }
}

void add_derivatives(const AnyPatchSet& set, const FoundPlaces& places,
                     const std::vector<WantedDerivative>& wanted,
                     const std::vector<py::ssize_t>& samples, const py::object& threads,
                     py::dict& result) {
  const auto add = [&]<typename T>(const PatchSet<T>& of) {
    const std::vector<T> x(places.centred_u.begin(), places.centred_u.end());
    const std::vector<T> y(places.centred_v.begin(), places.centred_v.end());
    const py::dict derivatives =
        evaluate_derivatives_at(of, Samples<T>{places.patch, x, y, Parameters::centred}, wanted,
                                samples, py::none(), {}, threads);
    for (const WantedDerivative& one : wanted) {
      auto array = derivatives[one.key].template cast<py::array_t<T>>();
      divide(array, of.components(), places, one);
      result[one.key] = array;
    }
  };
  std::visit(add, set);
}

bool only_derivatives(const std::vector<WantedDerivative>& wanted, const py::object& outputs,
                      const py::object& out) {
  const bool none =
      outputs.is_none() || (py::isinstance<py::sequence>(outputs) &&
                            !py::isinstance<py::str>(outputs) && py::len(outputs) == 0);
  return !wanted.empty() && none && out.is_none();
}

} // namespace simdbezier::python
