// Sets of patches of several shapes, and what packing refuses.
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/nets/shape_nets.hpp"

namespace simdbezier::tests::pack_sets_test {
namespace {

template <typename T>
void expect_mixed_sets(bool origins, int threads) {
  const std::vector<ShapeCase> shapes{{3, 3}, {2, 4},
                                      {3, 3}, {7, 2, 3, Weights::cartesian},
                                      {2, 4}, {3, 3, 3, Weights::homogeneous},
                                      {2, 4}};
  const std::vector<std::size_t> counts{20, 3, 5, 17, 40, 0, 1};
  std::vector<std::vector<T>> memory;
  std::vector<ControlNets<T>> nets;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    RandomNets<T> random(shapes[k], counts[k], k);
    memory.push_back(random.values);
    nets.push_back(random.view);
    nets.back().points = memory.back().data();
  }
  PackOptions options;
  options.local_origin = origins;
  options.threads = threads;
  PatchSet<T> set;
  ASSERT_TRUE(pack(std::span<const ControlNets<T>>(nets), set, options));
  ASSERT_EQ(set.size(), 86U);
  EXPECT_EQ(set.components(), 3);
  EXPECT_EQ(set.has_local_origins(), origins);
  EXPECT_EQ(set.storage()->buckets.size(), 3U);
  std::size_t number = 0;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    PatchSet<T> alone;
    ASSERT_TRUE(pack(nets[k], alone, options));
    for (std::size_t i = 0; i < counts[k]; ++i, ++number) {
      const detail::PatchPlace place = set.storage()->place(number);
      const detail::PatchStorage<T>& bucket = set.storage()->buckets[place.bucket];
      expect_same_patch(bucket, place.index, alone.storage()->buckets[0], i,
                        name_of(shapes[k]) + " patch " + std::to_string(number));
      const PatchShape expected{shapes[k].degree_u, shapes[k].degree_v, shapes[k].components,
                                shapes[k].weights != Weights::none};
      EXPECT_TRUE(set.shape(number) == expected);
    }
  }
  EXPECT_TRUE(set.shape(number) == (PatchShape{0, 0, 0, false}));
}

TEST(PackSets, mixed_sets_hold_what_their_parts_do) {
  for (const bool origins : {false, true}) {
    for (const int threads : {1, 3}) {
      expect_mixed_sets<float>(origins, threads);
      expect_mixed_sets<double>(origins, threads);
    }
  }
}

TEST(PackSets, memory_is_used_again_where_nobody_else_has_it) {
  const std::vector<double> points(48 * 40, 1.5);
  const std::vector<double> others(48 * 40, 2.5);
  const auto nets = [](const std::vector<double>& values, std::size_t count) {
    return ControlNets<double>::packed(values.data(), count, 3, 3);
  };
  const auto x_of = [](const PatchSet<double>& set) {
    double x[4] = {};
    double y[4];
    double z[4];
    Outputs<double> out;
    out.position = {x, y, z};
    EXPECT_EQ(evaluate(set, Grid<double>::uniform(2, 2, {0, 1}), out), Status::ok);
    return x[3];
  };
  const PackOptions again{.reuse_memory = true};
  PatchSet<double> set;
  ASSERT_TRUE(pack(nets(points, 40), set, again));
  const double* const memory = set.storage()->buckets[0].coefficients;
  ASSERT_TRUE(pack(nets(others, 39), set, again)); // it has room for them
  EXPECT_EQ(set.storage()->buckets[0].coefficients, memory);
  EXPECT_EQ(set.size(), 39U);
  EXPECT_EQ(x_of(set), 2.5);
  const PatchSet<double> copy = set;
  ASSERT_TRUE(pack(nets(points, 39), set, again));
  EXPECT_NE(set.storage()->buckets[0].coefficients, memory);
  EXPECT_EQ(x_of(copy), 2.5);
  EXPECT_EQ(x_of(set), 1.5);
  ASSERT_TRUE(pack(nets(points, 5), set, again)); // far too much memory for five
  EXPECT_LT(set.storage()->buckets[0].memory_bytes, 5 * 48 * 8 * 8);
  std::vector<double> bad = points;
  bad[48 * 4] = HUGE_VAL;
  EXPECT_EQ(pack(nets(bad, 5), set, again).status, Status::non_finite_input);
  EXPECT_TRUE(set.empty());
}

