// Every operation on control nets behind one signature: a batch in, batches out. Tests that hold
// for all of them run over this list.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/nets/net_batches.hpp"

namespace simdbezier::tests {

template <typename T>
struct Operation {
  std::string name;
  std::function<bool(const Shape&)> takes;
  /// Results as plain values, one list an output.
  std::function<Report(const ControlNets<T>&, const Shape&, std::vector<std::vector<T>>&,
                       const Options&)>
      run;
};

/// An operation whose results are `outputs` batches of one shape.
template <typename T, typename Result, typename Call>
Operation<T> net_operation(
    std::string name, std::size_t outputs, Result result, Call call,
    std::function<bool(const Shape&)> takes = [](const Shape&) { return true; }) {
  return {std::move(name), std::move(takes),
          [=](const ControlNets<T>& nets, const Shape& shape, std::vector<std::vector<T>>& values,
              const Options& options) {
            std::vector<Batch<T>> batches(outputs, Batch<T>(result(shape), nets.count));
            std::vector<MutableNets<T>> out;
            for (Batch<T>& batch : batches) {
              out.push_back(batch.out());
            }
            const Report report = call(nets, out, options);
            values.clear();
            for (Batch<T>& batch : batches) {
              values.push_back(std::move(batch.values));
            }
            return report;
          }};
}

/// An operation whose results are one row of numbers a patch.
template <typename T, typename Call>
Operation<T> bound_operation(std::string name, std::size_t outputs, bool scalar, Call call) {
  return {std::move(name), [](const Shape&) { return true; },
          [=](const ControlNets<T>& nets, const Shape& shape, std::vector<std::vector<T>>& values,
              const Options& options) {
            const std::size_t row = scalar ? 1 : static_cast<std::size_t>(shape.components);
            values.assign(outputs, std::vector<T>(row * nets.count, T(-77)));
            return call(nets, values, options);
          }};
}

inline Shape unchanged(const Shape& shape) { return shape; }
inline bool is_polynomial(const Shape& shape) { return shape.weights == Weights::none; }
inline bool is_bicubic(const Shape& shape) {
  return is_polynomial(shape) && shape.degree_u == 3 && shape.degree_v == 3;
}

template <typename T>
std::vector<Operation<T>> cutting_operations() {
  using Nets = ControlNets<T>;
  using Out = std::vector<MutableNets<T>>;
  const UnitParameter<T> third(T(1) / 3); // made before a test changes the rounding mode
  return {net_operation<T>("SplitU", 2, unchanged,
                           [=](const Nets& n, const Out& o, const Options& options) {
                             return split_u(n, third, o[0], o[1], options);
                           }),
          net_operation<T>("SplitV", 2, unchanged,
                           [](const Nets& n, const Out& o, const Options& options) {
                             return split_v(n, T(0.75), o[0], o[1], options);
                           }),
          net_operation<T>("Split", 4, unchanged,
                           [=](const Nets& n, const Out& o, const Options& options) {
                             return split(n, third, T(0.5), {o[0], o[1], o[2], o[3]}, options);
                           }),
          net_operation<T>("Segment", 1, unchanged,
                           [=](const Nets& n, const Out& o, const Options& options) {
                             return segment(n, {T(0.125), third, third, T(1)}, o[0], options);
                           })};
}

template <typename T>
std::vector<Operation<T>> degree_operations() {
  using Nets = ControlNets<T>;
  using Out = std::vector<MutableNets<T>>;
  return {net_operation<T>(
              "Elevate", 1,
              [](Shape shape) {
                shape.degree_u = std::min(shape.degree_u + 2, kMostDegree);
                shape.degree_v = std::min(shape.degree_v + 1, kMostDegree);
                return shape;
              },
              [](const Nets& n, const Out& o, const Options& options) {
                return elevate(n, o[0], options);
              }),
          net_operation<T>(
              "HodographU", 1,
              [](Shape shape) {
                shape.degree_u = std::max(shape.degree_u - 1, 1);
                return shape;
              },
              [](const Nets& n, const Out& o, const Options& options) {
                return hodograph_u(n, o[0], options);
              },
              is_polynomial),
          net_operation<T>(
              "HodographV", 1,
              [](Shape shape) {
                shape.degree_v = std::max(shape.degree_v - 1, 1);
                return shape;
              },
              [](const Nets& n, const Out& o, const Options& options) {
                return hodograph_v(n, o[0], options);
              },
              is_polynomial)};
}

template <typename T>
std::vector<Operation<T>> reordering_operations() {
  using Nets = ControlNets<T>;
  using Out = std::vector<MutableNets<T>>;
  return {net_operation<T>("ReverseU", 1, unchanged,
                           [](const Nets& n, const Out& o, const Options& options) {
                             return reverse_u(n, o[0], options);
                           }),
          net_operation<T>("ReverseV", 1, unchanged,
                           [](const Nets& n, const Out& o, const Options& options) {
                             return reverse_v(n, o[0], options);
                           }),
          net_operation<T>(
              "Transpose", 1,
              [](const Shape& s) {
                return Shape{s.degree_v, s.degree_u, s.components, s.weights};
              },
              [](const Nets& n, const Out& o, const Options& options) {
                return transpose(n, o[0], options);
              })};
}

template <typename T>
std::vector<Operation<T>> bounding_operations() {
  using Nets = ControlNets<T>;
  using Values = std::vector<std::vector<T>>;
  return {
      bound_operation<T>("ControlBoxes", 2, false,
                         [](const Nets& n, Values& v, const Options& options) {
                           return control_boxes(n, {v[0].data(), v[1].data()}, options);
                         }),
      bound_operation<T>("TightBoxes", 2, false,
                         [](const Nets& n, Values& v, const Options& options) {
                           return tight_boxes(n, 1, {v[0].data(), v[1].data()}, options);
                         }),
      bound_operation<T>("Flatness", 1, true, [](const Nets& n, Values& v, const Options& options) {
        return flatness(n, v[0].data(), options);
      })};
}

template <typename T>
std::vector<Operation<T>> basis_operations() {
  using Nets = ControlNets<T>;
  using Out = std::vector<MutableNets<T>>;
  std::vector<Operation<T>> list;
  const char* const names[] = {"Power", "CentredPower", "Hermite", "CatmullRom", "BSpline"};
  for (int b = 0; b < 5; ++b) {
    const auto basis = static_cast<Basis>(b);
    const std::function<bool(const Shape&)> takes =
        b < 2 ? std::function<bool(const Shape&)>(is_polynomial) : is_bicubic;
    list.push_back(net_operation<T>(
        std::string("To") + names[b], 1, unchanged,
        [=](const Nets& n, const Out& o, const Options& options) {
          return from_bezier(basis, n, o[0], options);
        },
        takes));
    list.push_back(net_operation<T>(
        std::string("From") + names[b], 1, unchanged,
        [=](const Nets& n, const Out& o, const Options& options) {
          return to_bezier(basis, n, o[0], options);
        },
        takes));
  }
  return list;
}

template <typename T>
std::vector<Operation<T>> all_operations() {
  std::vector<Operation<T>> all;
  for (const auto& list :
       {cutting_operations<T>(), degree_operations<T>(), reordering_operations<T>(),
        bounding_operations<T>(), basis_operations<T>()}) {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

} // namespace simdbezier::tests
