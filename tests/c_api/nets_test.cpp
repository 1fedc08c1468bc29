// Operations on nets through simdbezier.h give the values of the C++ calls.
#include <functional>

#include "tests/c_api/support/c_values.hpp"

namespace simdbezier::tests::nets_test {
namespace {

template <typename T>
class CNets : public ::testing::Test {
protected:
  /// Four patches of degree 3 x 2.
  std::vector<T> values_ = random_values<T>(4 * 12 * 3, 8);
  ControlNets<T> nets_ = ControlNets<T>::packed(values_, 3, 2);
  simdbezier_nets c_nets_ = c_nets(values_, 3, 2);

  using Call = std::function<Report(const MutableNets<T>&)>;
  using CCall = std::function<simdbezier_status(const simdbezier_mutable_nets*)>;

  /// One operation with one output of the given degrees.
  void expect_same(int degree_u, int degree_v, const Call& call, const CCall& c_call) {
    const auto points = static_cast<std::size_t>((degree_u + 1) * (degree_v + 1));
    std::vector<T> expected(4 * points * 3);
    std::vector<T> got(expected.size());
    ASSERT_TRUE(call(MutableNets<T>::packed(std::span(expected), 4, degree_u, degree_v)));
    const simdbezier_mutable_nets room = c_room(got, degree_u, degree_v);
    EXPECT_C_OK(c_call(&room));
    expect_same_bits(got, expected, "nets");
  }
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CNets, Scalars);

TYPED_TEST(CNets, BecomeOtherNets) {
  using T = TypeParam;
  using Out = const MutableNets<T>&;
  using COut = const simdbezier_mutable_nets*;
  const auto& in = this->nets_;
  const auto* const c_in = &this->c_nets_;
  struct Case {
    int degree_u;
    int degree_v;
    std::function<Report(Out)> call;
    std::function<simdbezier_status(COut)> c_call;
  };
  const Case cases[] = {
      {5, 4, [&](Out o) { return elevate(in, o); },
       [&](COut o) { return simdbezier_elevate(c_in, o, nullptr); }},
      {2, 2, [&](Out o) { return hodograph_u(in, o); },
       [&](COut o) { return simdbezier_hodograph_u(c_in, o, nullptr); }},
      {3, 1, [&](Out o) { return hodograph_v(in, o); },
       [&](COut o) { return simdbezier_hodograph_v(c_in, o, nullptr); }},
      {3, 2, [&](Out o) { return reverse_u(in, o); },
       [&](COut o) { return simdbezier_reverse_u(c_in, o, nullptr); }},
      {3, 2, [&](Out o) { return reverse_v(in, o); },
       [&](COut o) { return simdbezier_reverse_v(c_in, o, nullptr); }},
      {2, 3, [&](Out o) { return transpose(in, o); },
       [&](COut o) { return simdbezier_transpose(c_in, o, nullptr); }},
      {3, 2,
       [&](Out o) {
         const auto mirrored = UnitParameter<T>::fraction(1, 3).mirrored();
         return segment(in, {T(0), T(1), T(0), mirrored}, o);
       },
       [&](COut o) {
         const simdbezier_parameter from_end = {1, 3, 1};
         return simdbezier_segment(c_in, simdbezier_at(0), simdbezier_at(1), simdbezier_at(0),
                                   from_end, o, nullptr);
       }},
      {3, 2,
       [&](Out o) {
         return segment(in,
                        {T(0.25), UnitParameter<T>::from_end(T(0.1)), T(0.125),
                         UnitParameter<T>::fraction(2, 3)},
                        o);
       },
       [&](COut o) {
         return simdbezier_segment(c_in, simdbezier_at(0.25), simdbezier_from_end(T(0.1)),
                                   simdbezier_at(0.125), simdbezier_fraction(2, 3), o, nullptr);
       }},
      {3, 2, [&](Out o) { return to_bezier(Basis::centred_power, in, o); },
       [&](COut o) {
         return simdbezier_to_bezier(SIMDBEZIER_BASIS_CENTRED_POWER, c_in, o, nullptr);
       }},
      {3, 2, [&](Out o) { return from_bezier(Basis::power, in, o); },
       [&](COut o) { return simdbezier_from_bezier(SIMDBEZIER_BASIS_POWER, c_in, o, nullptr); }}};
  for (const Case& one : cases) {
    SCOPED_TRACE(&one - cases);
    this->expect_same(one.degree_u, one.degree_v, one.call, one.c_call);
  }
}

TYPED_TEST(CNets, AreSplit) {
  using T = TypeParam;
  std::vector<T> expected(4 * this->values_.size());
  std::vector<T> got(expected.size());
  const std::size_t one = this->values_.size();
  const auto part = [&](std::size_t k) {
    return MutableNets<T>::packed(std::span(expected).subspan(k * one, one), 4, 3, 2);
  };
  simdbezier_mutable_nets parts[4];
  for (std::size_t k = 0; k < 4; ++k) {
    parts[k] =
        simdbezier_packed_mutable_nets_of(got.data() + k * one, one, 3, 2, 3, 0, kCScalar<T>);
  }
  ASSERT_TRUE(split(this->nets_, T(0.5), T(0.25), {part(0), part(1), part(2), part(3)}));
  EXPECT_C_OK(
      simdbezier_split(&this->c_nets_, simdbezier_at(0.5), simdbezier_at(0.25), parts, nullptr));
  expect_same_bits(got, expected, "split");
  ASSERT_TRUE(split_u(this->nets_, T(0.75), part(0), part(1)));
  ASSERT_TRUE(split_v(this->nets_, T(0.25), part(2), part(3)));
  EXPECT_C_OK(
      simdbezier_split_u(&this->c_nets_, simdbezier_at(0.75), &parts[0], &parts[1], nullptr));
  EXPECT_C_OK(
      simdbezier_split_v(&this->c_nets_, simdbezier_at(0.25), &parts[2], &parts[3], nullptr));
  expect_same_bits(got, expected, "split_u, split_v");
}

TYPED_TEST(CNets, SeenFromTheOtherEnd) {
  // A view with a negative stride: `first` says where its first control point is.
  using T = TypeParam;
  simdbezier_nets view = this->c_nets_;
  view.first = 9;
  view.point_stride = -3;
  this->expect_same(
      3, 2, [&](const MutableNets<T>& out) { return elevate(reversed_u(this->nets_), out); },
      [&](const simdbezier_mutable_nets* out) { return simdbezier_elevate(&view, out, nullptr); });
}

TYPED_TEST(CNets, HaveBounds) {
  using T = TypeParam;
  std::vector<T> expected(12);
  std::vector<T> expected_high(12);
  std::vector<T> low(12);
  std::vector<T> high(12);
  ASSERT_TRUE(control_boxes(this->nets_, {expected, expected_high}));
  EXPECT_C_OK(simdbezier_control_boxes(&this->c_nets_, c_values(low), c_values(high), nullptr));
  expect_same_bits(low, expected, "low");
  expect_same_bits(high, expected_high, "high");
  ASSERT_TRUE(tight_boxes(this->nets_, 2, {expected, expected_high}));
  EXPECT_C_OK(simdbezier_tight_boxes(&this->c_nets_, 2, c_values(low), c_values(high), nullptr));
  expect_same_bits(low, expected, "tight low");
  expect_same_bits(high, expected_high, "tight high");
  low.resize(4);
  expected.resize(4);
  ASSERT_TRUE(flatness(this->nets_, Values<T>(expected)));
  EXPECT_C_OK(simdbezier_flatness(&this->c_nets_, c_values(low), nullptr));
  expect_same_bits(low, expected, "flatness");
}

} // namespace
} // namespace simdbezier::tests::nets_test
