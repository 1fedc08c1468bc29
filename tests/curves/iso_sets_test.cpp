// Iso-parametric curves of sets: those of the nets that they were packed from, whatever T is, where
// the set's origin is, and in which form weights were given.
#include <cstddef>
#include <deque>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/nets/shape_nets.hpp"

namespace simdbezier::tests::iso_sets_test {
namespace {

constexpr std::size_t kN = 5;

template <typename T>
std::vector<T> positions(const CurveSet<T>& curves) {
  const auto components = static_cast<std::size_t>(curves.components());
  std::vector<T> values(curves.size() * kN * components, T(-777));
  CurveOutputs<T> out;
  out.position = {values.data(), components > 1 ? values.data() + 1 : nullptr,
                  components > 2 ? values.data() + 2 : nullptr,
                  static_cast<std::ptrdiff_t>(components)};
  EXPECT_EQ(evaluate(curves, CurveGrid<T>::uniform(kN), out), Status::ok);
  return values;
}

template <typename T, typename S>
void expect_curves_of_nets(const ShapeCase& c, const PackOptions& options) {
  const RandomNets<S> nets(c, 3, 17, 1000);
  PatchSet<T> set;
  ASSERT_TRUE(pack(nets.view, set, options));
  PackOptions of_curves;
  of_curves.local_origin = options.local_origin;
  for (const double t : {0.0, 0.3, 1.0}) {
    CurveSet<T> from_set;
    CurveSet<T> from_nets;
    ASSERT_TRUE(iso_u(set, t, from_set, of_curves)) << c;
    ASSERT_TRUE(iso_u(nets.view, t, from_nets, options)) << c;
    EXPECT_EQ(positions(from_set), positions(from_nets)) << c << ", u = " << t;
    ASSERT_TRUE(iso_v(set, t, from_set, of_curves)) << c;
    ASSERT_TRUE(iso_v(nets.view, t, from_nets, options)) << c;
    EXPECT_EQ(positions(from_set), positions(from_nets)) << c << ", v = " << t;
  }
}

TEST(IsoSets, have_the_curves_of_their_nets) {
  for (const Weights weights : {Weights::none, Weights::cartesian, Weights::homogeneous}) {
    for (const ShapeCase& c : {ShapeCase{3, 3, 3, weights}, ShapeCase{2, 7, 2, weights}}) {
      for (const bool origins : {false, true}) {
        for (const double shift : {0.0, 0.1}) {
          const PackOptions options{.local_origin = origins, .relative_to = {shift, -shift, shift}};
          expect_curves_of_nets<float, float>(c, options);
          expect_curves_of_nets<float, double>(c, options);
          expect_curves_of_nets<double, float>(c, options);
          expect_curves_of_nets<double, double>(c, options);
        }
      }
    }
  }
}

/// Nets of one shape whose weights were given in both forms, in turn.
struct MixedForms {
  std::deque<RandomNets<double>> parts; ///< which do not move
  std::vector<ControlNets<double>> nets;

  MixedForms() {
    for (std::size_t k = 0; k < 4; ++k) {
      const Weights form = k % 2 == 0 ? Weights::cartesian : Weights::homogeneous;
      nets.push_back(parts.emplace_back(ShapeCase{3, 2, 3, form}, k + 1, k).view);
    }
  }
};

TEST(IsoSets, take_weights_in_both_forms) {
  const MixedForms mixed;
  PatchSet<double> set;
  ASSERT_TRUE(pack(std::span<const ControlNets<double>>(mixed.nets), set));
  CurveSet<double> curves;
  ASSERT_TRUE(iso_u(set, 0.25, curves));
  ASSERT_EQ(curves.size(), 10U);
  const std::vector<double> found = positions(curves);
  std::size_t at = 0;
  for (const ControlNets<double>& nets : mixed.nets) {
    CurveSet<double> alone;
    ASSERT_TRUE(iso_u(nets, 0.25, alone));
    for (const double expected : positions(alone)) {
      EXPECT_NEAR(found[at++], expected, 1e-14);
    }
  }
  EXPECT_EQ(at, found.size());
}

TEST(IsoSets, of_several_shapes_are_refused) {
  const RandomNets<float> first({3, 2, 3, Weights::cartesian}, 2, 1);
  const RandomNets<float> second({2, 3, 3, Weights::cartesian}, 2, 2);
  const ControlNets<float> nets[] = {first.view, second.view};
  PatchSet<float> set;
  ASSERT_TRUE(pack(std::span<const ControlNets<float>>(nets), set));
  CurveSet<float> curves;
  EXPECT_EQ(to_string(iso_v(set, 0.5, curves).status), to_string(Status::bad_degree));
  EXPECT_TRUE(curves.size() == 0);
}

} // namespace
} // namespace simdbezier::tests::iso_sets_test
