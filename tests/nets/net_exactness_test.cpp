// Results against exact rationals: within the bounds of nets.hpp, and exact where that is promised.
#include <gtest/gtest.h>

#include "tests/nets/net_batches.hpp"

namespace simdbezier::tests::net_exactness_test {
namespace {

constexpr std::size_t kCount = 3;

/// The largest error of `result` over [u0,u1] x [v0,v1] of `batch`, in u max|P|.
template <typename T>
double largest_error(const Batch<T>& batch, const Batch<T>& result, const Rational (&u)[2],
                     const Rational (&v)[2]) {
  const Rational parameters[] = {Rational(0), Rational(1, 3), Rational(1, 2), Rational(1)};
  double largest = 0;
  for (std::size_t p = 0; p < batch.count; ++p) {
    const double unit = kUnitRoundoff<T> * largest_value(batch, p);
    for (const Rational& s : parameters) {
      for (const Rational& t : parameters) {
        const auto expected = exact_point(batch, p, Rational(u[0] + s * (u[1] - u[0])),
                                          Rational(v[0] + t * (v[1] - v[0])));
        const auto found = exact_point(result, p, s, t);
        for (std::size_t c = 0; c < expected.size(); ++c) {
          const Rational error = abs(found[c] - expected[c]);
          largest = std::max(largest, error.get_d() / unit);
        }
      }
    }
  }
  return largest;
}

/// 2 u for cartesian weights, and as much again for a division whose numerator is as wrong as its
/// denominator.
double rational_slack(const Shape& shape, double bound) {
  return shape.weights == Weights::none ? bound : 2 * bound + 4;
}

template <typename T>
class NetExactness : public ::testing::Test {};
using Types = ::testing::Types<float, double>;
TYPED_TEST_SUITE(NetExactness, Types);

TYPED_TEST(NetExactness, Split) {
  using T = TypeParam;
  const T u = T(0.6875);
  const T v = T(1) / 3; // whose complement is rounded
  for (const Shape& shape : all_shapes()) {
    const Batch<T> batch = random_batch<T>(shape, kCount, 21);
    std::array<Batch<T>, 4> parts;
    parts.fill(Batch<T>(shape, kCount));
    ASSERT_TRUE(split(batch.nets(), u, v,
                      {parts[0].out(), parts[1].out(), parts[2].out(), parts[3].out()}));
    const Rational us[] = {0, rational_of(u), 1};
    const Rational vs[] = {0, rational_of(v), 1};
    const double bound = rational_slack(shape, 3.0 * (shape.degree_u + shape.degree_v));
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_LE(
          largest_error(batch, parts[k], {us[k % 2], us[k % 2 + 1]}, {vs[k / 2], vs[k / 2 + 1]}),
          bound)
          << shape.name() << ", part " << k;
    }
  }
}

TYPED_TEST(NetExactness, Segment) {
  using T = TypeParam;
  const SubPatch<T> piece{T(0.25), T(0.875), T(0.75), T(0.0625)}; // backwards in v
  for (const Shape& shape : all_shapes()) {
    const Batch<T> batch = random_batch<T>(shape, kCount, 22);
    Batch<T> result(shape, kCount);
    ASSERT_TRUE(segment(batch.nets(), piece, result.out()));
    const double bound = rational_slack(shape, 3.0 * (shape.degree_u + shape.degree_v) + 2);
    EXPECT_LE(largest_error(batch, result, {rational(0.25), rational(0.875)},
                            {rational(0.75), rational(0.0625)}),
              bound)
        << shape.name();
  }
}

TYPED_TEST(NetExactness, Elevation) {
  using T = TypeParam;
  for (const Shape& shape : all_shapes()) {
    const Batch<T> batch = random_batch<T>(shape, kCount, 23);
    for (const int steps : {1, 2, 14}) {
      Shape higher = shape;
      higher.degree_u = std::min(shape.degree_u + steps, kMostDegree);
      higher.degree_v = std::min(shape.degree_v + 1, kMostDegree);
      Batch<T> result(higher, kCount);
      ASSERT_TRUE(elevate(batch.nets(), result.out()));
      const double roundings = sizeof(T) == 4 ? 1.01 : shape.degree_u + shape.degree_v + 4.0;
      EXPECT_LE(
          largest_error(batch, result, {Rational(0), Rational(1)}, {Rational(0), Rational(1)}),
          rational_slack(shape, roundings))
          << shape.name();
    }
  }
}

// Integers that are halved: no product or sum needs more bits than the type has.
TYPED_TEST(NetExactness, HalvesOfIntegersAreExact) {
  using T = TypeParam;
  for (const Shape& shape : all_shapes()) {
    if (shape.degree_u + shape.degree_v > 10 || shape.weights == Weights::cartesian) {
      continue;
    }
    const Batch<T> batch = integer_batch<T>(shape, kCount, 24);
    std::array<Batch<T>, 4> parts;
    parts.fill(Batch<T>(shape, kCount));
    ASSERT_TRUE(split(batch.nets(), T(0.5), T(0.5),
                      {parts[0].out(), parts[1].out(), parts[2].out(), parts[3].out()}));
    const Rational halves[] = {0, Rational(1, 2), 1};
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(largest_error(batch, parts[k], {halves[k % 2], halves[k % 2 + 1]},
                              {halves[k / 2], halves[k / 2 + 1]}),
                0)
          << shape.name() << ", part " << k;
    }
  }
}

