#include <tools/formats/surfaces/affine_map.hpp>
#include <tools/formats/surfaces/roundings.hpp>

#include <algorithm>
#include <cmath>

namespace simdbezier::tools {

namespace {

using Vector = AffineMap::Vector;
using Rows = AffineMap::Rows;

constexpr Rows kIdentity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

struct Turn {
  double sine;
  double cosine;
};

// Each is off by at most 2u of itself where |degrees| <= 45, and so it is for others, because they
// are turned by quarters without rounding. The angle x + low has no error that counts, and the
// series end where terms are below u/1000.
Turn turn_by(double degrees) {
  int quarter = 0;
  const double rest = std::remquo(degrees, 90.0, &quarter);
  constexpr double kRadian = 0x1.1df46a2529d39p-6;
  constexpr double kRadianLow = 0x1.5c1d8becdd291p-62;
  const double x = rest * kRadian;
  const double low = std::fma(rest, kRadian, -x) + rest * kRadianLow;
  double sine = 0;
  double cosine = 0;
  for (int k = 19; k > 2; k -= 2) { // of the term x^k / k! and the one before it
    sine = -x * x / (k * (k - 1)) * (1 + sine);
    cosine = -x * x / ((k - 1) * (k - 2)) * (1 + cosine);
  }
  sine = x + (x * sine + low * (1 + cosine));
  cosine = 1 + (cosine - low * x);
  switch (quarter & 3) {
  case 0:
    return {sine, cosine};
  case 1:
    return {cosine, -sine};
  case 2:
    return {-sine, -cosine};
  default:
    return {-cosine, sine};
  }
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double length(const Vector& a) { return std::sqrt(dot(a, a)); }

// a b - c d, off by at most 2u of itself (Kahan).
double difference(double a, double b, double c, double d) {
  const double cd = c * d;
  return std::fma(a, b, -cd) - std::fma(c, d, -cd);
}

Vector cross(const Vector& a, const Vector& b) {
  return {difference(a[1], b[2], a[2], b[1]), difference(a[2], b[0], a[0], b[2]),
          difference(a[0], b[1], a[1], b[0])};
}

// The vector with a largest number from 1/2 to 1, so that no square is too large or too small.
Vector scaled(Vector v) {
  int exponent = 0;
  static_cast<void>(
      std::frexp(std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}), &exponent));
  for (double& number : v) {
    number = std::ldexp(number, -exponent);
  }
  return v;
}

bool is_zero(const Vector& v) { return v == Vector{}; }

// A sum of products that is rounded from left to right, and how much that was.
class ProductSum {
public:
  void add(double a, double b) {
    const double product = a * b;
    const double before = sum_;
    sum_ += product;
    const double added = sum_ - before;
    error_ += std::abs(std::fma(a, b, -product)) +
              std::abs((before - (sum_ - added)) + (product - added));
    if (a != 0 && b != 0 && std::abs(product) < 0x1p-960) { // then the first of these is rounded
      error_ += 0x1p-1073;
    }
  }
  [[nodiscard]] double sum() const { return sum_; }
  [[nodiscard]] double error() const { return error_; }

private:
  double sum_ = 0;
  double error_ = 0;
};

} // namespace

AffineMap::AffineMap(const Rows& rows) : rows_(rows) {
  const Vector x = scaled(rows[0]);
  const Vector y = scaled(rows[1]);
  mirrors_ = dot(cross(x, y), scaled(rows[2])) < 0;
}

// Numbers that are what was asked for, as far as arithmetic gives no other ones, have no error.
AffineMap::AffineMap(const Rows& rows, double error, bool mirrors)
    : rows_(rows), mirrors_(mirrors) {
  for (std::size_t k = 0; k < 3; ++k) {
    errors_[k] = {error, error, error};
  }
}

AffineMap AffineMap::translation(const Vector& by) {
  Rows rows = kIdentity;
  rows[3] = by;
  return {rows, 0, false};
}

AffineMap AffineMap::scaling(const Vector& by) {
  Rows rows = kIdentity;
  bool mirrors = false;
  for (std::size_t k = 0; k < 3; ++k) {
    rows[k][k] = by[k];
    mirrors = mirrors != (by[k] < 0);
  }
  return {rows, 0, mirrors};
}

