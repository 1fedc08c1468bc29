// The first coefficient of a vector polynomial that is not zero, decided exactly.
#pragma once

#include <cmath>
#include <cstddef>

#include "src/exact/bounded.hpp"
#include "src/exact/prime_field.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// A coefficient: vector times 2^exponent, and which one; order -1: all are zero.
struct LeadingTerm {
  int order = -1;
  double vector[3] = {0, 0, 0};
  int exponent = 0;
  /// What numbers of each kind were measured in, as exponents of two: the coefficient is to be
  /// multiplied by this unit for every factor of the kind.
  int units[kQuantities] = {0, 0, 0, 0};
};

/// The binary digits of a question's numbers, by kind, and those of the polynomial's coefficients
/// once all numbers have been made integers.
struct QuestionDigits {
  DigitRange numbers[kQuantities];
  int coefficients = 0;
};

/// What double precision says of a coefficient.
enum class Verdict { zero, found, doubtful };

/// The largest component's magnitude.
inline double largest(const Bounded vector[3]) {
  return std::fmax(std::fabs(vector[0].value),
                   std::fmax(std::fabs(vector[1].value), std::fabs(vector[2].value)));
}

inline Verdict verdict(const Bounded vector[3], double tolerance) {
  double error = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!std::isfinite(vector[c].value) || !std::isfinite(vector[c].error)) {
      return Verdict::doubtful;
    }
    error = std::fmax(error, vector[c].error);
  }
  const double size = largest(vector);
  if (size == 0 && error == 0) {
    return Verdict::zero;
  }
  return error <= tolerance * size ? Verdict::found : Verdict::doubtful;
}

/// sum + a x b
template <typename Field>
void add_cross(const Field& field, const typename Field::Value* a, const typename Field::Value* b,
               typename Field::Value* sum) {
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t d = (c + 1) % 3;
    const std::size_t e = (c + 2) % 3;
    sum[c] = field.multiply_add(a[d], b[e], sum[c]);
    sum[c] = field.subtract_product(a[e], b[d], sum[c]);
  }
}

/// A vector over a power of two of about its size, so that it can be squared.
inline void take(const Bounded vector[3], LeadingTerm& term) {
  term.exponent = std::ilogb(largest(vector));
  for (std::size_t c = 0; c < 3; ++c) {
    term.vector[c] = std::ldexp(vector[c].value, -term.exponent);
  }
}

/// Decides in doubles; false where rounding errors leave it open. Order `lowest` is the regular
/// case.
template <typename Series>
bool find_in_doubles(Series& series, int lowest, int highest, double tolerance, LeadingTerm& term) {
  for (int order = lowest; order <= highest; ++order) {
    Bounded vector[3];
    series.coefficient(order, vector);
    switch (
        verdict(vector, order == lowest ? std::fmax(tolerance, kRegularTolerance) : tolerance)) {
    case Verdict::zero:
      continue;
    case Verdict::found:
      term.order = order;
      take(vector, term);
      return true;
    case Verdict::doubtful:
      return false;
    }
  }
  return true;
}

/// Decides exactly. make(field) gives the series modulo a prime.
///
/// One prime after the other tells which coefficients are not zero; its remainders of the lowest
/// such one are kept until their product says what it is. Where a later prime finds a lower one,
/// all that came before it had remainders of zero there.
template <typename Make>
__attribute__((noinline)) LeadingTerm find_by_primes(const QuestionDigits& size, int lowest,
                                                     int highest, const Make& make) {
  LeadingTerm term;
  for (std::size_t q = 0; q < kQuantities; ++q) {
    term.units[q] = size.numbers[q].low;
  }
  const double primes = std::ceil((size.coefficients + 3) / Primes::kDigits);
  if (!(primes <= static_cast<double>(MixedRadix::kMostPrimes))) {
    return term;
  }
  MixedRadix digits;
  Primes prime;
  int candidate = highest + 1;
  for (int i = 0; i < static_cast<int>(primes); ++i) {
    const PrimeField field(prime.next(), size.numbers);
    auto series = make(field);
    Residue vector[3] = {};
    for (int order = lowest; order <= std::min(candidate, highest); ++order) {
      series.coefficient(order, vector);
      const bool zero =
          field.vanishes(vector[0]) && field.vanishes(vector[1]) && field.vanishes(vector[2]);
      if (!zero && order < candidate) {
        candidate = order;
        digits.forget_all();
      }
    }
    digits.put(field, vector);
  }
  if (candidate <= highest) {
    term.order = candidate;
    digits.vector(term.vector, term.exponent);
  }
  return term;
}

/// The first way, in a stack frame of its own: neither way's tables are small.
template <typename Question, typename Make>
__attribute__((noinline)) bool find_quickly(const Question& question, int lowest, int highest,
                                            double tolerance, const Make& make, LeadingTerm& term) {
  const BoundedField field = question.field();
  auto series = make(field);
  if (!find_in_doubles(series, lowest, highest, tolerance, term)) {
    return false;
  }
  term.units[kPoint] = -field.scale_exponent(kPoint);
  term.units[kWeight] = -field.scale_exponent(kWeight);
  return true;
}

/// make(field) gives the polynomial's coefficients in the arithmetic of a field: coefficient(k,
/// vector) is called for k = lowest, lowest + 1, …. tolerance: of the vector's components, relative
/// to the largest. Question has field(), the doubles to begin with, and digits(). It may have
/// is_point() and is_zero(), which find faster than from all coefficients that they are zero: asked
/// first, and after doubles have not decided.
template <typename Question, typename Make>
LeadingTerm leading_term(const Question& question, int lowest, int highest, double tolerance,
                         const Make& make) {
  LeadingTerm term;
  if constexpr (requires { question.is_point(); }) {
    if (question.is_point()) {
      return term;
    }
  }
  if (find_quickly(question, lowest, highest, tolerance, make, term)) {
    return term;
  }
  if constexpr (requires { question.is_zero(); }) {
    if (question.is_zero()) {
      return LeadingTerm{};
    }
  }
  return find_by_primes(question.digits(), lowest, highest, make);
}

} // namespace simdbezier::detail