/// The exact control points of the derivative.
TYPED_TEST(NetExactness, Hodographs) {
  using T = TypeParam;
  for (const Shape& shape : all_shapes()) {
    if (shape.weights != Weights::none) {
      continue;
    }
    const Batch<T> batch = random_batch<T>(shape, kCount, 25);
    Shape in_u = shape;
    Shape in_v = shape;
    in_u.degree_u = std::max(shape.degree_u - 1, 1);
    in_v.degree_v = std::max(shape.degree_v - 1, 1);
    Batch<T> du(in_u, kCount);
    Batch<T> dv(in_v, kCount);
    ASSERT_TRUE(hodograph_u(batch.nets(), du.out()));
    ASSERT_TRUE(hodograph_v(batch.nets(), dv.out()));
    const double roundings = sizeof(T) == 4 ? 1 : 2;
    const auto expect_near = [&](T found, int degree, T from, T to) {
      const Rational exact = degree * (rational_of(to) - rational_of(from));
      const Rational error = abs(rational_of(found) - exact);
      EXPECT_LE(error.get_d(), 1.01 * roundings * kUnitRoundoff<T> * std::abs(exact.get_d()));
    };
    for (std::size_t p = 0; p < kCount; ++p) {
      for (std::size_t c = 0; c < batch.channels(); ++c) {
        for (int j = 0; j <= in_u.degree_v; ++j) {
          for (int i = 0; i <= in_u.degree_u; ++i) {
            const int k = shape.degree_u == 1 ? 0 : i;
            expect_near(du.at(p, j, i, c), shape.degree_u, batch.at(p, j, k, c),
                        batch.at(p, j, k + 1, c));
          }
        }
        for (int j = 0; j <= in_v.degree_v; ++j) {
          for (int i = 0; i <= in_v.degree_u; ++i) {
            const int k = shape.degree_v == 1 ? 0 : j;
            expect_near(dv.at(p, j, i, c), shape.degree_v, batch.at(p, k, i, c),
                        batch.at(p, k + 1, i, c));
          }
        }
      }
    }
  }
}

// Outside of [0,1] polynomial nets extrapolate.
TYPED_TEST(NetExactness, Extrapolation) {
  using T = TypeParam;
  const Batch<T> batch = random_batch<T>({3, 2, 3, Weights::none}, kCount, 26);
  Batch<T> result(batch.shape, kCount);
  ASSERT_TRUE(segment(batch.nets(), {T(-0.5), T(1.5), T(0), T(1)}, result.out()));
  EXPECT_LE(
      largest_error(batch, result, {Rational(-1, 2), Rational(3, 2)}, {Rational(0), Rational(1)}),
      300); // 2^3 per level of growth
}

} // namespace
} // namespace simdbezier::tests::net_exactness_test