// M is a a^T + c (1 - a a^T) + s [a] for the unit vector a. Numbers of a are off by 4u of
// themselves (three for the length, one for the division), their products by 9u, c and s by 2u.
// With one rounding for each operation the three terms are off by 9u, 13u and 7u, and their sums
// add 2u: 31u in all.
std::optional<AffineMap> AffineMap::rotation(double degrees, const Vector& axis) {
  if (degrees == 0) {
    return AffineMap();
  }
  if (is_zero(axis)) {
    return std::nullopt;
  }
  Vector a = scaled(axis);
  const double all = length(a);
  for (double& number : a) {
    number /= all;
  }
  const auto [sine, cosine] = turn_by(degrees);
  Rows rows = kIdentity;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double product = a[i] * a[j];
      const double turned = i == j ? 0 : ((j + 3 - i) % 3 == 1 ? sine : -sine) * a[3 - i - j];
      rows[i][j] = product + cosine * ((i == j ? 1 : 0) - product) + turned;
    }
  }
  const bool is_exact = std::remainder(degrees, 90.0) == 0 && std::ranges::count(axis, 0.0) == 2;
  return AffineMap(rows, is_exact ? 0 : 32 * kUnit * kRounding, false);
}

// With the unit vectors d, e of `from`, `to` and the angle f between them, M adds k w^T e, where w
// is the unit vector at d x e, turned back from e, and k = sin a / (sin f sin(f - a)).
//
// Off by at most, in u: of themselves, lengths 3 and sin f 12; absolutely, cos f 10 and
// sin(f - a) 29, which is 29 / sin(f - a) of itself, so that k is off by 45 / sin(f - a) of itself;
// absolutely, numbers of w 14 and of e 4. A number of k w^T e is off by 65 k / sin(f - a), and
// the sum by 1 + k more.
std::optional<AffineMap> AffineMap::skew(double degrees, const Vector& from, const Vector& to) {
  if (degrees == 0) {
    return AffineMap();
  }
  const Vector d = scaled(from);
  const Vector e = scaled(to);
  const Vector normal = cross(d, e);
  if (is_zero(d) || is_zero(e) || is_zero(normal) || std::abs(degrees) >= 180) {
    return std::nullopt;
  }
  const double lengths = length(d) * length(e);
  const double sine = length(normal) / lengths;
  const double cosine = dot(d, e) / lengths;
  const Turn turn = turn_by(degrees);
  const double left = sine * turn.cosine - cosine * turn.sine;
  if (!(left > 0x1p-20)) {
    return std::nullopt;
  }
  const double factor = turn.sine / (sine * left);
  const Vector along = cross(e, normal);
  Rows rows = kIdentity;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      rows[i][j] += factor * (along[i] / (length(e) * length(normal))) * (e[j] / length(e));
    }
  }
  return AffineMap(rows, 128 * kUnit * (1 + std::abs(factor)) / left, false);
}

AffineMap operator*(const AffineMap& first, const AffineMap& second) {
  AffineMap all;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      ProductSum sum;
      double error = i == 3 ? second.errors_[3][j] : 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = first.rows_[i][k];
        const double b = second.rows_[k][j];
        sum.add(a, b);
        error += std::abs(a) * second.errors_[k][j] +
                 first.errors_[i][k] * (std::abs(b) + second.errors_[k][j]);
      }
      if (i == 3) {
        sum.add(1, second.rows_[3][j]);
      }
      all.rows_[i][j] = sum.sum();
      all.errors_[i][j] = (error + sum.error()) * kRounding;
    }
  }
  all.mirrors_ = first.mirrors_ != second.mirrors_;
  return all;
}

bool AffineMap::is_identity() const { return rows_ == kIdentity && errors_ == Rows{}; }

bool AffineMap::is_finite() const {
  return std::ranges::all_of(rows_, [](const Vector& row) {
    return std::isfinite(row[0]) && std::isfinite(row[1]) && std::isfinite(row[2]);
  });
}

double AffineMap::stretch() const {
  double squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double most = std::abs(rows_[i][j]) + errors_[i][j];
      squares += most * most;
    }
  }
  return std::sqrt(squares) * kRounding;
}

// Each of the four products is rounded once and goes through three sums at most, which is less than
// 5u of it, and 2^-1075 where it is that small.
double AffineMap::move(double* point, double weight) const {
  const std::array<double, 4> p = {point[0], point[1], point[2], weight};
  double most = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    double error = 0x1p-1072;
    for (std::size_t i = 0; i < 4; ++i) {
      error += std::abs(p[i]) * (std::abs(rows_[i][j]) * (5 * kUnit) + errors_[i][j]);
    }
    point[j] = p[0] * rows_[0][j] + p[1] * rows_[1][j] + p[2] * rows_[2][j] + p[3] * rows_[3][j] +
               0.0; // no -0
    most = std::max(most, error / weight);
  }
  return std::sqrt(3.0) * most * kRounding;
}

} // namespace simdbezier::tools
