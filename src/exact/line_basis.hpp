// Bernstein polynomials along a line of parameters.
#pragma once

#include <cstddef>

#include "src/exact/quantities.hpp"
#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {

/// One direction of the line: half-centred parameters x + tau d.
struct LineParameter {
  double x;
  double d;
  Quantity kind;

  /// From a sample to the patch's middle; from the middle itself, in the direction (1,1).
  [[nodiscard]] static LineParameter to_middle(double x, double other, Quantity kind) {
    return {x, x == 0 && other == 0 ? 0.5 : -x, kind};
  }

  void include_in(DigitRange& range) const {
    range.include(0.5);
    range.include(x);
    range.include(d);
  }
  /// Digits of the coefficients of Bernstein polynomials of a degree, all together: their sum is
  /// below (|1/2 - x| + |1/2 + x| + 2 |d|)^degree.
  [[nodiscard]] static int digits(const DigitRange& range, std::size_t degree) {
    return (range.digits() + 3) * static_cast<int>(degree);
  }
};

/// The coefficients in tau of all Bernstein polynomials of degree n and of degree n - 1:
///     B_i = binomial(n,i) (1/2 - x - tau d)^(n-i) (1/2 + x + tau d)^i,
/// by their recurrence. At the ends of the range one of its factors is zero, and so are most B_i.
template <typename Field>
class LineBasis {
  using Value = typename Field::Value;

public:
  /// [i][power of tau]
  using Table = Value[kMostOrder][kMostOrder];

  LineBasis(const Field& field, const LineParameter& at, std::size_t degree) {
    const Value half = field.number(at.kind, 0.5);
    const Value x = field.number(at.kind, at.x);
    const Value low = field.subtract(half, x);
    const Value high = field.add(half, x);
    const Value step = field.number(at.kind, at.d);
    const Value back = field.subtract(field.zero(), step);
    tables_[degree % 2][0][0] = field.one();
    for (std::size_t n = 1; n <= degree; ++n) {
      const Table& from = tables_[(degree - n + 1) % 2];
      Table& to = tables_[(degree - n) % 2];
      for (std::size_t i = 0; i <= n; ++i) {
        for (std::size_t a = 0; a <= n; ++a) {
          Value sum = field.zero();
          if (i < n) {
            sum = add_product(field, from[i], n, a, low, back, sum);
          }
          if (i > 0) {
            sum = add_product(field, from[i - 1], n, a, high, step, sum);
          }
          to[i][a] = sum;
        }
      }
    }
  }

  [[nodiscard]] const Table& upper() const { return tables_[0]; } ///< of degree n
  [[nodiscard]] const Table& lower() const { return tables_[1]; } ///< of degree n - 1

private:
  /// sum + coefficient a of (constant + tau linear) times a polynomial with n coefficients.
  static Value add_product(const Field& field, const Value* polynomial, std::size_t n,
                           std::size_t a, const Value& constant, const Value& linear, Value sum) {
    if (a < n) {
      sum = field.multiply_add(polynomial[a], constant, sum);
    }
    if (a > 0) {
      sum = field.multiply_add(polynomial[a - 1], linear, sum);
    }
    return sum;
  }

  Table tables_[2];
};

} // namespace simdbezier::detail
