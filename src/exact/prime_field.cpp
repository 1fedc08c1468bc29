#include "src/exact/prime_field.hpp"

#include <array>
#include <cmath>

namespace simdbezier::detail {
namespace {

constexpr std::uint64_t power_modulo(std::uint64_t base, std::uint32_t exponent, std::uint32_t n) {
  std::uint64_t power = 1;
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 != 0) {
      power = power * base % n;
    }
    base = base * base % n;
  }
  return power;
}

/// Miller and Rabin's test of an odd n, which with these bases is never wrong below 3 215 031 751.
/// Source: G. Jaeschke, "On Strong Pseudoprimes to Several Bases", Mathematics of Computation 61
/// (1993).
constexpr bool is_prime(std::uint32_t n) {
  std::uint32_t odd = n - 1;
  int doublings = 0;
  for (; odd % 2 == 0; odd /= 2) {
    ++doublings;
  }
  for (const std::uint32_t base : {2u, 3u, 5u, 7u}) {
    std::uint64_t x = power_modulo(base, odd, n);
    bool passes = x == 1 || x == n - 1;
    for (int i = 1; i < doublings && !passes; ++i) {
      x = x * x % n;
      passes = x == n - 1;
    }
    if (!passes) {
      return false;
    }
  }
  return true;
}

/// The next prime below an odd number or 2^31.
constexpr std::uint32_t prime_below(std::uint32_t n) {
  n -= n % 2 == 0 ? 1 : 2;
  while (!is_prime(n)) {
    n -= 2;
  }
  return n;
}

/// The first primes, as many as bicubic patches in single precision need.
constexpr auto kFirstPrimes = [] {
  std::array<std::uint32_t, 48> primes{};
  std::uint32_t last = std::uint32_t{1} << 31;
  for (std::uint32_t& prime : primes) {
    prime = last = prime_below(last);
  }
  return primes;
}();

/// Numbers of a huge range: a fraction in [1/2, 1) times a power of two, or zero.
struct Scaled {
  double fraction = 0;
  int exponent = 0;

  void multiply_add(double factor, double term) {
    int shift = 0;
    fraction = std::frexp(fraction * factor + std::ldexp(term, -exponent), &shift);
    exponent = fraction == 0 ? 0 : exponent + shift;
  }
};

} // namespace

std::uint32_t Primes::next() {
  last_ = taken_ < kFirstPrimes.size() ? kFirstPrimes[taken_] : prime_below(last_);
  ++taken_;
  return last_;
}

PrimeField::PrimeField(std::uint32_t prime, const DigitRange ranges[kQuantities]) : prime_(prime) {
  // Newton's iteration doubles the digits that are right: 3 (prime is odd), 6, 12, 24, 48.
  std::uint32_t inverse = prime;
  for (int i = 0; i < 4; ++i) {
    inverse *= 2 - prime * inverse;
  }
  negative_inverse_ = 0 - inverse;
  const u64 two_to_32 = (u64{1} << 32) % prime;
  square_ = two_to_32 * two_to_32 % prime;
  for (std::size_t q = 0; q < kQuantities; ++q) {
    low_[q] = ranges[q].low;
  }
}

PrimeField::Value PrimeField::number(Quantity kind, double value) const {
  if (value == 0) {
    return zero();
  }
  const OddInteger odd(value);
  Value result = integer(static_cast<std::uint32_t>(odd.magnitude % prime_));
  int shift = odd.exponent - low_[kind];
  constexpr int kStep = 30;
  for (; shift >= kStep; shift -= kStep) {
    result = multiply(result, integer(std::uint32_t{1} << kStep));
  }
  result = multiply(result, integer(std::uint32_t{1} << shift));
  return odd.negative ? subtract(zero(), result) : result;
}

PrimeField::Value PrimeField::inverse(Value a) const {
  Value power = integer(1);
  for (std::uint32_t exponent = prime_ - 2; exponent > 0; exponent /= 2) {
    if (exponent % 2 != 0) {
      power = multiply(power, a);
    }
    a = multiply(a, a);
  }
  return power;
}

void MixedRadix::put(const PrimeField& field, const Residue remainders[kComponents]) {
  const std::uint32_t prime = field.prime();
  // Other primes exceed this one by less than the whole of it.
  const auto integer = [&](std::uint32_t a) { return field.integer(a >= prime ? a - prime : a); };
  Residue product = field.integer(1);
  Residue known[kComponents] = {};
  for (std::size_t i = count_; i-- > 0;) {
    const Residue p = integer(primes_[i]);
    product = field.multiply(product, p);
    for (std::size_t c = 0; i >= started_ && c < kComponents; ++c) {
      known[c] = field.multiply_add(known[c], p, integer(digits_[i][c]));
    }
  }
  for (std::size_t i = started_; i-- > 0;) {
    for (Residue& value : known) {
      value = field.multiply(value, integer(primes_[i]));
    }
  }
  const Residue inverse = field.inverse(product);
  for (std::size_t c = 0; c < kComponents; ++c) {
    const Residue rest = field.subtract(remainders[c], known[c]);
    digits_[count_][c] = field.remainder(field.multiply(rest, inverse));
  }
  primes_[count_++] = prime;
}

double MixedRadix::component(std::size_t c, int& exponent) const {
  const bool negative = count_ > started_ && digits_[count_ - 1][c] > primes_[count_ - 1] / 2;
  Scaled sum;
  // The digits of a negative number x are those that complete each digit of -x - 1 to p - 1.
  for (std::size_t i = count_; i-- > 0;) {
    const std::uint32_t digit = i < started_ ? 0 : digits_[i][c];
    sum.multiply_add(primes_[i], negative ? primes_[i] - 1 - digit : digit);
  }
  if (negative) {
    sum.multiply_add(1, 1);
  }
  exponent = sum.exponent;
  return negative ? -sum.fraction : sum.fraction;
}

void MixedRadix::vector(double components[kComponents], int& exponent) const {
  int exponents[kComponents];
  exponent = -1;
  for (std::size_t c = 0; c < kComponents; ++c) {
    components[c] = component(c, exponents[c]);
    exponent = components[c] == 0 ? exponent : std::max(exponent, exponents[c]);
  }
  for (std::size_t c = 0; c < kComponents; ++c) {
    components[c] = std::ldexp(components[c], exponents[c] - exponent);
  }
}

} // namespace simdbezier::detail
