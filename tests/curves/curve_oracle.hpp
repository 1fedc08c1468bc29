// The reference for curves: Bernstein sums of differences in double-double, quotients by the rule.
// Shares nothing with the library, which uses even and odd parts, or Horner's rule, of a centred
// power basis.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/support/oracle/oracle.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests {

/// Curves in memory of their own, packed; weights, where there are any, in Cartesian form.
template <typename S>
struct CurveBatch {
  std::size_t count = 0;
  int degree = 3;
  int components = 3;
  Weights weights = Weights::none;
  std::vector<S> points;

  [[nodiscard]] std::size_t channels() const {
    return static_cast<std::size_t>(components) + (weights == Weights::none ? 0 : 1);
  }
  [[nodiscard]] std::size_t order() const { return static_cast<std::size_t>(degree) + 1; }
  [[nodiscard]] ControlCurves<S> view() const {
    return ControlCurves<S>::packed(points.data(), count, degree, components, weights);
  }
  [[nodiscard]] S& at(std::size_t curve, std::size_t i, std::size_t c) {
    return points[(curve * order() + i) * channels() + c];
  }
  [[nodiscard]] S at(std::size_t curve, std::size_t i, std::size_t c) const {
    return points[(curve * order() + i) * channels() + c];
  }
  [[nodiscard]] CurveBatch reversed() const {
    CurveBatch other = *this;
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < order(); ++i) {
        for (std::size_t c = 0; c < channels(); ++c) {
          other.at(k, i, c) = at(k, order() - 1 - i, c);
        }
      }
    }
    return other;
  }
};

/// Random control points in [-1,1] around `offset`, weights from 1 to `ratio` (0: none).
template <typename S>
CurveBatch<S> random_curves(std::size_t count, int degree, int components, double ratio,
                            std::uint64_t seed, double offset = 0) {
  CurveBatch<S> batch{
      count, degree, components, ratio > 0 ? Weights::cartesian : Weights::none, {}};
  Random random(seed);
  batch.points.resize(count * batch.order() * batch.channels());
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < batch.order(); ++i) {
      for (std::size_t c = 0; c < batch.channels(); ++c) {
        const bool weight = c == static_cast<std::size_t>(components);
        batch.at(k, i, c) =
            static_cast<S>(weight ? std::pow(ratio, random.unit()) : offset + random.symmetric());
      }
    }
  }
  return batch;
}

/// One component of C, C', C'' at half-centred x (exact for doubles).
struct OracleCurve {
  DoubleDouble d[3];
};

/// The derivative of that order of sum_i b_i B_i.
inline DoubleDouble bernstein_derivative(std::vector<DoubleDouble> b, OracleParameter at,
                                         int order) {
  for (int k = 0; k < order; ++k) {
    if (b.size() == 1) {
      return 0.0;
    }
    const double factor = static_cast<double>(b.size()) - 1;
    for (std::size_t i = 0; i + 1 < b.size(); ++i) {
      b[i] = (b[i + 1] - b[i]) * factor;
    }
    b.pop_back();
  }
  const auto weights = bernstein_weights(static_cast<int>(b.size()) - 1, at);
  DoubleDouble sum = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    sum = sum + b[i] * weights[i];
  }
  return sum;
}

template <typename S>
OracleCurve oracle_curve(const CurveBatch<S>& batch, std::size_t curve, std::size_t component,
                         double x, double relative_to = 0) {
  const auto at = OracleParameter::centred(2 * x);
  const auto weight_at = static_cast<std::size_t>(batch.components);
  std::vector<DoubleDouble> h;
  std::vector<DoubleDouble> w;
  for (std::size_t i = 0; i < batch.order(); ++i) {
    w.emplace_back(
        batch.weights == Weights::none ? 1.0 : static_cast<double>(batch.at(curve, i, weight_at)));
    const DoubleDouble point =
        two_sum(static_cast<double>(batch.at(curve, i, component)), -relative_to);
    h.push_back(point * w.back());
  }
  DoubleDouble hd[3];
  DoubleDouble wd[3];
  for (int k = 0; k < 3; ++k) {
    hd[k] = bernstein_derivative(h, at, k);
    wd[k] = bernstein_derivative(w, at, k);
  }
  OracleCurve c;
  c.d[0] = hd[0] / wd[0];
  c.d[1] = (hd[1] - wd[1] * c.d[0]) / wd[0];
  c.d[2] = (hd[2] - wd[1] * c.d[1] * 2.0 - wd[2] * c.d[0]) / wd[0];
  return c;
}

/// The library's half-centred parameter of sample i of n uniform ones: (2i-N)/N, halved.
template <typename T>
double uniform_x(std::size_t i, std::size_t n) {
  const T numerator = static_cast<T>(2 * static_cast<double>(i) - static_cast<double>(n - 1));
  return static_cast<double>(numerator / static_cast<T>(n - 1)) / 2;
}

} // namespace simdbezier::tests
