// See arrays.hpp.
#include "python/src/arguments/arrays.hpp"

#include <algorithm>
#include <limits>

#include "python/src/arguments/call_arguments.hpp"

namespace simdbezier::python {
namespace {

py::module_ numpy() { return py::module_::import("numpy"); }

py::array as_type(const py::array& array, const char* dtype) { return array.attr("astype")(dtype); }

/// Whether patches of several shapes are given: a list or tuple of arrays with `dimensions` each.
bool is_list_of_arrays(const py::object& points, py::ssize_t dimensions) {
  if (!py::isinstance<py::list>(points) && !py::isinstance<py::tuple>(points)) {
    return false;
  }
  const auto list = py::reinterpret_borrow<py::sequence>(points);
  bool arrays = py::len(list) > 0;
  for (const py::handle one : list) {
    arrays = arrays && py::isinstance<py::array>(one) &&
             py::reinterpret_borrow<py::array>(one).ndim() == dimensions;
  }
  return arrays;
}

/// Points with their weights behind them: the one case in which they are copied.
py::array joined(const py::array& points, const py::object& weights, const std::string& argument) {
  const py::array of = float_array(weights, points.ndim() - 1, argument);
  if (!std::equal(of.shape(), of.shape() + of.ndim(), points.shape())) {
    throw_value_error(argument, "expected one weight a control point, found shape " +
                                    shape_text(of) + " for points of shape " + shape_text(points));
  }
  const py::object last = of.attr("reshape")(
      py::tuple(py::reinterpret_borrow<py::tuple>(of.attr("shape")) + py::make_tuple(1)));
  const char* const dtype = holds<float>(points) ? "float32" : "float64";
  return numpy().attr("concatenate")(py::make_tuple(points, last.attr("astype")(dtype)),
                                     py::arg("axis") = -1);
}

void require_count(py::ssize_t found, py::ssize_t least, py::ssize_t most,
                   const std::string& argument, const char* what) {
  if (found < least || found > most) {
    throw_value_error(argument, "expected " + std::to_string(least) + " to " +
                                    std::to_string(most) + " " + what + ", found " +
                                    std::to_string(found));
  }
}

/// One array as views are made of it.
struct Points {
  py::array array;
  Weights weights = Weights::none;
  std::string argument;
};

/// All arrays of one argument, with one type.
std::vector<Points> given_points(const GivenPoints& given, py::ssize_t dimensions) {
  const auto& [points, weights, homogeneous] = given;
  const Weights inside = flag(homogeneous, "homogeneous") ? Weights::homogeneous : Weights::none;
  if (inside != Weights::none && !weights.is_none()) {
    throw_value_error("weights", "expected none beside homogeneous points");
  }
  std::vector<Points> all;
  const auto add = [&](const py::object& one, const py::object& weight, const std::string& index) {
    const py::array array = float_array(one, dimensions, "points" + index);
    const bool rational = !weight.is_none();
    all.push_back({rational ? joined(array, weight, "weights" + index) : array,
                   rational ? Weights::cartesian : inside, "points" + index});
  };
  if (!is_list_of_arrays(points, dimensions)) {
    add(points, weights, "");
    return all;
  }
  const auto list = py::reinterpret_borrow<py::sequence>(points);
  const bool weighted = !weights.is_none();
  if (weighted && (!py::isinstance<py::sequence>(weights) || py::len(weights) != py::len(list))) {
    throw_value_error("weights", "expected a list as long as that of the points");
  }
  for (std::size_t k = 0; k < py::len(list); ++k) {
    const py::object weight =
        weighted ? py::object(py::reinterpret_borrow<py::sequence>(weights)[k]) : py::none();
    add(list[k], weight, "[" + std::to_string(k) + "]");
  }
  const bool all_float = std::all_of(all.begin(), all.end(),
                                     [](const Points& one) { return holds<float>(one.array); });
  for (Points& one : all) {
    if (!all_float && holds<float>(one.array)) {
      one.array = as_type(one.array, "float64");
    }
  }
  return all;
}

int components_of(const Points& points) {
  const py::ssize_t values = points.array.shape(points.array.ndim() - 1);
  const py::ssize_t components = values - (points.weights == Weights::none ? 0 : 1);
  require_count(components, 1, kMostComponents, points.argument, "components");
  return static_cast<int>(components);
}

int degree_of(const Points& points, py::ssize_t axis, const char* what) {
  require_count(points.array.shape(axis), 2, kMostDegree + 1, points.argument, what);
  return static_cast<int>(points.array.shape(axis) - 1);
}

template <typename S>
void add_view(Points& points, std::vector<ControlNets<S>>& views) {
  const int degree_u = degree_of(points, 2, "columns of control points");
  const int degree_v = degree_of(points, 1, "rows of control points");
  const int components = components_of(points);
  const std::vector<std::ptrdiff_t> strides = element_strides(points.array);
  views.push_back({static_cast<const S*>(points.array.data()),
                   static_cast<std::size_t>(points.array.shape(0)),
                   degree_u,
                   degree_v,
                   strides[0],
                   strides[1],
                   strides[2],
                   strides[3],
                   components,
                   points.weights,
                   {}});
}

template <typename S>
void add_view(Points& points, std::vector<ControlCurves<S>>& views) {
  const int degree = degree_of(points, 1, "control points");
  const int components = components_of(points);
  const std::vector<std::ptrdiff_t> strides = element_strides(points.array);
  views.push_back({static_cast<const S*>(points.array.data()),
                   static_cast<std::size_t>(points.array.shape(0)),
                   degree,
                   strides[0],
                   strides[1],
                   strides[2],
                   components,
                   points.weights,
                   {}});
}

template <typename S, template <typename> class View>
AnyPointViews<View> views_of(std::vector<Points>&& arrays) {
  PointViews<S, View> all;
  for (Points& points : arrays) {
    add_view<S>(points, all.views);
    all.arrays.push_back(points.array);
  }
  return all;
}

template <template <typename> class View>
AnyPointViews<View> any_views_of(std::vector<Points>&& arrays) {
  const bool is_float = holds<float>(arrays.front().array);
  return is_float ? views_of<float, View>(std::move(arrays))
                  : views_of<double, View>(std::move(arrays));
}

// Whether these are Python's integers, which numpy leaves as objects where its own are too short.
bool are_integers(const py::array& objects) {
  if (objects.dtype().kind() != 'O') {
    return false;
  }
  for (const py::handle item : objects.attr("flat")) {
    if (!py::isinstance<py::int_>(item)) {
      return false;
    }
  }
  return true;
}

} // namespace

std::string dtype_name(const py::array& array) {
  return py::str(py::object(array.dtype())).cast<std::string>();
}

std::string shape_text(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

py::array any_array(const py::object& values, const std::string& argument) {
  if (py::isinstance<py::array>(values)) {
    return values;
  }
  try {
    return numpy().attr("asarray")(values);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) {
      throw;
    }
  }
  throw_value_error(argument, "expected an array, or lists of equal lengths");
}

bool has_dimensions(const py::object& values) {
  return py::isinstance<py::array>(values) ? py::reinterpret_borrow<py::array>(values).ndim() > 0
                                           : py::isinstance<py::sequence>(values);
}

bool is_aligned(const py::array& array) { return array.attr("flags").attr("aligned").cast<bool>(); }

py::array float_array(const py::object& values, py::ssize_t dimensions,
                      const std::string& argument) {
  py::array array = any_array(values, argument);
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    throw_type_error(argument, "expected float32 or float64, found " + dtype_name(array));
  }
  if (dimensions >= 0 && array.ndim() != dimensions) {
    throw_value_error(argument, "expected " + std::to_string(dimensions) +
                                    " dimensions, found shape " + shape_text(array));
  }
  if (holds<float>(array) || holds<double>(array)) {
    return array;
  }
  const bool swapped_float = kind == 'f' && array.itemsize() == sizeof(float);
  return as_type(array, swapped_float ? "float32" : "float64");
}

