// Curves through simdbezier.h give the bits of the C++ calls.
#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests::curves_test {
namespace {

/// Five rational patches of degree 4 x 2, for curves that lie on them.
template <typename T>
class CCurves : public ::testing::Test {
protected:
  void SetUp() override {
    ASSERT_TRUE(pack(ControlNets<T>::packed(values_, 4, 2, 3, Weights::cartesian), set_));
    c_set_ = c_pack<T>(c_nets(values_, 4, 2, SIMDBEZIER_CARTESIAN));
  }

  std::vector<T> values_ = random_values<T>(5 * 15 * 4, 3);
  PatchSet<T> set_;
  CPatchSet c_set_;
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CCurves, Scalars);

TYPED_TEST(CCurves, OfCurves) {
  using T = TypeParam;
  const std::vector<T> values = random_values<T>(7 * 3 * 4, 5);
  CurveSet<T> set;
  ASSERT_TRUE(pack(ControlCurves<T>::packed(values), set));
  const CCurveSet c_set =
      c_pack<T>(simdbezier_packed_curves_of(values.data(), values.size(), 3, 3, 0, kCScalar<T>));

  std::vector<std::vector<T>> expected(4, std::vector<T>(3 * 7 * 6));
  std::vector<std::vector<T>> got = expected;
  std::vector<T> curvature(7 * 6);
  std::vector<T> got_curvature = curvature;
  CurveOutputs<T> out;
  auto c_out = sized<simdbezier_curve_outputs>();
  simdbezier_vectors* const members[] = {&c_out.position, &c_out.d1, &c_out.d2, &c_out.tangent};
  for (std::size_t k = 0; k < 4; ++k) {
    out[static_cast<CurveOutput>(k)] = Vectors<T>::xyz(expected[k]);
    *members[k] = c_triples(got[k]);
  }
  out.curvature = curvature;
  c_out.curvature = c_values(got_curvature);
  const auto expect_same = [&](Status status, simdbezier_status c_status) {
    ASSERT_TRUE(status);
    EXPECT_EQ(c_status, SIMDBEZIER_OK) << simdbezier_last_message();
    for (std::size_t k = 0; k < 4; ++k) {
      expect_same_bits(got[k], expected[k], "a vector of curves");
    }
    expect_same_bits(got_curvature, curvature, "curvature of curves");
  };

  const simdbezier_curve_grid grid = simdbezier_uniform_curve_grid(6);
  EXPECT_EQ(simdbezier_curve_grid_sample_count(c_set.get(), &grid), 42U);
  EXPECT_EQ(simdbezier_curve_grid_sample_count(nullptr, &grid), 0U);
  expect_same(evaluate(set, CurveGrid<T>::uniform(6), out),
              simdbezier_evaluate_curve_grid(c_set.get(), &grid, &c_out, nullptr));
  const std::vector<std::uint32_t> n = {4, 5};
  auto grids = sized<simdbezier_curve_grids>();
  grids.n = n.data();
  grids.n_length = 2;
  grids.first_curve = 3;
  EXPECT_EQ(simdbezier_curve_grids_sample_count(c_set.get(), &grids), 9U);
  EXPECT_EQ(simdbezier_curve_grids_sample_count(c_set.get(), nullptr), 0U);
  expect_same(evaluate(set, CurveGrids{n, {}, 3}, out),
              simdbezier_evaluate_curve_grids(c_set.get(), &grids, &c_out, nullptr));
  const std::vector<T> t = {T(0.2), T(0.7)};
  auto samples = sized<simdbezier_curve_samples>();
  samples.curve = n.data();
  samples.t = t.data();
  samples.curve_length = samples.t_length = 2;
  samples.scalar = kCScalar<T>;
  expect_same(evaluate(set, CurveSamples<T>{n, t}, out),
              simdbezier_evaluate_curve_samples(c_set.get(), &samples, &c_out, nullptr));
}

TYPED_TEST(CCurves, AreWhatTheyWerePackedFrom) {
  using T = TypeParam;
  for (const int rational : {0, 1}) { // 7 cubics, or 7 rational parabolas
    const int degree = 3 - rational;
    const Weights weights = rational != 0 ? Weights::cartesian : Weights::none;
    const std::vector<T> values = random_values<T>(7 * 3 * 4, 5);
    CurveSet<T> set;
    ASSERT_TRUE(pack(ControlCurves<T>::packed(values, degree, 3, weights), set));
    const CCurveSet c_set = c_pack<T>(simdbezier_packed_curves_of(
        values.data(), values.size(), degree, 3, rational, kCScalar<T>));
    EXPECT_EQ(simdbezier_curve_set_size(c_set.get()), 7U);
    EXPECT_EQ(simdbezier_curve_set_scalar(c_set.get()), kCScalar<T>);
    EXPECT_EQ(simdbezier_curve_set_degree(c_set.get()), degree);
    EXPECT_EQ(simdbezier_curve_set_components(c_set.get()), 3);
    EXPECT_EQ(simdbezier_curve_set_rational(c_set.get()), rational);
    EXPECT_EQ(simdbezier_curve_set_has_local_origins(c_set.get()), 0);
    const CurveErrorBounds bounds = error_bounds(set, 1);
    auto c_bounds = sized<simdbezier_error_bounds_of_curve>();
    EXPECT_C_OK(simdbezier_curve_error_bounds(c_set.get(), 1, 0, &c_bounds));
    EXPECT_EQ(std::memcmp(c_bounds.d2, bounds.d2, sizeof bounds.d2), 0);
  }
}

TYPED_TEST(CCurves, OfIsoCurves) {
  using T = TypeParam;
  const auto nets = ControlNets<T>::packed(this->values_, 4, 2, 3, Weights::cartesian);
  const simdbezier_nets c_view = c_nets(this->values_, 4, 2, SIMDBEZIER_CARTESIAN);
  for (const bool in_u : {false, true}) {
    CurveSet<T> curves;
    ASSERT_TRUE(in_u ? iso_u(this->set_, 0.3, curves) : iso_v(this->set_, 0.3, curves));
    simdbezier_curve_set* made = nullptr;
    EXPECT_C_OK(
        (in_u ? simdbezier_iso_u : simdbezier_iso_v)(this->c_set_.get(), 0.3, nullptr, &made));
    const CCurveSet c_curves(made);
    std::vector<T> expected(3 * 5 * 9);
    std::vector<T> got(expected.size());
    CurveOutputs<T> out;
    out.position = Vectors<T>::xyz(expected);
    ASSERT_TRUE(evaluate(curves, CurveGrid<T>::uniform(9), out));
    auto c_out = sized<simdbezier_curve_outputs>();
    c_out.position = c_triples(got);
    const simdbezier_curve_grid grid = simdbezier_uniform_curve_grid(9);
    EXPECT_C_OK(simdbezier_evaluate_curve_grid(c_curves.get(), &grid, &c_out, nullptr));
    expect_same_bits(got, expected, in_u ? "iso_u()" : "iso_v()");

    std::vector<double> points(5 * (in_u ? 3 : 5) * 4);
    std::vector<double> c_points(points.size());
    const Values<double> to(points);
    ASSERT_TRUE(in_u ? iso_u(nets, 0.6, to) : iso_v(nets, 0.6, to));
    EXPECT_C_OK((in_u ? simdbezier_iso_u_points : simdbezier_iso_v_points)(
        &c_view, 0.6, c_points.data(), c_points.size(), nullptr));
    expect_same_bits(c_points, points, "points of iso-curves");
  }

  auto edge = sized<simdbezier_control_curves>();
  EXPECT_C_OK(simdbezier_boundary_curves(&c_view, SIMDBEZIER_EDGE_U1, &edge));
  EXPECT_EQ(edge.first, 16);
  EXPECT_EQ(edge.degree, 2);
  EXPECT_EQ(simdbezier_curve_set_size(c_pack<T>(edge).get()), 5U);
}

} // namespace
} // namespace simdbezier::tests::curves_test
