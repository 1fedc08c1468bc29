// See derivatives.hpp.
#include "python/src/derivatives.hpp"

namespace simdbezier::python {
namespace {

int order_of(const py::object& value, const char* argument) {
  const std::size_t order = integer(value, 0, argument);
  if (order > std::size_t{kMostDerivativeOrder}) {
    throw_value_error(argument, "expected orders of at most " +
                                    std::to_string(kMostDerivativeOrder) + ", found " +
                                    std::to_string(order));
  }
  return static_cast<int>(order);
}

bool is_pair(const py::handle& object) {
  return py::isinstance<py::sequence>(object) && !py::isinstance<py::str>(object) &&
         py::len(object) == 2;
}

/// The derivative that a pair of orders, or for curves an order, asks for.
WantedDerivative derivative_of(const py::object& orders, bool of_curve, const char* argument) {
  if (of_curve) {
    const int order = order_of(orders, argument);
    return {order, 0, py::int_(order)};
  }
  const int u = order_of(orders[py::int_(0)], argument);
  const int v = order_of(orders[py::int_(1)], argument);
  return {u, v, py::make_tuple(u, v)};
}

/// Adds a derivative that is not wanted yet.
void add(const WantedDerivative& one, std::vector<WantedDerivative>& wanted) {
  const bool known = std::any_of(wanted.begin(), wanted.end(), [&](const WantedDerivative& other) {
    return one.u == other.u && one.v == other.v;
  });
  if (!known) {
    wanted.push_back(one);
  }
}

} // namespace

std::vector<WantedDerivative> wanted_derivatives(const py::object& derivatives, bool of_curve) {
  std::vector<WantedDerivative> wanted;
  if (derivatives.is_none()) {
    return wanted;
  }
  const char* const expected = of_curve ? "expected orders, such as (1, 3)"
                                        : "expected pairs of orders, such as [(1, 0), (2, 1)]";
  if (!py::isinstance<py::iterable>(derivatives) || py::isinstance<py::str>(derivatives)) {
    throw_type_error("derivatives", expected);
  }
  for (const py::handle one : derivatives) {
    if (!of_curve && !is_pair(one)) {
      throw_value_error("derivatives", expected);
    }
    add(derivative_of(py::reinterpret_borrow<py::object>(one), of_curve, "derivatives"), wanted);
  }
  return wanted;
}

std::vector<WantedDerivative> wanted_pairs(const py::object& derivatives, const py::object& out) {
  std::vector<WantedDerivative> wanted = wanted_derivatives(derivatives, false);
  for (const auto& [key, array] : output_dict(out)) {
    if (!py::isinstance<py::tuple>(key) || !is_pair(key)) {
      throw_value_error("out", "expected pairs of orders as keys, such as (2, 1), found " +
                                   py::repr(key).cast<std::string>());
    }
    add(derivative_of(py::reinterpret_borrow<py::object>(key), false, "out"), wanted);
  }
  if (wanted.empty()) {
    throw_value_error("derivatives", "expected at least one pair of orders, such as (2, 1)");
  }
  return wanted;
}

} // namespace simdbezier::python