std::vector<std::ptrdiff_t> element_strides(py::array& array) {
  const auto strange = [&](py::ssize_t k) {
    return array.shape(k) > 1 &&
           (array.strides(k) == 0 || array.strides(k) % array.itemsize() != 0);
  };
  bool usable = is_aligned(array);
  for (py::ssize_t k = 0; k < array.ndim(); ++k) {
    usable = usable && !strange(k);
  }
  if (!usable) {
    array = array.attr("copy")();
  }
  std::vector<std::ptrdiff_t> strides(static_cast<std::size_t>(array.ndim()));
  // Any stride will do where there is one element only, or none: it gets that of a packed array.
  std::ptrdiff_t packed = 1;
  for (py::ssize_t k = array.ndim() - 1; k >= 0; --k) {
    strides[static_cast<std::size_t>(k)] =
        array.size() > 0 && array.shape(k) > 1 ? array.strides(k) / array.itemsize() : packed;
    packed *= std::max<py::ssize_t>(array.shape(k), 1);
  }
  return strides;
}

bool wants_float(const py::object& dtype, bool points_are_float) {
  if (dtype.is_none()) {
    return points_are_float;
  }
  py::dtype wanted;
  try {
    wanted = py::dtype::from_args(dtype);
  } catch (py::error_already_set&) {
    throw_type_error("dtype",
                     "expected float32 or float64, found " + py::repr(dtype).cast<std::string>());
  }
  if (!wanted.equal(py::dtype::of<float>()) && !wanted.equal(py::dtype::of<double>())) {
    throw_type_error("dtype", "expected float32 or float64, found " +
                                  py::str(py::object(wanted)).cast<std::string>());
  }
  return wanted.equal(py::dtype::of<float>());
}

