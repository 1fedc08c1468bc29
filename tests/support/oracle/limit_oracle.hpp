// Directions of normals and tangents, limits included, decided exactly in integers (GMP).
//
// All numbers are doubles, so everything is an integer times a power of two, and a power of two
// changes neither a direction nor what vanishes. With H = (h, w) the homogeneous surface,
//
//     du x dv = M / w^3,  M = w (h_u x h_v) + w_v (h x h_u) + w_u (h_v x h)
//
// which follows from S_u = (w h_u - w_u h) / w^2, S_v likewise, one factor w of their cross product
// cancelling. w is positive, so that M has the order and the direction of du x dv, and as it is a
// polynomial along the segment to the patch's middle, finitely many coefficients decide.
// Curves: C' = A / w^2, A = w h' - w' h. Nothing here is shared with the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gmpxx.h>

#include "tests/support/nets/net.hpp"

namespace simdbezier::tests {

using Integer = mpz_class;
using Vector3z = std::array<Integer, 3>;
using IntegerSeries = std::vector<Integer>; ///< [power of t]
using VectorSeries = std::vector<Vector3z>; ///< [power of t]

/// The first coefficient that does not vanish: its order, and its direction at unit length.
struct ExactDirection {
  int order = -1; ///< 0: regular; -1: all vanish, and the direction is zero
  Vector3 direction{};
};

/// The binary exponent of the last bit that is set; x is not zero.
[[nodiscard]] inline int lowest_exponent(double x) {
  int exponent = 0;
  auto bits = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  exponent -= 53;
  for (; bits % 2 == 0; bits /= 2) {
    ++exponent;
  }
  return exponent;
}

/// x 2^-exponent, where that is an integer.
[[nodiscard]] inline Integer scaled_integer(double x, int exponent) {
  if (x == 0) {
    return 0;
  }
  const int lowest = lowest_exponent(x);
  Integer result = static_cast<long>(std::ldexp(x, -lowest));
  result <<= static_cast<mp_bitcnt_t>(lowest - exponent);
  return result;
}

/// u / 2^bits, and the step to the middle 1/2 in the same unit.
struct ExactParameter {
  Integer u = 1;
  mp_bitcnt_t bits = 1;
  Integer step = 0;

  /// u = (1 + x) / 2
  static ExactParameter centred(double x) {
    if (x == 0) {
      return {};
    }
    const int exponent = std::min(lowest_exponent(x), 0);
    const Integer numerator = scaled_integer(x, exponent);
    Integer one = 1;
    one <<= static_cast<mp_bitcnt_t>(-exponent);
    return {one + numerator, static_cast<mp_bitcnt_t>(1 - exponent), -numerator};
  }
};

/// p(u + t / 2^bits) 2^(bits n), p = sum_i values[i] B_i^n, up to t^most: differences, then
/// de Casteljau's algorithm without its divisions.
[[nodiscard]] inline IntegerSeries taylor(const std::vector<Integer>& values,
                                          const ExactParameter& at, std::size_t most) {
  const std::size_t n = values.size() - 1;
  Integer rest = 1;
  rest <<= at.bits;
  rest -= at.u;
  std::vector<Integer> differences = values;
  IntegerSeries series;
  Integer binomial = 1;
  for (std::size_t a = 0; a <= std::min(n, most); ++a) {
    std::vector<Integer> b = differences;
    for (std::size_t last = n - a; last > 0; --last) {
      for (std::size_t i = 0; i < last; ++i) {
        b[i] *= rest; // in place: half of the oracle's time is spent here
        mpz_addmul(b[i].get_mpz_t(), at.u.get_mpz_t(), b[i + 1].get_mpz_t());
      }
    }
    series.push_back(binomial * b[0]);
    for (std::size_t i = 0; i + a < n; ++i) {
      differences[i] = differences[i + 1] - differences[i];
    }
    binomial = binomial * static_cast<unsigned long>(n - a) / static_cast<unsigned long>(a + 1);
  }
  return series;
}

/// The components of H, times powers of two of their own for h and for w.
class IntegerNet {
public:
  explicit IntegerNet(const Net& net) : degree_u(net.degree_u), degree_v(net.degree_v) {
    int point_exponent = kNone;
    int weight_exponent = kNone;
    for (const Vector3& point : net.points) {
      for (const double value : point) {
        lower(point_exponent, value);
      }
    }
    for (const double weight : net.weights) {
      lower(weight_exponent, weight);
    }
    for (std::size_t k = 0; k < net.points.size(); ++k) {
      const bool rational = net.is_rational();
      w.push_back(rational ? scaled_integer(net.weights[k], weight_exponent) : Integer(1));
      for (std::size_t c = 0; c < 3; ++c) {
        const Integer value = scaled_integer(net.points[k][c], point_exponent);
        h[c].push_back(rational && !net.homogeneous ? Integer(w.back() * value) : value);
      }
    }
  }

