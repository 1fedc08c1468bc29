// Exact patches in rational numbers (GMP): what validates the double-double oracle.
//
// De Casteljau by linear interpolation, so the algorithm differs from the oracle's as well as the
// arithmetic. Slow (about 0.1 ms a sample) and free of rounding: doubles are rationals.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <gmpxx.h>

#include "tests/support/double_double.hpp"
#include "tests/support/net.hpp"

namespace simdbezier::tests {

using Rational = mpq_class;
using Vector3q = std::array<Rational, 3>;

[[nodiscard]] inline Rational exact(double value) { return Rational(value); }
[[nodiscard]] inline Rational exact(DoubleDouble value) {
  return Rational(value.hi) + Rational(value.lo);
}

struct ExactSample {
  Vector3q position;
  Vector3q du;
  Vector3q dv;
  Vector3q duu;
  Vector3q duv;
  Vector3q dvv;
};

/// A curve at one parameter.
struct ExactCurve {
  Rational value;
  Rational first = 0;
  Rational second = 0;
};

/// The curve whose control values are given, by de Casteljau's algorithm.
[[nodiscard]] inline ExactCurve exact_curve(std::vector<Rational> values, const Rational& t) {
  const std::size_t degree = values.size() - 1;
  ExactCurve result;
  for (std::size_t level = degree; level >= 1; --level) {
    if (level == 2) {
      result.second = Rational(static_cast<unsigned long>(degree * (degree - 1))) *
                      ((values[2] - values[1]) - (values[1] - values[0]));
    }
    if (level == 1) {
      result.first = Rational(static_cast<unsigned long>(degree)) * (values[1] - values[0]);
    }
    for (std::size_t i = 0; i < level; ++i) {
      values[i] += t * (values[i + 1] - values[i]);
    }
  }
  result.value = values[0];
  return result;
}

/// Position and all derivatives up to the second at centred parameters.
[[nodiscard]] inline ExactSample exact_sample(const Net& net, double x, double y) {
  const Rational u = (1 + exact(x)) / 2;
  const Rational v = (1 + exact(y)) / 2;
  ExactSample result;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<Rational> values;
    std::vector<Rational> slopes;
    std::vector<Rational> seconds;
    for (int j = 0; j <= net.degree_v; ++j) {
      std::vector<Rational> row;
      for (int i = 0; i <= net.degree_u; ++i) {
        row.push_back(exact(net.at(j, i)[c]));
      }
      const ExactCurve along_u = exact_curve(std::move(row), u);
      values.push_back(along_u.value);
      slopes.push_back(along_u.first);
      seconds.push_back(along_u.second);
    }
    const ExactCurve along_v = exact_curve(std::move(values), v);
    result.position[c] = along_v.value;
    result.dv[c] = along_v.first;
    result.dvv[c] = along_v.second;
    const ExactCurve slope = exact_curve(std::move(slopes), v);
    result.du[c] = slope.value;
    result.duv[c] = slope.first;
    result.duu[c] = exact_curve(std::move(seconds), v).value;
  }
  return result;
}

} // namespace simdbezier::tests
