// What is zero at every sample, decided exactly and once for all of them, which takes far longer
// from the coefficients of each sample's own polynomials: nothing bends where all control points
// lie on one line or are one point, and a patch that is a curve or a point has no normal.
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

/// The cross product of a patch's tangents modulo a prime, as NormalSeries has it (src/exact/
/// normal_series.hpp), but over the whole patch: with u = x / (1 + x) and v = y / (1 + y), and
/// times powers of 1 + x and 1 + y, it is a polynomial in x and y whose coefficients are integers.
class CrossPolynomial {
public:
  CrossPolynomial(const PrimeField& field, const ExactPoints& points, std::size_t degree_u,
                  std::size_t degree_v)
      : field_(field), degree_u_(degree_u), degree_v_(degree_v),
        channels_(points.rational() ? 4 : 3) {
    for (std::size_t k = 0; k < (degree_u_ + 1) * (degree_v_ + 1); ++k) {
      points.place(field, k, 0, net_[k]);
    }
  }

  /// A polynomial that vanishes at as many values of a variable as its degree and one more is zero.
  [[nodiscard]] bool is_zero() {
    const std::size_t factors = channels_ - 1;
    for (std::size_t y = 1; y <= factors * degree_v_; ++y) {
      v_[y] = Powers(field_, degree_v_, y);
    }
    for (std::size_t x = 1; x <= factors * degree_u_; ++x) {
      fix(x);
      for (std::size_t y = 1; y <= factors * degree_v_; ++y) {
        if (!vanishes(v_[y])) {
          return false;
        }
      }
    }
    return true;
  }

  /// How many binary digits its coefficients have, if those of place() have `net` and weights have
  /// `weight`. A sum of Bernstein polynomials of degree n has coefficients below 2^n times its
  /// points.
  [[nodiscard]] static int digits(int net, int weight, bool rational, std::size_t degrees) {
    const int sum = static_cast<int>(degrees);
    return rational ? 2 * net + weight + 5 + 3 * sum : 2 * net + 3 + 2 * sum;
  }

private:
  using Point = Residue[4];
  static constexpr std::size_t kMostValues = 3 * kMostDegree;

  /// binomial(n,i) x^i for n = degree and for n = degree - 1
  struct Powers {
    Residue upper[kMostOrder];
    Residue lower[kMostOrder];

    Powers() = default;
    Powers(const PrimeField& field, std::size_t degree, std::size_t x) {
      const Residue factor = field.integer(static_cast<std::uint32_t>(x));
      fill(field, degree, factor, upper);
      fill(field, degree - 1, factor, lower);
    }
    static void fill(const PrimeField& field, std::size_t degree, Residue x, Residue* to) {
      std::size_t binomial = 1;
      Residue power = field.one();
      for (std::size_t i = 0; i <= degree; ++i) {
        to[i] = field.multiply(field.integer(static_cast<std::uint32_t>(binomial)), power);
        binomial = binomial * (degree - i) / (i + 1);
        power = field.multiply(power, x);
      }
    }
  };

  /// sum_k weights[k] points[k]
  void sum_up(const Residue* weights, const Point* points, std::size_t count, Residue* sum) const {
    for (std::size_t c = 0; c < channels_; ++c) {
      sum[c] = field_.sum_of_products(weights, points[0] + c, 4, count);
    }
  }
  /// Differences of neighbours among count + 1 points.
  void subtract(const Point* points, std::size_t count, Point* to) const {
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t c = 0; c < channels_; ++c) {
        to[k][c] = field_.subtract(points[k + 1][c], points[k][c]);
      }
    }
  }

  /// The columns of control points that are left where x is fixed.
  void fix(std::size_t x) {
    const Powers u(field_, degree_u_, x);
    for (std::size_t j = 0; j <= degree_v_; ++j) {
      const Point* const row = net_ + j * (degree_u_ + 1);
      Point steps[kMostOrder];
      subtract(row, degree_u_, steps);
      sum_up(u.upper, row, degree_u_ + 1, point_[j]);
      sum_up(u.lower, steps, degree_u_, du_[j]);
    }
    subtract(point_, degree_v_, dv_);
  }

  [[nodiscard]] bool vanishes(const Powers& v) const {
    Point du = {};
    Point dv = {};
    sum_up(v.upper, du_, degree_v_ + 1, du);
    sum_up(v.lower, dv_, degree_v_, dv);
    Point cross = {};
    add_cross(field_, du, dv, cross);
    if (channels_ == 4) {
      Point point = {};
      sum_up(v.upper, point_, degree_v_ + 1, point);
      Point pu = {};
      Point vp = {};
      add_cross(field_, point, du, pu);
      add_cross(field_, dv, point, vp);
      for (std::size_t c = 0; c < 3; ++c) {
        cross[c] = field_.multiply(point[3], cross[c]);
        cross[c] = field_.multiply_add(dv[3], pu[c], cross[c]);
        cross[c] = field_.multiply_add(du[3], vp[c], cross[c]);
      }
    }
    return std::all_of(cross, cross + 3, PrimeField::vanishes);
  }

  const PrimeField& field_;
  std::size_t degree_u_;
  std::size_t degree_v_;
  std::size_t channels_;
  Point net_[kMostOrder * kMostOrder];
  Powers v_[kMostValues + 1]; ///< [y]
  Point point_[kMostOrder];   ///< where x is fixed
  Point du_[kMostOrder];
  Point dv_[kMostOrder];
};

/// Whether the cross product of a patch's tangents is zero everywhere. Most of those where it is
/// not are told by the first prime's first value.
[[nodiscard]] __attribute__((noinline)) inline bool
is_curve_like(const ExactPoints& points, std::size_t degree_u, std::size_t degree_v) {
  if (is_straight(points, (degree_u + 1) * (degree_v + 1))) {
    return true;
  }
  DigitRange ranges[kQuantities];
  points.include_in(ranges[kPoint], ranges[kWeight]);
  const int needed =
      CrossPolynomial::digits(points.digits(ranges[kPoint], ranges[kWeight]),
                              ranges[kWeight].digits(), points.rational(), degree_u + degree_v);
  Primes primes;
  for (double known = 0; known < needed; known += Primes::kDigits) {
    const PrimeField field(primes.next(), ranges);
    if (!CrossPolynomial(field, points, degree_u, degree_v).is_zero()) {
      return false;
    }
  }
  return true;
}

} // namespace simdbezier::detail
