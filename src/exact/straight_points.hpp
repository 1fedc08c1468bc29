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

/// Whether none of `count` points lies beside the line through the first one and point `far`:
/// beside() judges each component of the cross products.
template <typename Field, typename Beside>
[[nodiscard]] bool on_line(const Field& field, const ExactPoints& given, std::size_t far,
                           std::size_t count, const Beside& beside) {
  using Value = typename Field::Value;
  const FromFirst<Field> points(field, given);
  Value along[3];
  points.place(far, along);
  for (std::size_t k = 1; k < count; ++k) {
    Value at[3];
    points.place(k, at);
    Value cross[3] = {field.zero(), field.zero(), field.zero()};
    add_cross(field, along, at, cross);
    if (std::any_of(cross, cross + 3, beside)) {
      return false;
    }
  }
  return true;
}

/// Whether `count` points are one: apart() judges each component of what lies between them.
template <typename Field, typename Apart>
[[nodiscard]] bool in_one_place(const Field& field, const ExactPoints& given, std::size_t count,
                                const Apart& apart) {
  const FromFirst<Field> points(field, given);
  for (std::size_t k = 1; k < count; ++k) {
    typename Field::Value at[3];
    points.place(k, at);
    if (std::any_of(at, at + 3, apart)) {
      return false;
    }
  }
  return true;
}

/// Calls holds(field, is_not_zero) with doubles, and then with as many primes as decide about
/// products of two differences of points, until it is false.
template <typename Holds>
[[nodiscard]] bool holds_exactly(const ExactPoints& given, const Holds& holds) {
  const BoundedField doubles{given.largest_point(), given.largest_weight()};
  if (!holds(doubles, [](const Bounded& a) { return std::fabs(a.value) > a.error; })) {
    return false;
  }
  DigitRange ranges[kQuantities];
  given.include_in(ranges[kPoint], ranges[kWeight]);
  const int needed = 2 * given.digits(ranges[kPoint], ranges[kWeight]) + 4;
  Primes primes;
  for (double known = 0; known < needed; known += Primes::kDigits) {
    const PrimeField field(primes.next(), ranges);
    if (!holds(field, [](Residue a) { return !PrimeField::vanishes(a); })) {
      return false;
    }
  }
  return true;
}

/// Whether `count` control points are one point. Seldom asked for more than a few of them.
[[nodiscard]] inline bool is_point(const ExactPoints& given, std::size_t count) {
  return holds_exactly(given, [&](const auto& field, const auto& is_not_zero) {
    return in_one_place(field, given, count, is_not_zero);
  });
}

/// Whether `count` control points lie on one line. False where they are one point.
[[nodiscard]] inline bool is_line(const ExactPoints& given, std::size_t count) {
  const BoundedField doubles{given.largest_point(), given.largest_weight()};
  const FromFirst<BoundedField> points(doubles, given);
  std::size_t far = 0;
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
  return far != 0 && holds_exactly(given, [&](const auto& field, const auto& is_not_zero) {
           return on_line(field, given, far, count, is_not_zero);
         });
}

} // namespace simdbezier::detail
