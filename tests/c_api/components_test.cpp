// The components of patches and curves that calls through simdbezier.h are asked for.
#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests::components_test {
namespace {

constexpr int kComponents = 5;
constexpr int kFirst = 2;

/// Four patches of degree 3 x 2 with five components.
template <typename T>
class CComponents : public ::testing::Test {
protected:
  void SetUp() override {
    ASSERT_TRUE(pack(ControlNets<T>::packed(values_, 3, 2, kComponents), set_));
    c_set_ = c_pack<T>(simdbezier_packed_nets_of(values_.data(), values_.size(), 3, 2, kComponents,
                                                 SIMDBEZIER_POLYNOMIAL, kCScalar<T>));
  }

  std::vector<T> values_ = random_values<T>(4 * 12 * kComponents, 6);
  PatchSet<T> set_;
  CPatchSet c_set_;
  std::vector<T> expected_ = std::vector<T>(3 * 4 * 15);
  std::vector<T> got_ = std::vector<T>(3 * 4 * 15);
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CComponents, Scalars);

TYPED_TEST(CComponents, OfPatches) {
  using T = TypeParam;
  Outputs<T> out;
  out.position = Vectors<T>::xyz(this->expected_);
  out.first_component = kFirst;
  ASSERT_TRUE(evaluate(this->set_, Grid<T>::uniform(5, 3), out));
  auto c_out = sized<simdbezier_outputs>();
  c_out.position = c_triples(this->got_);
  c_out.first_component = kFirst;
  const simdbezier_grid grid = simdbezier_uniform_grid(5, 3);
  EXPECT_C_OK(simdbezier_evaluate_grid(this->c_set_.get(), &grid, &c_out, nullptr));
  expect_same_bits(this->got_, this->expected_, "positions");
}

TYPED_TEST(CComponents, OfDerivatives) {
  using T = TypeParam;
  const std::vector<PartialDerivative<T>> wanted = {
      {1, 2, Vectors<T>::xyz(std::span(this->expected_))}};
  auto c_wanted = sized<simdbezier_partial_derivative>();
  c_wanted.order_u = 1;
  c_wanted.order_v = 2;
  c_wanted.out = c_triples(this->got_);
  const DerivativeOutputs<T> out(wanted, kFirst);
  ASSERT_TRUE(evaluate_derivatives(this->set_, Grid<T>::uniform(5, 3), out));
  const simdbezier_grid grid = simdbezier_uniform_grid(5, 3);
  EXPECT_C_OK(simdbezier_evaluate_grid_derivatives(this->c_set_.get(), &grid, &c_wanted, 1, kFirst,
                                                   nullptr));
  expect_same_bits(this->got_, this->expected_, "derivatives of grids");

  const std::vector<std::uint32_t> patch = {3, 1};
  const std::vector<T> u = {T(0.25), T(0.5)};
  auto samples = sized<simdbezier_samples>();
  samples.patch = patch.data();
  samples.u = samples.v = u.data();
  samples.patch_length = samples.u_length = samples.v_length = 2;
  samples.scalar = kCScalar<T>;
  ASSERT_TRUE(evaluate_derivatives(this->set_, Samples<T>{patch, u, u}, out));
  EXPECT_C_OK(simdbezier_evaluate_sample_derivatives(this->c_set_.get(), &samples, &c_wanted, 1,
                                                     kFirst, nullptr));
  expect_same_bits(this->got_, this->expected_, "derivatives of samples");
}

TYPED_TEST(CComponents, OfCurves) {
  using T = TypeParam;
  CurveSet<T> set;
  ASSERT_TRUE(pack(ControlCurves<T>::packed(this->values_, 3, kComponents), set));
  const CCurveSet c_set = c_pack<T>(simdbezier_packed_curves_of(
      this->values_.data(), this->values_.size(), 3, kComponents, 0, kCScalar<T>));
  CurveOutputs<T> out;
  out.position = Vectors<T>::xyz(this->expected_);
  out.first_component = kFirst;
  ASSERT_TRUE(evaluate(set, CurveGrid<T>::uniform(5), out));
  auto c_out = sized<simdbezier_curve_outputs>();
  c_out.position = c_triples(this->got_);
  c_out.first_component = kFirst;
  const simdbezier_curve_grid grid = simdbezier_uniform_curve_grid(5);
  EXPECT_C_OK(simdbezier_evaluate_curve_grid(c_set.get(), &grid, &c_out, nullptr));
  expect_same_bits(this->got_, this->expected_, "curves");
}

} // namespace
} // namespace simdbezier::tests::components_test