TEST(PackSets, sets_without_patches) {
  const RandomNets<float> nets({4, 2, 2}, 0, 1);
  PatchSet<float> set;
  EXPECT_EQ(set.components(), 3);
  ASSERT_TRUE(pack(nets.view, set));
  EXPECT_TRUE(set.empty());
  EXPECT_EQ(set.components(), 3);
  ASSERT_TRUE(pack(std::span<const ControlNets<float>>(), set));
  EXPECT_TRUE(set.empty());
  EXPECT_TRUE(set.shape(0) == (PatchShape{0, 0, 0, false}));
}

/// Two entries of 10 and 9 patches, of which the second is changed.
struct Fault {
  const char* name;
  Status status;
  std::function<void(ControlNets<float>&, PackOptions&)> change;
  std::size_t patch = 10;
  int point = 0;
};

TEST(PackSets, refuses_entries_that_cannot_be_packed) {
  using Nets = ControlNets<float>;
  constexpr auto kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Fault> faults{
      {"degree 0", Status::bad_degree, [](Nets& n, PackOptions&) { n.degree_u = 0; }},
      {"degree 16", Status::bad_degree, [](Nets& n, PackOptions&) { n.degree_v = 16; }},
      {"no components", Status::bad_components, [](Nets& n, PackOptions&) { n.components = 0; }},
      {"components", Status::bad_components, [](Nets& n, PackOptions&) { n.components = 17; }},
      {"not the same", Status::bad_components, [](Nets& n, PackOptions&) { n.components = 1; }},
      {"null", Status::null_input, [](Nets& n, PackOptions&) { n.points = nullptr; }},
      {"row", Status::bad_stride, [](Nets& n, PackOptions&) { n.row_stride = 0; }},
      {"point", Status::bad_stride, [](Nets& n, PackOptions&) { n.point_stride = 0; }},
      {"component", Status::bad_stride, [](Nets& n, PackOptions&) { n.component_stride = 0; }},
      {"count", Status::size_overflow,
       [](Nets& n, PackOptions&) { n.count = std::numeric_limits<std::size_t>::max(); }, 0},
      {"bytes", Status::size_overflow,
       [](Nets& n, PackOptions&) { n.count = std::numeric_limits<std::size_t>::max() / 64; }, 0},
      {"origin", Status::non_finite_input, [](Nets&, PackOptions& o) { o.relative_to[1] = kNan; },
       0, -1},
  };
  const RandomNets<float> first({2, 2, 2}, 10, 1);
  const RandomNets<float> second({4, 7, 2, Weights::cartesian}, 9, 2);
  for (const Fault& fault : faults) {
    std::vector<Nets> nets{first.view, second.view};
    PatchSet<float> set;
    ASSERT_TRUE(pack(first.view, set));
    PackOptions options;
    fault.change(nets[1], options);
    const Report report = pack(std::span<const Nets>(nets), set, options);
    EXPECT_EQ(to_string(report.status), to_string(fault.status)) << fault.name;
    EXPECT_EQ(report.item, fault.patch) << fault.name;
    EXPECT_EQ(report.point, fault.point) << fault.name;
    EXPECT_EQ(set.size(), 10U) << fault.name;
  }
  // What the nets do not have is not looked at.
  PackOptions options;
  options.relative_to[2] = kNan;
  PatchSet<float> set;
  EXPECT_TRUE(pack(first.view, set, options));
  const RandomNets<float> scalars({2, 2, 1}, 3, 1);
  Nets view = scalars.view;
  view.component_stride = 0;
  options.relative_to[1] = kNan;
  EXPECT_TRUE(pack(view, set, options));
}

/// One value of a patch that cannot be packed; the same one stands in a later patch, too.
struct BadValue {
  Weights weights;
  std::size_t channel;
  double value;
  Status status;
};