  int degree_u;
  int degree_v;
  std::array<std::vector<Integer>, 3> h; ///< [component][j * (degree_u + 1) + i]
  std::vector<Integer> w;

private:
  static constexpr int kNone = std::numeric_limits<int>::max();
  static void lower(int& exponent, double value) {
    exponent = value == 0 ? exponent : std::min(exponent, lowest_exponent(value));
  }
};

/// A function of (u, v) and its derivatives along the segment p + t d, in powers of t.
struct AlongSegment {
  IntegerSeries value, u, v;
};

/// Up to t^most of each.
[[nodiscard]] inline AlongSegment along_segment(const std::vector<Integer>& values, int degree_u,
                                                const ExactParameter& at_u,
                                                const ExactParameter& at_v, std::size_t most) {
  const auto order = static_cast<std::size_t>(degree_u) + 1;
  std::vector<IntegerSeries> rows;
  for (std::size_t first = 0; first < values.size(); first += order) {
    const auto row = values.begin() + static_cast<std::ptrdiff_t>(first);
    rows.push_back(taylor({row, row + static_cast<std::ptrdiff_t>(order)}, at_u, most + 1));
  }
  AlongSegment result{IntegerSeries(most + 1), IntegerSeries(most + 1), IntegerSeries(most + 1)};
  // The middle itself is left along (1,1); both parameters then have the unit 1/2.
  const bool middle = at_u.step == 0 && at_v.step == 0;
  const Integer step_u = middle ? Integer(1) : at_u.step;
  const Integer step_v = middle ? Integer(1) : at_v.step;
  std::vector<Integer> powers_u{1};
  std::vector<Integer> powers_v{1};
  for (std::size_t k = 0; k <= most; ++k) {
    powers_u.push_back(powers_u.back() * step_u);
    powers_v.push_back(powers_v.back() * step_v);
  }
  std::vector<Integer> column(rows.size());
  for (std::size_t a = 0; a < rows[0].size(); ++a) {
    std::transform(rows.begin(), rows.end(), column.begin(),
                   [a](const IntegerSeries& row) { return row[a]; });
    const IntegerSeries terms = taylor(column, at_v, most + 1 - a);
    for (std::size_t b = 0; b < terms.size(); ++b) {
      if (a + b <= most) {
        result.value[a + b] += terms[b] * powers_u[a] * powers_v[b];
      }
      if (a >= 1) {
        result.u[a + b - 1] += terms[b] * powers_u[a - 1] * powers_v[b] * static_cast<long>(a);
      }
      if (b >= 1) {
        result.v[a + b - 1] += terms[b] * powers_u[a] * powers_v[b - 1] * static_cast<long>(b);
      }
    }
  }
  return result;
}

[[nodiscard]] inline VectorSeries transposed_series(const IntegerSeries& x, const IntegerSeries& y,
                                                    const IntegerSeries& z) {
  VectorSeries result;
  for (std::size_t k = 0; k < x.size(); ++k) {
    result.push_back({x[k], y[k], z[k]});
  }
  return result;
}

/// sum += factor * (a x b), up to the power that `sum` has.
inline void add_cross(VectorSeries& sum, const IntegerSeries& factor, const VectorSeries& a,
                      const VectorSeries& b) {
  if (std::all_of(factor.begin(), factor.end(), [](const Integer& f) { return f == 0; })) {
    return;
  }
  VectorSeries cross(sum.size());
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (std::size_t k = 0; i + k < sum.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t d = (c + 1) % 3;
        const std::size_t e = (c + 2) % 3;
        cross[i + k][c] += a[i][d] * b[k][e] - a[i][e] * b[k][d];
      }
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (std::size_t k = 0; factor[i] != 0 && i + k < sum.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        sum[i + k][c] += factor[i] * cross[k][c];
      }
    }
  }
}

