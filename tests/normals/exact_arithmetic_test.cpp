// The arithmetic behind exact decisions (src/exact), against GMP.
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "src/exact/bounded.hpp"
#include "src/exact/leading_term.hpp"
#include "src/exact/normal_series.hpp"
#include "src/exact/prime_field.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests::exact_arithmetic_test {
namespace {

using detail::Bounded;
using detail::BoundedField;
using detail::DigitRange;
using detail::kPoint;
using detail::PrimeField;
using detail::Residue;

mpq_class power_of_two(int exponent) {
  const mpz_class power = mpz_class(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? mpq_class(1, power) : mpq_class(power);
}

TEST(ExactArithmetic, primes_are_all_primes_below_two_to_31_from_the_largest_down) {
  detail::Primes primes;
  mpz_class last = mpz_class(1) << 31;
  for (int i = 0; i < 200; ++i) { // those of the table, and beyond
    const mpz_class prime = primes.next();
    EXPECT_NE(mpz_probab_prime_p(prime.get_mpz_t(), 30), 0) << prime;
    EXPECT_LT(prime, last);
    mpz_class next;
    mpz_nextprime(next.get_mpz_t(), prime.get_mpz_t());
    EXPECT_GE(next, last) << "one was left out below " << last;
    EXPECT_GE(std::log2(prime.get_d()), detail::Primes::kDigits);
    last = prime;
  }
}

TEST(ExactArithmetic, doubles_are_odd_integers_times_powers_of_two) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  constexpr double kMost = std::numeric_limits<double>::max();
  for (const double value : {1.0, -1.0, 0.1, -6.5, 0x1p-1022, kLeast, -3 * kLeast, 0x1.8p-1060,
                             kMost, -kMost, 0x1p1023, 0x1.fffffffffffffp0}) {
    const detail::OddInteger odd(value);
    EXPECT_EQ(odd.magnitude % 2, 1u) << value;
    const mpq_class magnitude =
        mpz_class(static_cast<unsigned long>(odd.magnitude)) * power_of_two(odd.exponent);
    EXPECT_EQ(odd.negative ? -magnitude : magnitude, mpq_class(value)) << value;
    EXPECT_EQ(odd.high(), std::ilogb(value) + 1) << value;
  }
}

TEST(ExactArithmetic, remainders_follow_the_integers) {
  Random random(1);
  detail::Primes primes;
  DigitRange ranges[detail::kQuantities];
  ranges[kPoint].low = -200;
  for (int i = 0; i < 100; ++i) {
    const PrimeField field(primes.next(), ranges);
    mpz_class numbers[3];
    Residue residues[3];
    for (int k = 0; k < 3; ++k) {
      const double value = std::ldexp(random.symmetric(), random.integer(-100, 99));
      numbers[k] = mpz_class(mpq_class(value) * power_of_two(200));
      residues[k] = field.number(kPoint, value);
    }
    const auto expect = [&](const mpz_class& number, Residue residue, const char* what) {
      mpz_class rest;
      mpz_fdiv_r_ui(rest.get_mpz_t(), number.get_mpz_t(), field.prime());
      EXPECT_EQ(rest, mpz_class(field.remainder(residue))) << what << " modulo " << field.prime();
    };
    const auto& [a, b, c] = numbers;
    const auto& [p, q, r] = residues;
    expect(a, p, "number");
    expect(a + b, field.add(p, q), "sum");
    expect(a - b, field.subtract(p, q), "difference");
    expect(a * b, field.multiply(p, q), "product");
    expect(a * b + c, field.multiply_add(p, q, r), "product and sum");
    expect(c - a * b, field.subtract_product(p, q, r), "difference from a product");
    expect(a * b - b * c, field.determinant(p, q, q, r), "determinant");
    expect(0, field.zero(), "zero");
    expect(1, field.one(), "one");
    expect(1, field.multiply(p, field.inverse(p)), "inverse");
  }
}

/// Integers of very different sizes, both signs, and zeros, from their remainders.
TEST(ExactArithmetic, integers_follow_from_their_remainders) {
  Random random(2);
  gmp_randclass bits(gmp_randinit_default);
  bits.seed(3);
  DigitRange ranges[detail::kQuantities];
  for (const unsigned digits : {1u, 5u, 29u, 31u, 60u, 200u, 3000u}) {
    for (int i = 0; i < 20; ++i) {
      // Multiples of the first primes, as those of a coefficient that later ones found.
      detail::Primes all;
      mpz_class multiple = 1;
      const int skipped = digits > 100 ? i % 4 : 0;
      for (int k = 0; k < skipped; ++k) {
        multiple *= all.next();
      }
      mpz_class integers[3];
      for (int c = 0; c < 3; ++c) {
        integers[c] = bits.get_z_bits(c == i % 3 ? digits : digits / 2) *
                      (random.symmetric() < 0 ? -1 : 1) * multiple;
      }
      const double needed = digits + 31 * skipped + 3;
      detail::Primes primes;
      detail::MixedRadix radix;
      for (int k = 0; k * detail::Primes::kDigits < needed; ++k) {
        const PrimeField field(primes.next(), ranges);
        if (k == skipped) {
          radix.forget_all();
        }
        Residue remainders[3];
        for (int c = 0; c < 3; ++c) {
          mpz_class rest;
          mpz_fdiv_r_ui(rest.get_mpz_t(), integers[c].get_mpz_t(), field.prime());
          remainders[c] = field.integer(static_cast<std::uint32_t>(rest.get_ui()));
        }
        radix.put(field, remainders);
      }
      double vector[3];
      int exponent = 0;
      radix.vector(vector, exponent);
      for (int c = 0; c < 3; ++c) {
        const mpq_class found = mpq_class(vector[c]) * power_of_two(exponent);
        EXPECT_LE(abs(found - integers[c]), power_of_two(exponent - 40))
            << integers[c] << " of " << digits << " digits";
      }
    }
  }
}

/// Sums of products of numbers, many of which are equal or zero, and so cancel.
TEST(ExactArithmetic, bounds_hold_and_exact_zeros_are_zeros) {
  Random random(4);
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    const int spread = i % 3 == 0 ? 1000 : i % 3 == 1 ? 40 : 0;
    const BoundedField field(1, 1);
    Bounded terms[6];
    mpq_class exact[6];
    for (int k = 0; k < 6; ++k) {
      const int kind = static_cast<int>(random.below(4));
      const int exponent = spread == 0 ? 0 : random.integer(-spread, spread);
      const double value = kind == 0            ? 0
                           : kind == 1 && k > 0 ? terms[k - 1].value
                                                : std::ldexp(random.symmetric(), exponent);
      terms[k] = field.number(kPoint, value);
      exact[k] = mpq_class(value);
    }
    const auto& t = terms;
    const auto& e = exact;
    const Bounded determinant = field.determinant(t[0], t[1], t[2], t[3]);
    Bounded sum = field.subtract_product(t[1], t[2], field.multiply(t[0], t[3]));
    sum = field.multiply_add(field.subtract(t[4], t[3]), field.add(sum, t[5]), sum);
    const mpq_class difference = e[0] * e[3] - e[1] * e[2];
    const std::pair<Bounded, mpq_class> pairs[] = {
        {determinant, e[0] * e[1] - e[2] * e[3]},
        {sum, (e[4] - e[3]) * (difference + e[5]) + difference}};
    for (const auto& [found, expected] : pairs) {
      if (std::isfinite(found.value) && std::isfinite(found.error)) {
        EXPECT_LE(abs(mpq_class(found.value) - expected), mpq_class(found.error)) << i;
      }
      zeros += field.vanishes(found) ? 1 : 0;
    }
  }
  EXPECT_GT(zeros, 1000);
}