AnyPointViews<ControlNets> control_nets(const GivenPoints& given) {
  return any_views_of<ControlNets>(given_points(given, 4));
}

AnyPointViews<ControlCurves> control_curves(const GivenPoints& given) {
  const py::array array = float_array(given.points, 3, "points");
  return any_views_of<ControlCurves>(given_points({array, given.weights, given.homogeneous}, 3));
}

OwnPoints own_points(const GivenPoints& given, py::ssize_t dimensions) {
  const py::array array = float_array(given.points, dimensions, "points");
  std::vector<Points> all = given_points({array, given.weights, given.homogeneous}, dimensions);
  const Points& points = all.front();
  return {points.array.attr("copy")("C"), points.weights, components_of(points)};
}

py::object given_back(const py::array& array, Weights weights) {
  if (weights != Weights::cartesian) {
    return array;
  }
  const py::ellipsis all;
  const py::slice points(py::none(), py::int_(-1), py::none());
  const py::object whole = array;
  return py::make_tuple(whole[py::make_tuple(all, points)],
                        whole[py::make_tuple(all, py::int_(-1))]);
}

std::string homogeneous_hint(int components) {
  return components == 4 ? "; homogeneous=True takes (w x, w y, w z, w) as points with weights"
                         : "";
}

py::array_t<std::uint32_t> indices(const py::object& values, std::size_t count,
                                   const std::string& argument) {
  py::array array = any_array(values, argument);
  const char kind = array.dtype().kind();
  if ((kind != 'i' && kind != 'u') && array.size() > 0) {
    if (are_integers(array)) {
      throw_index_error(argument, "a number is outside of the set");
    }
    throw_type_error(argument, "expected integers, found " + dtype_name(array));
  }
  if (array.ndim() == 0) {
    array = numpy().attr("full")(count, array);
  }
  if (array.ndim() != 1) {
    throw_value_error(argument, "expected one dimension, found shape " + shape_text(array));
  }
  const bool outside = array.size() > 0 && (array.attr("min")().cast<double>() < 0 ||
                                            array.attr("max")().cast<double>() > 4294967295.0);
  if (outside) {
    throw_index_error(argument, "a number is outside of the set");
  }
  return contiguous<std::uint32_t>(array, argument);
}

GivenTolerance::GivenTolerance(const py::object& tolerance) : is_one_(!has_dimensions(tolerance)) {
  if (is_one_) {
    all = positive(number_or_infinity(tolerance, "tolerance"), false, "tolerance");
  } else {
    all = std::numeric_limits<double>::infinity();
    each = parameters<double>(tolerance, "tolerance");
  }
}

void GivenTolerance::require_count(std::size_t elements, const char* several) const {
  if (!is_one_ && static_cast<std::size_t>(each.size()) != elements) {
    throw_value_error("tolerance", "expected a number, or one for each of " +
                                       std::to_string(elements) + " " + several + ", found " +
                                       std::to_string(each.size()));
  }
}

} // namespace simdbezier::python
