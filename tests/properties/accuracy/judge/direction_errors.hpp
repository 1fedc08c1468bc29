// What one direction of a patch adds to the error bounds, maximised from the scheme's own steps.
//
// A running-error formula is a sum of absolute values of terms linear in the control values (in the
// hodograph's, for derivatives), hence convex in them: its maximum over values in [-1,1] lies at
// values of 1 and -1. All of these are tried, at a grid of parameters with both ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <valarray>
#include <vector>

#include "tests/properties/accuracy/judge/shape_bounds.hpp"
#include "tests/properties/accuracy/judge/tracked.hpp"
#include "tests/support/even_odd_model.hpp"

namespace simdbezier::tests {

/// The centred power coefficients that a direction's control values give, on its whole range or on
/// the lower half where the direction is cut in two: coefficient k is row k times the values.
class CentredBasis {
public:
  explicit CentredBasis(int degree) : degree_(degree) {
    for (int i = 0; i <= degree; ++i) {
      std::vector<double> values(size(degree), 0.0);
      values[static_cast<std::size_t>(i)] = 1;
      columns_.push_back(centred(is_cut(degree) ? lower_half(values) : values));
    }
  }

  [[nodiscard]] std::vector<double> coefficients(const std::vector<double>& values) const {
    std::vector<double> sum(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (std::size_t k = 0; k < sum.size(); ++k) {
        sum[k] += values[i] * columns_[i][k];
      }
    }
    return sum;
  }

private:
  [[nodiscard]] static std::size_t size(int degree) { return static_cast<std::size_t>(degree) + 1; }

  /// The control values of the half [0, 1/2], by repeated means.
  [[nodiscard]] static std::vector<double> lower_half(std::vector<double> values) {
    std::vector<double> half;
    while (!values.empty()) {
      half.push_back(values.front());
      for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        values[i] = (values[i] + values[i + 1]) / 2;
      }
      values.pop_back();
    }
    return half;
  }

  /// a_k = C(n,k) (difference/2)^k mean^(n-k): Taylor's formula at the middle, in x in [-1,1].
  [[nodiscard]] std::vector<double> centred(const std::vector<double>& values) const {
    std::vector<double> result;
    double binomial = 1;
    for (int k = 0; k <= degree_; ++k) {
      std::vector<double> row = values;
      for (int step = 0; step < degree_; ++step) {
        for (std::size_t i = 0; i + 1 < row.size(); ++i) {
          row[i] = step < k ? (row[i + 1] - row[i]) / 2 : (row[i] + row[i + 1]) / 2;
        }
        row.pop_back();
      }
      result.push_back(binomial * row[0]);
      binomial = binomial * (degree_ - k) / (k + 1);
    }
    return result;
  }

  int degree_;
  std::vector<std::vector<double>> columns_;
};

/// Control values whose hodograph of that order has the given ones; those of order 0 themselves.
[[nodiscard]] inline std::vector<double> integrated(std::vector<double> values, int order) {
  for (; order > 0; --order) {
    std::vector<double> sums{0};
    for (const double value : values) {
      sums.push_back(sums.back() + value / static_cast<double>(values.size()));
    }
    values = sums;
  }
  return values;
}

/// The size of a value in a chain: its own, or, of a linear form in the control values, the largest
/// that values in [-1,1] can give.
[[nodiscard]] inline double size_of(double value) { return std::abs(value); }
[[nodiscard]] inline double size_of(const std::valarray<double>& form) {
  return std::abs(form).sum();
}

/// The errors of a chain of multiply-adds c[k] = c[k+1] x + below[k], which starts with c[n] =
/// below[n]; errors in units of u.
template <typename Value>
struct Chain {
  std::vector<Value> value;
  std::vector<double> error;

  [[nodiscard]] Chain next(double x, std::size_t last, bool fma) const {
    Chain chain = *this;
    for (std::size_t k = value.size() - 1; k-- > last;) {
      const Value product = chain.value[k + 1] * x;
      chain.value[k] = product + value[k];
      chain.error[k] = chain.error[k + 1] * std::abs(x) + error[k] + size_of(chain.value[k]) +
                       (fma ? 0 : size_of(product));
    }
    return chain;
  }
};

/// The error of the derivative d/dt^order, t over the patch's whole range, by Horner's rule and
/// `order` synthetic divisions from coefficients without error.
template <typename Value>
[[nodiscard]] double running_error(const std::vector<Value>& coefficients, int order, double x,
                                   bool fma, double x_per_t) {
  Chain<Value> chain{coefficients, std::vector<double>(coefficients.size(), 0.0)};
  double factor = 1;
  for (int division = 0; division <= order; ++division) {
    chain = chain.next(x, static_cast<std::size_t>(order), fma);
    factor *= division > 0 ? division * x_per_t : 1;
  }
  return factor * chain.error[static_cast<std::size_t>(order)];
}