template <typename T, typename S>
void expect_faults(const std::vector<BadValue>& values, Isa isa, int threads) {
  for (const BadValue& bad : values) {
    const ShapeCase c{5, 6, 2, bad.weights};
    const RandomNets<S> fine({2, 2, 2}, 30, 1);
    RandomNets<S> nets(c, 40, 2);
    constexpr std::size_t kPoint = 23;
    for (const std::size_t patch : {21U, 22U, 39U}) {
      nets.values[patch * c.values() + kPoint * c.channels() + bad.channel] =
          static_cast<S>(bad.value);
    }
    nets.values[20 * c.values()] = static_cast<S>(1e20); // large, and no fault
    const std::vector<ControlNets<S>> all{fine.view, nets.view};
    PackOptions options;
    options.isa = isa;
    options.threads = threads;
    PatchSet<T> set;
    const Report report = pack(std::span<const ControlNets<S>>(all), set, options);
    const std::string what = name_of(c) + " " + std::to_string(bad.value);
    EXPECT_EQ(to_string(report.status), to_string(bad.status)) << what;
    EXPECT_EQ(report.item, bad.status == Status::ok ? 0 : 51U) << what;
    EXPECT_EQ(report.component, static_cast<int>(bad.channel) * (bad.status != Status::ok)) << what;
    const bool named = bad.status == Status::bad_weight || bad.status == Status::non_finite_input;
    EXPECT_EQ(report.point, named ? static_cast<int>(kPoint) : 0) << what;
    EXPECT_EQ(set.size(), bad.status == Status::ok ? 70U : 0U) << what;
  }
}

TEST(PackSets, weights_of_no_kind_are_refused) {
  RandomNets<float> nets({3, 3, 3, Weights::cartesian}, 2, 5);
  nets.view.weights = static_cast<Weights>(3);
  PatchSet<float> set;
  EXPECT_EQ(to_string(pack(nets.view, set).status), to_string(Status::bad_components));
  ControlCurves<float> curves = ControlCurves<float>::packed(nets.values.data(), 2, 3);
  curves.weights = static_cast<Weights>(3);
  CurveSet<float> curve_set;
  EXPECT_EQ(to_string(pack(curves, curve_set).status), to_string(Status::bad_components));
}

TEST(PackSets, the_lowest_fault_is_reported_with_its_place) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<BadValue> both;
  for (const Weights weights : {Weights::cartesian, Weights::homogeneous}) {
    for (const double weight : {0.0, -0.0, -1.0, kNan, kInfinity, -kInfinity}) {
      both.push_back({weights, 2, weight, Status::bad_weight});
    }
    both.push_back({weights, 2, 1e-30, Status::ok});
    both.push_back({weights, 1, kNan, Status::non_finite_input});
  }
  both.push_back({Weights::none, 0, kInfinity, Status::non_finite_input});
  both.push_back({Weights::none, 1, kNan, Status::non_finite_input});
  std::vector<BadValue> narrowed = both;
  narrowed.push_back({Weights::cartesian, 2, 1e-60, Status::bad_weight});
  narrowed.push_back({Weights::cartesian, 2, 1.1e-38, Status::bad_weight}); // 1/w is infinite soon
  narrowed.push_back({Weights::homogeneous, 2, 1e-39, Status::bad_weight});
  narrowed.push_back({Weights::cartesian, 2, 1.2e-38, Status::ok});
  narrowed.push_back({Weights::homogeneous, 2, 1e60, Status::bad_weight});
  narrowed.push_back({Weights::none, 1, 1e39, Status::coefficient_overflow});
  narrowed.push_back({Weights::cartesian, 1, 1e39, Status::coefficient_overflow});
  for (const Isa isa : available_isas()) {
    for (const int threads : {1, 3}) {
      expect_faults<float, float>(both, isa, threads);
      expect_faults<double, double>(both, isa, threads);
      expect_faults<float, double>(narrowed, isa, threads);
    }
  }
}

} // namespace
} // namespace simdbezier::tests::pack_sets_test
