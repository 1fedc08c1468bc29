// Patches that have no normal anywhere, because they are curves, and those that nearly are: which
// of them are decided to be so, and what samples then say, against exact rationals (GMP).
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "src/exact/normal_fallback.hpp"
#include "src/exact/zero_everywhere.hpp"
#include "tests/support/nets/degenerate_nets.hpp"
#include "tests/support/nets/net_forms.hpp"
#include "tests/support/nets/points_by_rounding.hpp"
#include "tests/support/oracle/exact_rational.hpp"
#include "tests/support/oracle/limit_oracle.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests::curve_like_test {
namespace {

// --- patches ------------------------------------------------------------------------------------

[[nodiscard]] Vector3 thirds(Random& random) {
  const Vector3 numerators = integer_vector(random, 99);
  return {numerators[0] / 3, numerators[1] / 3, numerators[2] / 3};
}

/// All rows are one, as of a cylinder without height.
[[nodiscard]] Net equal_rows(Degrees d, Random& random) {
  return repeated(shaped_net(d, [&](int, int) { return thirds(random); }), d.v + 1, 1).net;
}
/// Weights of rows times weights of columns.
[[nodiscard]] Net equal_rows_with_weights(Degrees d, Random& random) {
  Net net = equal_rows(d, random);
  for (int j = 0; j <= d.v; ++j) {
    for (int i = 0; i <= d.u; ++i) {
      net.weights.push_back((j % 3 + 1) * (i % 5 + 1));
    }
  }
  return net;
}
[[nodiscard]] Net line(Degrees d, Random& random) {
  return shaped_net(d, [&](int, int) {
    const double t = random.integer(-99, 99) / 64.0;
    return Vector3{3 * t, 5 * t, -7 * t};
  });
}
[[nodiscard]] Net one_point(Degrees d, Random& random) {
  const Vector3 point = thirds(random);
  return shaped_net(d, [&](int, int) { return point; });
}

/// sum_k c_k p^k for p = u + v, or p = u v, raised to the net's degrees and times their binomials.
template <typename Coefficient>
[[nodiscard]] Net curve_of(Degrees d, bool sum, Coefficient c) {
  const auto denominator = [](int n) {
    long all = 1;
    for (int k = 1; k <= std::min(n, 3); ++k) {
      all = std::lcm(all, static_cast<long>(choose(n, k)));
    }
    return static_cast<double>(all);
  };
  const double common = denominator(d.u) * denominator(d.v);
  const int most = std::min({d.u, d.v, 3});
  return net_of_powers(d, 0, 0, [&](int a, int b) {
    if (sum ? a + b > most : a != b) {
      return Vector3{};
    }
    const double factor = sum ? choose(a + b, a) : 1;
    return plus({}, factor * common / (choose(d.u, a) * choose(d.v, b)), c(sum ? a + b : a));
  });
}

template <bool kSum>
[[nodiscard]] Net polynomial_curve(Degrees d, Random& random) {
  const Vector3 c[4] = {integer_vector(random, 9), integer_vector(random, 9),
                        integer_vector(random, 9), integer_vector(random, 9)};
  return curve_of(d, kSum, [&](int k) { return c[k]; });
}
/// Numerators and the weight are polynomials of u + v, or of u v.
template <bool kSum>
[[nodiscard]] Net rational_curve(Degrees d, Random& random) {
  Net net = polynomial_curve<kSum>(d, random);
  const Vector3 c[4] = {{3}, {1}, {2}, {1}};
  for (const Vector3& weight : curve_of(d, kSum, [&](int k) { return c[k]; }).points) {
    net.weights.push_back(weight[0]);
  }
  net.homogeneous = true;
  return net;
}
/// S = (u, (2u - 1) v, 0) where both degrees are 1: du x dv vanishes along u = 1/2.
[[nodiscard]] Net folded(Degrees d, Random&) {
  return shaped_net(d, [&](int j, int i) { return Vector3{1.0 * i, j * (2.0 * i - d.u), 0}; });
}
/// Equal rows but for one point that is away by a prime, all other numbers being multiples of other
/// primes: modulo each of these, it is a curve.
[[nodiscard]] Net curve_modulo_primes(Degrees d, Random& random) {
  detail::Primes primes;
  const double first = primes.next();
  const double second = primes.next();
  Net net =
      repeated(shaped_net(d, [&](int, int) { return integer_vector(random, 99); }), d.v + 1, 1).net;
  for (Vector3& point : net.points) {
    point = plus({}, second, point);
  }
  net.points.back()[2] += first;
  return net;
}

struct Family {
  const char* name;
  Net (*make)(Degrees, Random&);
  bool curve;
};
constexpr Family kFamilies[] = {
    {"equal rows", equal_rows, true},
    {"equal rows with weights", equal_rows_with_weights, true},
    {"line", line, true},
    {"point", one_point, true},
    {"curve of u + v", polynomial_curve<true>, true},
    {"curve of u v", polynomial_curve<false>, true},
    {"rational curve of u + v", rational_curve<true>, true},
    {"rational curve of u v", rational_curve<false>, true},
    {"folded", folded, false},
    {"curve modulo primes", curve_modulo_primes, false},
};
constexpr Degrees kDegrees[] = {{1, 1}, {2, 1}, {1, 3},  {2, 2},  {3, 3},  {4, 2},
                                {5, 5}, {2, 9}, {15, 1}, {8, 11}, {15, 15}};

// --- what is asked ------------------------------------------------------------------------------

/// A net as the library keeps it.
template <typename T>
class Kept {
public:
  explicit Kept(const Net& net)
      : shape_{net.degree_u, net.degree_v, 3, net.is_rational()},
        values_(packed_points<T>(std::span(&net, 1))), given_{values_.data(),
                                                              sizeof(T) == sizeof(double),
                                                              !net.is_rational() ? Weights::none
                                                              : net.homogeneous
                                                                  ? Weights::homogeneous
                                                                  : Weights::cartesian} {}

