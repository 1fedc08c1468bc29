// The oracle of limits against cases known by hand, and against exact rationals a step of 2^-300
// towards the middle: another algorithm, another formula, another arithmetic.
#include <gtest/gtest.h>

#include "tests/properties/limits/known_normals.hpp"
#include "tests/properties/limits/limit_cases.hpp"
#include "tests/support/oracle/exact_rational.hpp"

namespace simdbezier::tests::oracle_limits_test {
namespace {

TEST(LimitOracle, KnowsWhatIsKnown) {
  for (const KnownNormal& known : known_normals()) {
    const ExactDirection found = exact_normal(IntegerNet(known.net), known.x, known.y);
    EXPECT_EQ(found.order, known.order) << known.name;
    EXPECT_LE(degrees_apart(found.direction, unit(known.direction)), 1e-13) << known.name;
  }
}

struct KnownTangent {
  const char* name;
  std::vector<Vector3> points;
  std::vector<double> weights;
  double x;
  int order;
  Vector3 direction;
};

TEST(LimitOracle, KnowsTangents) {
  const Vector3 o{};
  const KnownTangent cases[] = {
      {"two points equal", {o, o, {1, 2, 0}}, {1, 1, 1e-4}, -1, 1, {1, 2, 0}},
      {"at the other end", {{1, 2, 0}, o, o}, {1e-4, 1, 1}, 1, 1, {-1, -2, 0}},
      {"three points equal", {o, o, o, {0, -2, 0}}, {}, -1, 2, {0, -1, 0}},
      // (t - 1/2)^2, (t - 1/2)^3: from above.
      {"cusp in the middle", {{3, -3, 0}, {-1, 3, 0}, {-1, -3, 0}, {3, 3, 0}}, {}, 0, 1, {1, 0, 0}},
      {"point", {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {1, 5, 2}, 0.25, -1, o},
      {"line", {{1, 2, 3}, {1, 2, 4}}, {}, 0.25, 0, {0, 0, 1}},
  };
  for (const KnownTangent& known : cases) {
    const Net curve{static_cast<int>(known.points.size()) - 1, 0, known.points, known.weights};
    const ExactDirection found = exact_tangent(IntegerNet(curve), known.x);
    EXPECT_EQ(found.order, known.order) << known.name;
    EXPECT_LE(degrees_apart(found.direction, unit(known.direction)), 1e-13) << known.name;
  }
}

/// du x dv at p + step * d.
[[nodiscard]] Vector3q pulled_cross(const Net& net, double x, double y, const Rational& step) {
  const bool middle = x == 0 && y == 0;
  const auto pulled = [&](double at) -> Rational {
    return middle ? Rational((1 + step) / 2) : Rational((1 + exact(at) * (1 - step)) / 2);
  };
  const Rational u = pulled(x);
  const Rational v = pulled(y);
  const ExactChannel weight = exact_channel_at(net, u, v, 3);
  Vector3q du;
  Vector3q dv;
  for (std::size_t c = 0; c < 3; ++c) {
    const ExactChannel h = exact_channel_at(net, u, v, c);
    const ExactChannel at = net.is_rational() ? exact_quotient(h, weight) : h;
    du[c] = at.du;
    dv[c] = at.dv;
  }
  return {du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
          du[0] * dv[1] - du[1] * dv[0]};
}

/// Its direction, and the binary exponent of its size.
[[nodiscard]] std::pair<Vector3, long> direction_of(const Vector3q& a) {
  Vector3z numerators;
  const Integer common = a[0].get_den() * a[1].get_den() * a[2].get_den();
  for (std::size_t c = 0; c < 3; ++c) {
    numerators[c] = a[c].get_num() * (common / a[c].get_den());
  }
  long size = 0;
  for (const Integer& value : numerators) {
    size = std::max(size, value == 0 ? 0 : static_cast<long>(mpz_sizeinbase(value.get_mpz_t(), 2)));
  }
  return {first_direction({numerators}).direction,
          size - static_cast<long>(mpz_sizeinbase(common.get_mpz_t(), 2))};
}

class FinitePull : public ::testing::Test {
protected:
  /// The direction 2^-300 of the way in, and how fast du x dv grows from there.
  void expect_agreement(const LimitNet& net, const LimitSample& sample,
                        const ExactDirection& found) const {
    const auto [direction, size] = direction_of(pulled_cross(net.net, sample.x, sample.y, near_));
    EXPECT_LE(degrees_apart(direction, found.direction), 1e-12) << described(net, sample);
    if (found.order >= 0) {
      const auto further = direction_of(pulled_cross(net.net, sample.x, sample.y, nearer_));
      EXPECT_NEAR(static_cast<double>(size - further.second), 100 * found.order, 4)
          << described(net, sample);
    }
  }
  [[nodiscard]] static Rational power_of_half(mp_bitcnt_t exponent) {
    Rational result = 1;
    mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), exponent);
    return result;
  }

private:
  Rational near_ = power_of_half(300);
  Rational nearer_ = power_of_half(400);
};

// Three samples that are not regular of every net, and one that is.
TEST_F(FinitePull, GivesTheSame) {
  std::size_t limits = 0;
  for (const bool doubles : {false, true}) {
    for (const LimitNet& net : limit_nets({doubles, doubles}, 38, 5)) {
      if (net.net.points.size() > 24) {
        continue;
      }
      const IntegerNet integers(net.net);
      std::size_t left[] = {1, 3};
      for (const LimitSample& sample : net.samples) {
        std::size_t& more = left[sample.status == SampleStatus::regular ? 0 : 1];
        if (more > 0) {
          --more;
          const ExactDirection found = exact_normal(integers, sample.x, sample.y);
          expect_agreement(net, sample, found);
          limits += found.order > 0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(limits, 60U);
}

} // namespace
} // namespace simdbezier::tests::oracle_limits_test
