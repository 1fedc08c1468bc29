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

#include "tests/support/nets/net.hpp"
#include "tests/support/oracle/oracle_arithmetic.hpp"

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

/// One channel of a net: a component, times its weight where there are weights, or the weight (3).
[[nodiscard]] inline Rational exact_channel(const Net& net, int j, int i, std::size_t c) {
  const Rational weight = exact(net.weight(j, i));
  if (c == 3) {
    return weight;
  }
  const Rational value = exact(net.at(j, i)[c]);
  return net.is_rational() && !net.homogeneous ? Rational(weight * value) : value;
}

/// Value and derivatives of one channel.
struct ExactChannel {
  Rational value, du, dv, duu, duv, dvv;
};

[[nodiscard]] inline ExactChannel exact_channel_at(const Net& net, const Rational& u,
                                                   const Rational& v, std::size_t c) {
  std::vector<Rational> values;
  std::vector<Rational> slopes;
  std::vector<Rational> seconds;
  for (int j = 0; j <= net.degree_v; ++j) {
    std::vector<Rational> row;
    for (int i = 0; i <= net.degree_u; ++i) {
      row.push_back(exact_channel(net, j, i, c));
    }
    const ExactCurve along_u = exact_curve(std::move(row), u);
    values.push_back(along_u.value);
    slopes.push_back(along_u.first);
    seconds.push_back(along_u.second);
  }
  const ExactCurve along_v = exact_curve(std::move(values), v);
  const ExactCurve slope = exact_curve(std::move(slopes), v);
  return {along_v.value, slope.value,   along_v.first, exact_curve(std::move(seconds), v).value,
          slope.first,   along_v.second};
}

/// h / w and its derivatives. Written as those of the product h * (1/w), so that not even the
/// quotient rule is the oracle's own: (1/w)' = -w'/w^2, (1/w)'' = 2 w' w' / w^3 - w'' / w^2.
[[nodiscard]] inline ExactChannel exact_quotient(const ExactChannel& h, const ExactChannel& w) {
  const Rational r = 1 / w.value;
  const Rational ru = -w.du * r * r;
  const Rational rv = -w.dv * r * r;
  const Rational ruu = 2 * w.du * w.du * r * r * r - w.duu * r * r;
  const Rational ruv = 2 * w.du * w.dv * r * r * r - w.duv * r * r;
  const Rational rvv = 2 * w.dv * w.dv * r * r * r - w.dvv * r * r;
  return {h.value * r,
          h.du * r + h.value * ru,
          h.dv * r + h.value * rv,
          h.duu * r + 2 * h.du * ru + h.value * ruu,
          h.duv * r + h.du * rv + h.dv * ru + h.value * ruv,
          h.dvv * r + 2 * h.dv * rv + h.value * rvv};
}

/// Position and all derivatives up to the second at centred parameters.
[[nodiscard]] inline ExactSample exact_sample(const Net& net, double x, double y) {
  const Rational u = (1 + exact(x)) / 2;
  const Rational v = (1 + exact(y)) / 2;
  ExactSample result;
  for (std::size_t c = 0; c < 3; ++c) {
    ExactChannel at = exact_channel_at(net, u, v, c);
    if (net.is_rational()) {
      at = exact_quotient(at, exact_channel_at(net, u, v, 3));
    }
    result.position[c] = at.value;
    result.du[c] = at.du;
    result.dv[c] = at.dv;
    result.duu[c] = at.duu;
    result.duv[c] = at.duv;
    result.dvv[c] = at.dvv;
  }
  return result;
}

/// Gaussian and mean curvature. The mean one holds a root, so its square is given, with its sign.
struct ExactCurvature {
  Rational gaussian;
  Rational mean_squared;
};

[[nodiscard]] inline ExactCurvature exact_curvature(const ExactSample& s) {
  const auto dot = [](const Vector3q& a, const Vector3q& b) -> Rational {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const Vector3q normal = {s.du[1] * s.dv[2] - s.du[2] * s.dv[1],
                           s.du[2] * s.dv[0] - s.du[0] * s.dv[2],
                           s.du[0] * s.dv[1] - s.du[1] * s.dv[0]};
  const Rational e = dot(s.du, s.du);
  const Rational f = dot(s.du, s.dv);
  const Rational g = dot(s.dv, s.dv);
  const Rational area = e * g - f * f;   // |du x dv|^2 by Lagrange's identity
  const Rational l = dot(s.duu, normal); // L, M, N times |du x dv|
  const Rational m = dot(s.duv, normal);
  const Rational n = dot(s.dvv, normal);
  const Rational twice = e * n - 2 * f * m + g * l;
  return {(l * n - m * m) / (area * area), twice * abs(twice) / (4 * area * area * area)};
}

} // namespace simdbezier::tests