/// Returns the error by even and odd parts, of degrees 3 to 5 and up to the second order.
[[nodiscard]] inline double even_odd_error(const std::vector<double>& coefficients, int order,
                                           double x, bool fma) {
  std::vector<Tracked> c;
  for (const double value : coefficients) {
    c.push_back({value});
  }
  const EvenOddJet<Tracked> jet =
      even_odd(TrackedArithmetic{fma}, std::span<const Tracked>(c), Tracked{x});
  return order == 0   ? jet.value.bound()
         : order == 1 ? 2 * jet.slope.bound()
                      : 8 * jet.half_second.bound();
}

/// What maxima are taken over.
inline constexpr double kPlaces[] = {-1.0, -0.9, -0.75, -0.5, 0.0, 0.5, 0.75, 0.9, 1.0};

/// How much the coefficient of the power k counts in the derivative of one order, at x = 1.
[[nodiscard]] inline double power_factor(int k, int order, double x_per_t) {
  double factor = k < order ? 0 : 1;
  for (int step = 0; step < order; ++step) {
    factor *= (k - step) * x_per_t;
  }
  return factor;
}

/// The coefficients as linear forms in the control values of the hodograph of that order.
[[nodiscard]] inline std::vector<std::valarray<double>> coefficient_forms(int degree, int order) {
  const CentredBasis basis(degree);
  const auto count = static_cast<std::size_t>(degree + 1 - order);
  std::vector<std::valarray<double>> forms(static_cast<std::size_t>(degree) + 1,
                                           std::valarray<double>(0.0, count));
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> unit(count, 0.0);
    unit[i] = 1;
    const std::vector<double> a = basis.coefficients(integrated(unit, order));
    for (std::size_t k = 0; k < a.size(); ++k) {
      forms[k][i] = a[k];
    }
  }
  return forms;
}

/// The control values of 1 and -1 that bits give.
[[nodiscard]] inline std::vector<double> signs_of(std::size_t bits, std::size_t count) {
  std::vector<double> signs(count);
  for (std::size_t k = 0; k < count; ++k) {
    signs[k] = ((bits >> k) & 1) != 0 ? -1 : 1;
  }
  return signs;
}

/// The largest sum of the roundings of a row, an edge or a curve, for degrees 3 to 5.
[[nodiscard]] inline RowError largest_row_error(int degree, int order) {
  const CentredBasis basis(degree);
  const auto count = static_cast<std::size_t>(degree + 1 - order);
  RowError largest;
  for (std::size_t bits = 0; bits < std::size_t{1} << (count - 1); ++bits) {
    const std::vector<double> a = basis.coefficients(integrated(signs_of(bits, count), order));
    for (int place = 0; place <= 64; ++place) { // a net's mirror image has the negative ones
      const double x = place / 64.0;
      largest.fused = std::max(largest.fused, even_odd_error(a, order, x, true));
      largest.rounded_twice = std::max(largest.rounded_twice, even_odd_error(a, order, x, false));
    }
  }
  return largest;
}

/// All that shape_bounds.hpp tabulates of one degree, for the derivative of one order.
[[nodiscard]] inline DirectionError largest_direction_error(int degree, int order) {
  const CentredBasis basis(degree);
  const double x_per_t = is_cut(degree) ? 4 : 2;
  const auto count = static_cast<std::size_t>(degree + 1 - order);
  DirectionError largest;
  const std::vector<std::valarray<double>> forms = coefficient_forms(degree, order);
  for (int k = order; k <= degree; ++k) {
    largest.coefficients +=
        power_factor(k, order, x_per_t) * size_of(forms[static_cast<std::size_t>(k)]);
  }
  for (const double x : kPlaces) {
    largest.apart_fused =
        std::max(largest.apart_fused, running_error(forms, order, x, true, x_per_t));
    largest.apart_rounded_twice =
        std::max(largest.apart_rounded_twice, running_error(forms, order, x, false, x_per_t));
  }
  for (std::size_t bits = 0; bits < std::size_t{1} << (count - 1); ++bits) {
    const std::vector<double> a = basis.coefficients(integrated(signs_of(bits, count), order));
    double together = 0;
    for (int k = order; k <= degree; ++k) {
      together += power_factor(k, order, x_per_t) * std::abs(a[static_cast<std::size_t>(k)]);
    }
    largest.together = std::max(largest.together, together);
    for (const double x : kPlaces) {
      largest.fused = std::max(largest.fused, running_error(a, order, x, true, x_per_t));
      largest.rounded_twice =
          std::max(largest.rounded_twice, running_error(a, order, x, false, x_per_t));
    }
  }
  return largest;
}

} // namespace simdbezier::tests
