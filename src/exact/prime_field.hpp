// Arithmetic modulo a prime: the same polynomials as in double, without any error.
//
// An integer below the product of some primes is known from its remainders (the Chinese remainder
// theorem): it is zero where all of them are. Exact decisions therefore need no long numbers and no
// memory, only as many passes as there are primes.
// Source: D. E. Knuth, The Art of Computer Programming, vol. 2, 4.3.2; P. L. Montgomery, "Modular
// Multiplication Without Trial Division", Mathematics of Computation 44 (1985).
#pragma once

#include <cstdint>

#include "src/exact/quantities.hpp"

namespace simdbezier::detail {

/// Primes below 2^31, from the largest one down.
class Primes {
public:
  [[nodiscard]] std::uint32_t next();

  /// Every one has at least so many binary digits.
  static constexpr double kDigits = 30.99;

private:
  std::uint32_t last_ = std::uint32_t{1} << 31;
  std::uint32_t taken_ = 0;
};

/// A remainder, times 2^32 (Montgomery's form).
struct Residue {
  std::uint32_t value;
};

class PrimeField {
public:
  using Value = Residue;

  /// ranges: of every kind.
  PrimeField(std::uint32_t prime, const DigitRange ranges[kQuantities]);

  [[nodiscard]] std::uint32_t prime() const { return prime_; }

  /// value / 2^low, low being that of its kind.
  [[nodiscard]] Value number(Quantity kind, double value) const;
  [[nodiscard]] Value integer(std::uint32_t value) const { return {reduce(square_ * u64{value})}; }
  [[nodiscard]] std::uint32_t remainder(Value a) const { return reduce(a.value); }

  [[nodiscard]] static Value zero() { return {0}; }
  [[nodiscard]] Value one() const { return integer(1); }
  [[nodiscard]] static bool vanishes(Value a) { return a.value == 0; }
  [[nodiscard]] Value add(Value a, Value b) const {
    const std::uint32_t sum = a.value + b.value;
    return {sum >= prime_ ? sum - prime_ : sum};
  }
  [[nodiscard]] Value subtract(Value a, Value b) const {
    return {a.value >= b.value ? a.value - b.value : a.value + (prime_ - b.value)};
  }
  [[nodiscard]] Value multiply(Value a, Value b) const { return {reduce(u64{a.value} * b.value)}; }
  [[nodiscard]] Value multiply_add(Value a, Value b, Value c) const {
    return add(multiply(a, b), c);
  }
  [[nodiscard]] Value subtract_product(Value a, Value b, Value c) const {
    return subtract(c, multiply(a, b));
  }
  /// sum_k a[k] b[step k], whose terms are reduced together.
  [[nodiscard]] Value sum_of_products(const Value* a, const Value* b, std::size_t step,
                                      std::size_t count) const {
    const u64 most = u64{prime_} << 32; // terms are below half of it, and sums below it
    u64 sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      sum += u64{a[k].value} * b[k * step].value;
      sum -= sum >= most ? most : 0;
    }
    return {reduce(sum)};
  }
  [[nodiscard]] Value determinant(Value a, Value b, Value c, Value d) const {
    return subtract(multiply(a, b), multiply(c, d));
  }
  [[nodiscard]] Value inverse(Value a) const;

private:
  using u64 = std::uint64_t;

  /// x / 2^32 modulo the prime, for x < 2^32 prime.
  [[nodiscard]] std::uint32_t reduce(u64 x) const {
    const u64 multiple = u64{static_cast<std::uint32_t>(x) * negative_inverse_} * prime_;
    const auto quotient = static_cast<std::uint32_t>((x + multiple) >> 32);
    return quotient >= prime_ ? quotient - prime_ : quotient;
  }

  std::uint32_t prime_;
  std::uint32_t negative_inverse_; ///< -1 / prime modulo 2^32
  u64 square_;                     ///< 2^64 modulo the prime
  int low_[kQuantities];
};

/// The signed integers of a vector, from their remainders by one prime after the other.
/// Source: H. L. Garner, "The Residue Number System", IRE Transactions EC-8 (1959): the digits d of
/// d_0 + p_0 (d_1 + p_1 (d_2 + …)).
class MixedRadix {
public:
  static constexpr std::size_t kComponents = 3;
  /// Enough for every question about samples inside of a patch: see leading_term.hpp.
  static constexpr std::size_t kMostPrimes = 3584;

  /// All that has been put in so far had remainders of zero.
  void forget_all() { started_ = count_; }
  void put(const PrimeField& field, const Residue remainders[kComponents]);

  /// The components over their largest power of two, each to within 2^-40 of it. The integers must
  /// be below a quarter of the primes' product.
  void vector(double components[kComponents], int& exponent) const;

private:
  [[nodiscard]] double component(std::size_t c, int& exponent) const;

  std::size_t count_ = 0;
  std::size_t started_ = 0; ///< lower digits are zero
  std::uint32_t primes_[kMostPrimes];
  std::uint32_t digits_[kMostPrimes][kComponents];
};

} // namespace simdbezier::detail
