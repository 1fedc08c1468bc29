// Splines as the module's objects have them: points and knots of their own, checked.
#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <simdbezier/splines.hpp>

#include "python/src/derivatives.hpp"
#include "python/src/module.hpp"

namespace simdbezier::python {

/// A direction of a spline, and what the arguments that describe it are called.
struct SplineDirection {
  int degree = 0;
  std::vector<double> knots; ///< empty: uniform
  bool periodic = false;
  Interval range;
  std::string knots_name;
  std::string range_name;

  [[nodiscard]] std::size_t expected_knots(std::size_t points) const {
    return points + 1 + (periodic ? 0 : static_cast<std::size_t>(degree));
  }
  /// The parameters that there are.
  [[nodiscard]] Interval domain(std::size_t points) const;
};

/// The arguments of a spline surface or curve.
struct GivenSpline {
  OwnPoints points;
  SplineDirection u;
  SplineDirection v; ///< of surfaces
  double tolerance = 0;
  bool results_are_float = false;

  // Objects that were never constructed have no array, and numbers of 0.
  [[nodiscard]] bool points_are_float() const { return points.array && holds<float>(points.array); }
  [[nodiscard]] std::size_t rows() const {
    return points.array ? static_cast<std::size_t>(points.array.shape(0)) : 0;
  }
  [[nodiscard]] std::size_t columns() const {
    return points.array ? static_cast<std::size_t>(points.array.shape(points.array.ndim() - 2)) : 0;
  }
  [[nodiscard]] std::ptrdiff_t values() const {
    return points.array ? points.array.shape(points.array.ndim() - 1) : 0;
  }

  /// A view of the points, or of as many others.
  template <typename S>
  [[nodiscard]] SplineSurface<S> surface(const py::array& of) const {
    SplineSurface<S> view;
    view.points = of ? static_cast<const S*>(of.data()) : nullptr;
    view.rows = rows();
    view.columns = columns();
    view.point_stride = values();
    view.row_stride = values() * static_cast<std::ptrdiff_t>(columns());
    view.components = points.components;
    view.weights = points.weights;
    view.periodic_u = u.periodic;
    view.periodic_v = v.periodic;
    view.degree_u = u.degree;
    view.degree_v = v.degree;
    view.knots_u = u.knots;
    view.knots_v = v.knots;
    view.u_range = u.range;
    view.v_range = v.range;
    view.knot_tolerance = tolerance;
    return view;
  }
  template <typename S>
  [[nodiscard]] SplineCurve<S> curve(const py::array& of) const {
    return {of ? static_cast<const S*>(of.data()) : nullptr,
            columns(),
            values(),
            1,
            points.components,
            points.weights,
            u.periodic,
            u.degree,
            u.knots,
            u.range,
            tolerance,
            {}};
  }
  /// What knots alone are asked for.
  [[nodiscard]] SplineSurface<double> surface_axes() const {
    SplineSurface<double> axes = surface<double>(points.array);
    axes.points = nullptr;
    return axes;
  }
  [[nodiscard]] SplineCurve<double> curve_axis() const {
    SplineCurve<double> axis = curve<double>(points.array);
    axis.points = nullptr;
    return axis;
  }
};

/// Throws where a report about control points is not ok.
void require_points(const Report& report, const GivenSpline& spline,
                    const std::string& argument = "points");

/// A set that whoever asks first packs, while others wait.
template <typename Set>
class PackedOnce {
public:
  /// pack(set) returns a Report, without Python's lock.
  template <typename Pack>
  const Set& get(const GivenSpline& spline, const Pack& pack) {
    Report report;
    {
      const py::gil_scoped_release release;
      const std::scoped_lock lock(packing_);
      if (!packed_) {
        report = pack(set_);
        packed_ = static_cast<bool>(report);
      }
    }
    require_points(report, spline);
    return set_;
  }

private:
  std::mutex packing_;
  bool packed_ = false;
  Set set_;
};

/// One degree; knots, a range and a period of one direction, each None where there is none.
[[nodiscard]] SplineDirection spline_direction(const py::object& degree, const py::object& knots,
                                               const py::object& range, const py::object& periodic,
                                               const std::string& index);
/// Element k of a pair; None for both where the pair is None.
[[nodiscard]] py::object element_of_pair(const py::object& pair, std::size_t k,
                                         const char* argument);

/// Throws where a report about knots, ranges and numbers of points is not ok.
void require_knots(const Report& report, const GivenSpline& spline);
/// Throws where a report of locate() and evaluations is about a parameter, which are called so.
void require_parameters(const Report& report, const GivenSpline& spline,
                        const std::vector<std::pair<const char*, const double*>>& parameters);

/// Where samples lie: what locate() gives.
struct FoundPlaces {
  explicit FoundPlaces(std::size_t count)
      : patch(count), u(count), v(count), length_u(count, 1.0), length_v(count, 1.0),
        centred_u(count), centred_v(count, -1.0) {}

  [[nodiscard]] SplinePlaces view() {
    return {patch.data(),    u.data(),         v.data(),        length_u.data(),
            length_v.data(), centred_u.data(), centred_v.data()};
  }

  std::vector<std::uint32_t> patch;
  std::vector<double> u;
  std::vector<double> v;
  std::vector<double> length_u;
  std::vector<double> length_v;
  std::vector<double> centred_u;
  std::vector<double> centred_v; ///< of curves the row v = 0
};

/// What derivatives of these orders are divided by at sample k.
template <typename T>
[[nodiscard]] T divisor_at(const FoundPlaces& places, std::size_t k, int order_u, int order_v) {
  return static_cast<T>(
      derivative_divisor(order_u, order_v, places.length_u[k], places.length_v[k]));
}

/// Adds derivatives by the spline's own parameters to a dict. samples: the dimensions of arrays in
/// front of the components.
void add_derivatives(const AnyPatchSet& set, const FoundPlaces& places,
                     const std::vector<WantedDerivative>& wanted,
                     const std::vector<py::ssize_t>& samples, const py::object& threads,
                     py::dict& result);

/// Whether nothing but derivatives is asked for.
[[nodiscard]] bool only_derivatives(const std::vector<WantedDerivative>& wanted,
                                    const py::object& outputs, const py::object& out);

/// A SplineSurface that a Python object is; null where it is something else.
[[nodiscard]] const GivenSpline* spline_surface_of(const py::handle& object);
[[nodiscard]] bool is_spline_curve(const py::handle& object);

} // namespace simdbezier::python