  [[nodiscard]] bool is_curve_like() const {
    const detail::ExactPoints points(given_.net(0), shape_.points(), 3);
    return detail::is_curve_like(points, static_cast<std::size_t>(shape_.degree_u),
                                 static_cast<std::size_t>(shape_.degree_v));
  }
  [[nodiscard]] SampleStatus status(double x, double y, T (&normal)[3]) const {
    return detail::resolve_normal<T>(
        {&shape_, given_.net(0), static_cast<T>(x / 2), static_cast<T>(y / 2)}, normal);
  }

private:
  detail::NetShape shape_;
  std::vector<T> values_;
  detail::GivenPoints given_;
};

/// Whether du x dv vanishes at two parameters of 60 random digits each. Unless it is zero
/// everywhere, it does so with a chance of less than 2^-50.
[[nodiscard]] bool vanishes_anywhere(const Net& net, Random& random) {
  const auto parameter = [&]() -> Rational {
    return Rational(1 + random.below(std::uint64_t{1} << 60)) / Rational(std::uint64_t{1} << 60);
  };
  const Rational u = parameter();
  const Rational v = parameter();
  const ExactChannel weight = exact_channel_at(net, u, v, 3);
  Vector3q du;
  Vector3q dv;
  for (std::size_t c = 0; c < 3; ++c) {
    const ExactChannel at = exact_quotient(exact_channel_at(net, u, v, c), weight);
    du[c] = at.du;
    dv[c] = at.dv;
  }
  return du[1] * dv[2] == du[2] * dv[1] && du[2] * dv[0] == du[0] * dv[2] &&
         du[0] * dv[1] == du[1] * dv[0];
}

/// A side, inside, the middle and outside.
constexpr double kPlaces[] = {-1, -0.875, -0.125, 0, 0.25, 0.75, 1, 2.5};

template <typename T>
void expect_degenerate_everywhere(const Net& net) {
  const Kept<T> kept(net);
  for (const double x : kPlaces) {
    for (const double y : kPlaces) {
      T normal[3];
      EXPECT_EQ(kept.status(x, y, normal), SampleStatus::degenerate) << x << ", " << y;
      EXPECT_TRUE(normal[0] == 0 && normal[1] == 0 && normal[2] == 0) << x << ", " << y;
    }
  }
}

template <typename T>
void expect_statuses_of_oracle(const Net& net) {
  const Kept<T> kept(net);
  const IntegerNet integers(net);
  for (const double x : kPlaces) {
    for (const double y : kPlaces) {
      const int order = exact_normal(integers, x, y).order;
      T normal[3];
      EXPECT_EQ(kept.status(x, y, normal), order < 0    ? SampleStatus::degenerate
                                           : order == 0 ? SampleStatus::regular
                                                        : SampleStatus::limit)
          << x << ", " << y;
    }
  }
}

/// In T, as far as T has the net.
template <typename T>
void expect_verdict(const Net& net, Random& random) {
  if (rounded_to<T>(net).points != net.points || rounded_to<T>(net).weights != net.weights ||
      has_points_by_rounding(net, sizeof(T) == 8)) {
    return;
  }
  const bool curve = vanishes_anywhere(net, random);
  EXPECT_EQ(Kept<T>(net).is_curve_like(), curve);
  if (curve) {
    expect_degenerate_everywhere<T>(net);
  } else if (net.points.size() <= 16) {
    expect_statuses_of_oracle<T>(net);
  }
}

TEST(CurveLike, curves_have_no_normals_and_others_do) {
  Random random(57);
  for (const Family& family : kFamilies) {
    for (const Degrees& degrees : kDegrees) {
      SCOPED_TRACE(std::string(family.name) + ", " + std::to_string(degrees.u) + " x " +
                   std::to_string(degrees.v));
      const Net net =
          turned({family.make(degrees, random)}, static_cast<unsigned>(random.below(8))).net;
      EXPECT_EQ(vanishes_anywhere(net, random), family.curve);
      expect_verdict<double>(net, random);
      // Rounded to float, or with one coordinate moved by its last bit, most are no curves.
      expect_verdict<float>(rounded_to<float>(net), random);
      Net moved = net;
      double& value = moved.points[random.below(moved.points.size())][random.below(3)];
      value = std::nextafter(value, 1e9);
      expect_verdict<double>(moved, random);
    }
  }
}

TEST(CurveLike, of_nets_whose_normals_vanish_somewhere) {
  Random random(58);
  std::size_t curves = 0;
  for (std::size_t k = 0; k < 8 * std::size(kSingularRows); ++k) {
    const SingularRow& row = kSingularRows[k % std::size(kSingularRows)];
    const Degrees degrees{random.integer(1, 5), random.integer(1, 5)};
    Net net = row.make(degrees, random).net;
    net = k % 3 == 0 ? net : weighted_points(std::move(net), random);
    net.homogeneous = net.is_rational() && k % 2 == 0;
    SCOPED_TRACE(std::string(row.name) + ", number " + std::to_string(k));
    const bool curve = vanishes_anywhere(net, random);
    EXPECT_EQ(Kept<double>(net).is_curve_like(), curve);
    curves += curve ? 1 : 0;
  }
  EXPECT_GT(curves, 10U);
}

/// One memory holds one patch after the other. Many of them have the same bytes, and are told apart
/// by what these mean.
struct Reading {
  const char* name;
  detail::NetShape shape;
  bool in_double;
  Weights weights;
  const double* values;
};

TEST(CurveLike, what_was_asked_before_changes_nothing) {
  static constexpr double kRows[24] = {0, 3, 1, 1, 4, 2, 5, 2, 1, 2, 8, 3, //
                                       0, 3, 1, 1, 4, 2, 5, 2, 1, 2, 8, 3};
  static constexpr double kWeighted[24] = {0, 3, 1, 1, 4, 2, 5, 2, 1, 2, 8, 3, // the weight is last
                                           0, 3, 1, 2, 4, 2, 5, 4, 1, 2, 8, 6};
  constexpr Reading kReadings[] = {
      {"equal rows", {3, 1, 3, false}, true, Weights::none, kRows},
      {"equal pairs of columns", {1, 3, 3, false}, true, Weights::none, kRows},
      {"its first two rows", {1, 1, 3, false}, true, Weights::none, kRows},
      {"as floats", {3, 1, 3, false}, false, Weights::none, kRows},
      {"as fewer floats", {1, 1, 3, false}, false, Weights::none, kRows},
      {"with weights", {2, 1, 3, true}, true, Weights::cartesian, kWeighted},
      {"divided by them", {2, 1, 3, true}, true, Weights::homogeneous, kWeighted},
  };
  double memory[24] = {};
  detail::GivenPoints given;
  const auto status = [&](const Reading& reading, bool changed) {
    std::copy_n(reading.values, 24, memory);
    memory[23] += changed ? 1 : 0;
    given = {memory, reading.in_double, reading.weights};
    float n[3];
    double nn[3];
    return reading.in_double
               ? detail::resolve_normal<double>({&reading.shape, given.net(0), 0.25, 0.125}, nn)
               : detail::resolve_normal<float>({&reading.shape, given.net(0), 0.25F, 0.125F}, n);
  };
  const Reading other{"another one", {2, 1, 3, false}, false, Weights::none, kRows};
  std::size_t degenerate = 0;
  for (const Reading& second : kReadings) {
    for (const bool changed : {false, true}) {
      status(other, false);
      const SampleStatus expected = status(second, changed);
      degenerate += expected == SampleStatus::degenerate ? 1 : 0;
      for (const Reading& first : kReadings) {
        status(first, !changed);
        EXPECT_EQ(status(second, changed), expected) << first.name << ", then " << second.name;
        status(first, changed);
        EXPECT_EQ(status(second, changed), expected) << first.name << ", then " << second.name;
      }
    }
  }
  EXPECT_GT(degenerate, 1U);
  EXPECT_LT(degenerate, 2 * std::size(kReadings));
}

} // namespace
} // namespace simdbezier::tests::curve_like_test
