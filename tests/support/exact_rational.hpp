// Exact patches in rational numbers (GMP): what validates the double-double oracle.
//
// De Casteljau by linear interpolation, so the algorithm differs from the oracle's as well as the
// arithmetic. Slow (about 0.1 ms a sample) and free of rounding: doubles are rationals.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
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
  Vector3q duv;
};

/// Value and derivative of a curve whose control values are given, by de Casteljau's algorithm.
[[nodiscard]] inline std::pair<Rational, Rational> exact_curve(std::vector<Rational> values,
                                                               const Rational& t) {
  const std::size_t degree = values.size() - 1;
  Rational derivative = 0;
  for (std::size_t level = degree; level >= 1; --level) {
    if (level == 1) {
      derivative = Rational(static_cast<unsigned long>(degree)) * (values[1] - values[0]);
    }
    for (std::size_t i = 0; i < level; ++i) {
      values[i] += t * (values[i + 1] - values[i]);
    }
  }
  return {values[0], derivative};
}

/// Position, tangents and twist at centred parameters.
[[nodiscard]] inline ExactSample exact_sample(const Net& net, double x, double y) {
  const Rational u = (1 + exact(x)) / 2;
  const Rational v = (1 + exact(y)) / 2;
  ExactSample result;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<Rational> values;
    std::vector<Rational> slopes;
    for (int j = 0; j <= net.degree_v; ++j) {
      std::vector<Rational> row;
      for (int i = 0; i <= net.degree_u; ++i) {
        row.push_back(exact(net.at(j, i)[c]));
      }
      auto [value, slope] = exact_curve(std::move(row), u);
      values.push_back(std::move(value));
      slopes.push_back(std::move(slope));
    }
    std::tie(result.position[c], result.dv[c]) = exact_curve(std::move(values), v);
    std::tie(result.du[c], result.duv[c]) = exact_curve(std::move(slopes), v);
  }
  return result;
}

} // namespace simdbezier::tests