/// The first vector of a series that is not zero.
[[nodiscard]] inline ExactDirection first_direction(const VectorSeries& series) {
  for (std::size_t k = 0; k < series.size(); ++k) {
    std::array<long, 3> exponents{};
    Vector3 direction{};
    long largest = std::numeric_limits<long>::min();
    for (std::size_t c = 0; c < 3; ++c) {
      direction[c] = mpz_get_d_2exp(&exponents[c], series[k][c].get_mpz_t());
      largest = direction[c] == 0 ? largest : std::max(largest, exponents[c]);
    }
    if (largest == std::numeric_limits<long>::min()) {
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      direction[c] =
          std::ldexp(direction[c], static_cast<int>(std::max(exponents[c] - largest, -2000L)));
    }
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    return {static_cast<int>(k),
            {direction[0] / length, direction[1] / length, direction[2] / length}};
  }
  return {};
}

/// The normal of the patch at centred x, y in [-1,1].
[[nodiscard]] inline ExactDirection exact_normal(const IntegerNet& net, double x, double y) {
  const ExactParameter at_u = ExactParameter::centred(x);
  const ExactParameter at_v = ExactParameter::centred(y);
  const std::size_t all = 3 * static_cast<std::size_t>(net.degree_u + net.degree_v);
  // Nearly all samples are decided by the first few coefficients.
  for (std::size_t most = 0;; most = std::min(all, 2 * most + 1)) {
    std::array<AlongSegment, 3> h;
    for (std::size_t c = 0; c < 3; ++c) {
      h[c] = along_segment(net.h[c], net.degree_u, at_u, at_v, most);
    }
    const AlongSegment w = along_segment(net.w, net.degree_u, at_u, at_v, most);
    const VectorSeries value = transposed_series(h[0].value, h[1].value, h[2].value);
    const VectorSeries u = transposed_series(h[0].u, h[1].u, h[2].u);
    const VectorSeries v = transposed_series(h[0].v, h[1].v, h[2].v);
    VectorSeries m(most + 1);
    add_cross(m, w.value, u, v);
    add_cross(m, w.v, value, u);
    add_cross(m, w.u, v, value);
    const ExactDirection found = first_direction(m);
    if (found.order >= 0 || most == all) {
      return found;
    }
  }
}

/// The tangent of a curve, a net of degree_v 0, at centred x in [-1,1].
[[nodiscard]] inline ExactDirection exact_tangent(const IntegerNet& curve, double x) {
  const ExactParameter at = ExactParameter::centred(x);
  const Integer step = at.step == 0 ? Integer(1) : at.step;
  const auto n = static_cast<std::size_t>(curve.degree_u);
  std::array<IntegerSeries, 4> series;
  for (std::size_t c = 0; c < 4; ++c) {
    series[c] = taylor(c < 3 ? curve.h[c] : curve.w, at, n);
  }
  VectorSeries a(2 * n);
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t k = 1; k <= n; ++k) { // w h' - w' h
      for (std::size_t c = 0; c < 3; ++c) {
        a[i + k - 1][c] +=
            static_cast<long>(k) * (series[3][i] * series[c][k] - series[3][k] * series[c][i]);
      }
    }
  }
  ExactDirection found = first_direction(a);
  if (step < 0 && found.order % 2 == 1) { // t^order, t running to the middle
    for (double& value : found.direction) {
      value = -value;
    }
  }
  return found;
}

} // namespace simdbezier::tests
