// Whether all control points lie on one line, or are one point, decided exactly: then nothing bends
// and nothing has a normal, which takes far longer to find from the coefficients of the
// polynomials.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/exact/exact_points.hpp"
#include "src/exact/leading_term.hpp"

namespace simdbezier::detail {

/// Numerators relative to the first point: ExactPoints::place() moves rational ones only.
template <typename Field>
class FromFirst {
public:
  FromFirst(const Field& field, const ExactPoints& points) : field_(field), points_(points) {
    points.place(field, 0, 0, first_);
  }
  void place(std::size_t k, typename Field::Value to[3]) const {
    typename Field::Value point[4];
    points_.place(field_, k, 0, point);
    for (std::size_t c = 0; c < 3; ++c) {
      to[c] = field_.subtract(point[c], first_[c]);
    }
  }

private:
  const Field& field_;
  const ExactPoints& points_;
  typename Field::Value first_[4];
};

/// Whether all of `count` points lie on the line through the first one and point `far`; where far
/// is 0, whether they are the first one. is_not_zero() judges components of vectors that then
/// vanish.
template <typename Field, typename IsNotZero>
[[nodiscard]] bool fit(const Field& field, const ExactPoints& given, std::size_t far,
                       std::size_t count, const IsNotZero& is_not_zero) {
  using Value = typename Field::Value;
  const FromFirst<Field> points(field, given);
  Value along[3];
  points.place(far, along);
  for (std::size_t k = 1; k < count; ++k) {
    Value at[3];
    Value cross[3] = {field.zero(), field.zero(), field.zero()};
    points.place(k, at);
    if (far != 0) {
      add_cross(field, along, at, cross);
    }
    const Value* const beside = far != 0 ? cross : at;
    if (std::any_of(beside, beside + 3, is_not_zero)) {
      return false;
    }
  }
  return true;
}

/// Whether the points fit exactly, decided by doubles, which subtract equal points without an
/// error, and then by as many primes as it takes.
[[nodiscard]] inline bool fit_exactly(const ExactPoints& given, std::size_t far,
                                      std::size_t count) {
  const BoundedField doubles{given.largest_point(), given.largest_weight()};
  if (fit(doubles, given, far, count,
          [](const Bounded& a) { return !BoundedField::vanishes(a); })) {
    return true;
  }
  if (!fit(doubles, given, far, count,
           [](const Bounded& a) { return std::fabs(a.value) > a.error; })) {
    return false;
  }
  DigitRange ranges[kQuantities];
  given.include_in(ranges[kPoint], ranges[kWeight]);
  const int needed = 2 * given.digits(ranges[kPoint], ranges[kWeight]) + 4;
  Primes primes;
  for (double known = 0; known < needed; known += Primes::kDigits) {
    const PrimeField field(primes.next(), ranges);
    if (!fit(field, given, far, count, [](Residue a) { return !PrimeField::vanishes(a); })) {
      return false;
    }
  }
  return true;
}

/// Whether `count` control points are one point; others are told by the first few of them.
[[nodiscard]] inline bool is_point(const ExactPoints& given, std::size_t count) {
  return fit_exactly(given, 0, count);
}

/// Whether `count` control points lie on one line, or are one point.
[[nodiscard]] inline bool is_straight(const ExactPoints& given, std::size_t count) {
  const BoundedField doubles{given.largest_point(), given.largest_weight()};
  const FromFirst<BoundedField> points(doubles, given);
  std::size_t far = 0; // 0 where doubles cannot tell any point from the first one
  double size = 0;
  for (std::size_t k = 1; k < count; ++k) {
    Bounded at[3];
    points.place(k, at);
    for (const Bounded& component : at) {
      if (std::fabs(component.value) > std::fmax(size, component.error)) {
        size = std::fabs(component.value);
        far = k;
      }
    }
  }
  return fit_exactly(given, far, count);
}

} // namespace simdbezier::detail
