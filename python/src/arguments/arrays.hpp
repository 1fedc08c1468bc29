// numpy's arrays as the library's views: control points, parameters, outputs. Nothing is copied
// that lies in memory as floats or doubles, whatever its strides.
#pragma once

#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <simdbezier/control_nets.hpp>

#include "python/src/arguments/errors.hpp"

namespace simdbezier::python {

template <typename T>
[[nodiscard]] std::string scalar_name() {
  return std::is_same_v<T, float> ? "float32" : "float64";
}

/// "float64", "int32", …
[[nodiscard]] std::string dtype_name(const py::array& array);

/// Whether an array holds T as this machine has it.
template <typename T>
[[nodiscard]] bool holds(const py::array& array) {
  return py::isinstance<py::array_t<T>>(array);
}

/// numpy's array of any object. Ragged lists are refused.
[[nodiscard]] py::array any_array(const py::object& values, const std::string& argument);
/// Whether an object is an array with dimensions, or a list or the like, and not a single value.
[[nodiscard]] bool has_dimensions(const py::object& values);

[[nodiscard]] std::string shape_text(const py::array& array);

/// Whether all values lie where their type may lie, which views of bytes need not do.
[[nodiscard]] bool is_aligned(const py::array& array);

/// An array of float or double with this many dimensions: the object itself where it is one, else
/// numpy's copy of it (lists, integers, bytes in another order).
[[nodiscard]] py::array float_array(const py::object& values, py::ssize_t dimensions,
                                    const std::string& argument);

/// Strides in elements. Copies an array first that has others, has elements in common, or is not
/// aligned.
[[nodiscard]] std::vector<std::ptrdiff_t> element_strides(py::array& array);

/// The type that a set is to have: `dtype`, or else that of the points.
[[nodiscard]] bool wants_float(const py::object& dtype, bool points_are_float);

/// Control nets or curves of one type S, and the arrays that they are views of.
template <typename S, template <typename> class View>
struct PointViews {
  std::vector<View<S>> views;
  std::vector<py::array> arrays;

  /// The argument that weights came with.
  [[nodiscard]] const char* weights_argument() const {
    return views.front().weights == Weights::homogeneous ? "points" : "weights";
  }
};
template <template <typename> class View>
using AnyPointViews = std::variant<PointViews<float, View>, PointViews<double, View>>;

/// Control points as functions are given them. homogeneous: whether the last value of each point is
/// a weight that the others have been multiplied by; then there are no other weights.
struct GivenPoints {
  const py::object& points;
  const py::object& weights;
  const py::object& homogeneous;
};

/// Points (patches, rows, columns, components), or a list of such arrays for patches of several
/// degrees; weights (patches, rows, columns) likewise, or None.
[[nodiscard]] AnyPointViews<ControlNets> control_nets(const GivenPoints& given);
/// Points (curves, points, components) and weights (curves, points).
[[nodiscard]] AnyPointViews<ControlCurves> control_curves(const GivenPoints& given);

/// Control points of one spline, (rows, columns, values) or (columns, values), in one piece of
/// memory that nobody else has: values are the components, and the weight where there are weights.
struct OwnPoints {
  py::array array;
  Weights weights = Weights::none;
  int components = 0;
};
[[nodiscard]] OwnPoints own_points(const GivenPoints& given, py::ssize_t dimensions);

/// Points as they are given back: with weights beside them, a pair of views of one array.
[[nodiscard]] py::object given_back(const py::array& array, Weights weights);

/// What to add to an error about points of so many values each: four may be meant as homogeneous.
[[nodiscard]] std::string homogeneous_hint(int components);

/// `values` as a contiguous array of V with one dimension; the object itself where it is one.
template <typename V>
[[nodiscard]] py::array_t<V> contiguous(const py::object& values, const std::string& argument) {
  constexpr int kAsCalls =
      py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
  py::array_t<V, kAsCalls> array;
  try {
    array = py::array_t<V, kAsCalls>(values);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) {
      throw;
    }
    throw_type_error(argument, "expected numbers");
  }
  if (array.ndim() > 1) {
    throw_value_error(argument, "expected one dimension, found " + std::to_string(array.ndim()));
  }
  return array;
}

template <typename V>
[[nodiscard]] std::span<const V> span_of(const py::array_t<V>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// Numbers of patches or curves: any integers, none negative; a scalar is repeated `count` times.
[[nodiscard]] py::array_t<std::uint32_t> indices(const py::object& values, std::size_t count,
                                                 const std::string& argument);

/// Parameters or tolerances as a contiguous array of T; refuses all but floats and integers.
template <typename T>
[[nodiscard]] py::array_t<T> parameters(const py::object& values, const std::string& argument) {
  const py::array any = float_array(values, -1, argument);
  return contiguous<T>(any, argument);
}

/// A tolerance for all patches or curves, or one for each of them.
struct GivenTolerance {
  double all = 0;           ///< infinity for None, or where there is one each
  py::array_t<double> each; ///< empty where one is for all

  explicit GivenTolerance(const py::object& tolerance);
  /// Refuses one for each of another number of elements, which `several` names.
  void require_count(std::size_t elements, const char* several) const;

private:
  bool is_one_; ///< arrays may be empty as well
};

} // namespace simdbezier::python
