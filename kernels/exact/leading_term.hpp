// The first coefficient of a vector polynomial that is not zero, decided exactly.
#pragma once

#include <cmath>
#include <cstddef>

#include "kernels/exact/bounded.hpp"
#include "kernels/exact/prime_field.hpp"

namespace simdbezier::detail {

/// What the components of a limit are known to, relative to the largest: below the last rounding to
/// float by far more than directions need, and 10^-9 degree in double.
template <typename T>
inline constexpr double kLimitTolerance = sizeof(T) == sizeof(float) ? 0x1p-18 : 0x1p-38;

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

inline Verdict verdict(const Bounded vector[3], double tolerance) {
  const double size = std::fmax(std::fabs(vector[0].value),
                                std::fmax(std::fabs(vector[1].value), std::fabs(vector[2].value)));
  const double error = std::fmax(vector[0].error, std::fmax(vector[1].error, vector[2].error));
  if (size == 0 && error == 0) {
    return Verdict::zero;
  }
  constexpr double kLeast = 0x1p-800; // so that its square is within the range of doubles, too
  const bool clear = error <= tolerance * size && size >= kLeast && std::isfinite(size);
  return clear ? Verdict::found : Verdict::doubtful;
}

/// What regular directions are known to: samples close to where they vanish are many, and exact
/// ones of high degrees take a millisecond. Bounds exceed errors by far.
inline constexpr double kRegularTolerance = 0x1p-16;

/// In doubles; false where rounding errors leave it open. Order `lowest` is the regular case.
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
      for (std::size_t c = 0; c < 3; ++c) {
        term.vector[c] = vector[c].value;
      }
      return true;
    case Verdict::doubtful:
      return false;
    }
  }
  return true;
}

/// Exactly. make(field) gives the series modulo a prime.
///
/// One prime after the other tells which coefficients are not zero; its remainders of the lowest
/// such one are kept until their product says what it is. Where a later prime finds a lower one,
/// all that came before it had remainders of zero there.
template <typename Make>
LeadingTerm find_by_primes(const QuestionDigits& size, int lowest, int highest, const Make& make) {
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

/// make(field) gives the polynomial's coefficients in the arithmetic of a field: coefficient(k,
/// vector) is called for k = lowest, lowest + 1, …. tolerance: of the vector's components, relative
/// to the largest. Question: has field(), the doubles to begin with, and digits().
template <typename Question, typename Make>
LeadingTerm leading_term(const Question& question, int lowest, int highest, double tolerance,
                         const Make& make) {
  LeadingTerm term;
  {
    const BoundedField field = question.field();
    auto series = make(field);
    if (find_in_doubles(series, lowest, highest, tolerance, term)) {
      term.units[kPoint] = -field.scale_exponent(kPoint);
      term.units[kWeight] = -field.scale_exponent(kWeight);
      return term;
    }
  }
  return find_by_primes(question.digits(), lowest, highest, make);
}

} // namespace simdbezier::detail