/// Coefficients that are given, all components alike.
struct GivenSeries {
  const PrimeField& field;
  std::vector<std::uint64_t> integers;

  void coefficient(int order, Residue vector[3]) const {
    const auto rest = integers[static_cast<std::size_t>(order)] % field.prime();
    std::fill_n(vector, 3, field.integer(static_cast<std::uint32_t>(rest)));
  }
};

TEST(ExactArithmetic, a_coefficient_that_a_prime_divides_is_found_by_the_next) {
  detail::Primes primes;
  const std::uint64_t first = primes.next();
  const std::uint64_t product = first * primes.next();
  const struct {
    std::vector<std::uint64_t> integers;
    int order;
  } cases[] = {{{1, 2, 3}, 0},           {{0, 0, 7}, 2},       {{first, 1, 1}, 0},
               {{product, 5, 1}, 0},     {{0, product, 1}, 1}, {{product, first, 1}, 0},
               {{0, first, product}, 1}, {{0, 0, 0}, -1}};
  for (const auto& c : cases) {
    detail::QuestionDigits digits;
    digits.coefficients = 64;
    const detail::LeadingTerm term =
        detail::find_by_primes(digits, 0, 2, [&](const PrimeField& field) {
          return GivenSeries{field, c.integers};
        });
    ASSERT_EQ(term.order, c.order);
    if (c.order >= 0) {
      EXPECT_EQ(std::ldexp(term.vector[0], term.exponent),
                static_cast<double>(c.integers[static_cast<std::size_t>(c.order)]));
    }
  }
}

/// What doubles are sure of, primes say too.
TEST(ExactArithmetic, both_ways_find_the_same_term) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const auto degree_u = static_cast<std::size_t>(1 + random.below(4));
    const auto degree_v = static_cast<std::size_t>(1 + random.below(4));
    const Weights weights = static_cast<Weights>(i % 3);
    const std::size_t channels = weights == Weights::none ? 3 : 4;
    std::vector<double> values((degree_u + 1) * (degree_v + 1) * channels);
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = k % channels == 3 ? 1 + 0.5 * random.symmetric() : random.symmetric();
    }
    if (i % 2 == 0) { // a collapsed edge v = 0
      for (std::size_t k = channels; k < (degree_u + 1) * channels; ++k) {
        values[k] = values[k % channels];
      }
    }
    detail::GivenPoints given;
    given.values = values.data();
    given.in_double = true;
    given.weights = weights;
    const detail::NormalQuestion question(given.net(0), degree_u, degree_v,
                                          0.5 * random.symmetric(), -0.5);
    const auto make = [&](const auto& field) { return detail::NormalSeries(field, question); };
    detail::LeadingTerm quick;
    const BoundedField field = question.field();
    auto series = make(field);
    ASSERT_TRUE(detail::find_in_doubles(series, 0, question.highest(), 0x1p-30, quick)) << i;
    const detail::LeadingTerm exact =
        detail::find_by_primes(question.digits(), 0, question.highest(), make);
    ASSERT_EQ(exact.order, quick.order) << i;
    ASSERT_EQ(exact.order, i % 2 == 0 ? 1 : 0) << i;
    const auto length = [](const double v[3]) { return std::hypot(v[0], v[1], v[2]); };
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(exact.vector[c] / length(exact.vector), quick.vector[c] / length(quick.vector),
                  0x1p-28)
          << i;
    }
  }
}

} // namespace
} // namespace simdbezier::tests::exact_arithmetic_test
