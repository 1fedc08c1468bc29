// Hashes of what is neither a grid nor scattered samples of a set: derivatives of any order,
// curves, operations on control nets.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "tests/properties/bits/shape_workload.hpp"

namespace simdbezier::tests {

/// Orders below, at and above the degrees, on a grid and at scattered samples.
template <typename T>
[[nodiscard]] std::uint64_t derivatives_hash(const PatchSet<T>& set, Isa isa) {
  constexpr std::pair<int, int> kOrders[] = {{0, 0}, {1, 0}, {1, 1}, {0, 2},
                                             {3, 1}, {2, 4}, {7, 0}};
  constexpr auto kStride = static_cast<std::ptrdiff_t>(3 * std::size(kOrders));
  constexpr std::size_t nu = 9;
  constexpr std::size_t nv = 4;
  const SampleArrays<T> samples = random_samples<T>(set.size(), 1000);
  Fnv1a hash;
  const auto add = [&](std::size_t count, const auto& where) {
    std::vector<T> values(count * kStride);
    std::vector<PartialDerivative<T>> requests;
    for (const auto& [order_u, order_v] : kOrders) {
      T* const first = values.data() + 3 * requests.size();
      requests.push_back({order_u, order_v, Vectors<T>::xyz(first, kStride)});
    }
    const std::span<const PartialDerivative<T>> all(requests);
    hash.add(
        static_cast<int>(evaluate_derivatives(set, where, all, {.threads = 2, .isa = isa}).code()));
    hash.add_all(std::span<const T>(values));
  };
  add(set.size() * nu * nv, Grid<T>::uniform(nu, nv));
  add(samples.patch.size(), samples.view(Parameters::centred));
  return hash.value();
}

/// Every output of one call for curves.
template <typename T, typename Where>
void add_curves(Fnv1a& hash, const CurveSet<T>& set, const Where& where, std::size_t count,
                Isa isa) {
  std::vector<T> values(13 * count);
  std::vector<SampleStatus> status(count);
  CurveOutputs<T> out;
  for (std::size_t g = 0; g < kCurveVectorOutputs; ++g) {
    out[static_cast<CurveOutput>(g)] = Vectors<T>::xyz(values.data() + 3 * g * count);
  }
  out.curvature = values.data() + 12 * count;
  out.status = status.data();
  hash.add(static_cast<int>(evaluate(set, where, out, {.threads = 2, .isa = isa}).code()));
  hash.add_all(std::span<const T>(values));
  hash.add_bytes(status.data(), status.size());
}

/// A set of curves through each of the three calls.
template <typename T>
void add_calls(Fnv1a& hash, const CurveSet<T>& set, Isa isa) {
  Random random(51);
  std::vector<std::uint32_t> counts;
  std::vector<std::uint32_t> curve;
  std::vector<T> parameters;
  std::size_t counted = 0;
  for (std::size_t k = 0; k < set.size(); ++k) {
    counts.push_back(static_cast<std::uint32_t>(2 + k % 21));
    counted += counts.back();
  }
  for (std::size_t k = 0; k < 100; ++k) {
    curve.push_back(static_cast<std::uint32_t>(random.below(set.size())));
    parameters.push_back(boundary_centred<T>(random));
  }
  for (const std::size_t n : {4U, 17U}) {
    add_curves(hash, set, CurveGrid<T>::uniform(n), n * set.size(), isa);
  }
  add_curves(hash, set, CurveGrids{counts}, counted, isa);
  add_curves(hash, set, CurveSamples<T>{curve, parameters, Parameters::centred}, curve.size(), isa);
}

/// The rows of nets as curves, and the iso-parametric curves across them.
template <typename T>
[[nodiscard]] std::uint64_t curves_hash(Isa isa) {
  Fnv1a hash;
  for (const WorkShape& shape : kWorkShapes) {
    const std::vector<Net> nets = shape_nets(shape, 5);
    const std::vector<T> points = packed_points<T>(nets);
    const ControlNets<T> control = control_nets<T>(nets, points);
    const std::size_t rows = nets.size() * static_cast<std::size_t>(shape.degrees.v + 1);
    for (const bool local_origin : {false, true}) {
      const PackOptions packing{.local_origin = local_origin};
      CurveSet<T> set;
      expect_packed(
          pack(ControlCurves<T>::packed(points.data(), rows, shape.degrees.u, 3, control.weights),
               set, packing));
      add_calls(hash, set, isa);
      expect_packed(iso_u(control, 0.3, set, packing));
      add_calls(hash, set, isa);
    }
  }
  return hash.value();
}

/// Nets for results, of the given degrees, hashed after a call.
template <typename T>
class NetResults {
public:
  NetResults(const ControlNets<T>& like, Degrees degrees)
      : values_(like.count * static_cast<std::size_t>((degrees.u + 1) * (degrees.v + 1) * 4)),
        nets_(MutableNets<T>::packed(values_.data(), like.count, degrees.u, degrees.v,
                                     like.components, like.weights)) {}
  NetResults(const NetResults&) = delete;
  NetResults& operator=(const NetResults&) = delete;

  [[nodiscard]] const MutableNets<T>& nets() const { return nets_; }
  void add_to(Fnv1a& hash, const Report& report) const {
    hash.add(static_cast<int>(report.status.code()));
    hash.add_all(std::span<const T>(values_));
  }

private:
  std::vector<T> values_;
  MutableNets<T> nets_;
};

/// Hashes operations from nets to nets. Bases that a shape is not allowed to have give their status
/// only.
template <typename T>
void add_operations(Fnv1a& hash, const ControlNets<T>& nets, const Options& options) {
  const Degrees same{nets.degree_u, nets.degree_v};
  NetResults<T> a(nets, same);
  NetResults<T> b(nets, same);
  NetResults<T> c(nets, same);
  NetResults<T> d(nets, same);
  const UnitParameter<T> third = UnitParameter<T>::fraction(1, 3);
  const Report halves =
      split(nets, third, T(0.75), {a.nets(), b.nets(), c.nets(), d.nets()}, options);
  for (const NetResults<T>* const part : {&a, &b, &c, &d}) {
    part->add_to(hash, halves);
  }
  a.add_to(hash, segment(nets, {T(0.125), third, third, T(1)}, a.nets(), options));
  a.add_to(hash, reverse_u(nets, a.nets(), options));
  a.add_to(hash, reverse_v(nets, a.nets(), options));
  for (const Basis basis :
       {Basis::power, Basis::centred_power, Basis::hermite, Basis::catmull_rom, Basis::b_spline}) {
    a.add_to(hash, to_bezier(basis, nets, a.nets(), options));
    a.add_to(hash, from_bezier(basis, nets, a.nets(), options));
  }
  const NetResults<T> turned(nets, {same.v, same.u});
  turned.add_to(hash, transpose(nets, turned.nets(), options));
  const NetResults<T> higher(nets, {std::min(same.u + 2, kMostDegree), same.v});
  higher.add_to(hash, elevate(nets, higher.nets(), options));
  const NetResults<T> du(nets, {std::max(same.u - 1, 1), same.v});
  du.add_to(hash, hodograph_u(nets, du.nets(), options));
  const NetResults<T> dv(nets, {same.u, std::max(same.v - 1, 1)});
  dv.add_to(hash, hodograph_v(nets, dv.nets(), options));
}

/// Operations on nets of each shape, and what is known of the space that they take.
template <typename T>
[[nodiscard]] std::uint64_t nets_hash(Isa isa) {
  const Options options{.threads = 2, .isa = isa};
  Fnv1a hash;
  for (const WorkShape& shape : kWorkShapes) {
    const std::vector<Net> nets = shape_nets(shape, 19);
    const std::vector<T> points = packed_points<T>(nets);
    const ControlNets<T> control = control_nets<T>(nets, points);
    add_operations(hash, control, options);
    std::vector<T> low(3 * nets.size());
    std::vector<T> high(3 * nets.size());
    const auto add_boxes = [&](const Report& report) {
      hash.add(static_cast<int>(report.status.code()));
      hash.add_all(std::span<const T>(low));
      hash.add_all(std::span<const T>(high));
    };
    add_boxes(control_boxes(control, {low.data(), high.data()}, options));
    add_boxes(tight_boxes(control, 2, {low.data(), high.data()}, options));
    std::vector<T> distance(nets.size());
    hash.add(static_cast<int>(flatness(control, distance.data(), options).status.code()));
    hash.add_all(std::span<const T>(distance));
  }
  return hash.value();
}

} // namespace simdbezier::tests
