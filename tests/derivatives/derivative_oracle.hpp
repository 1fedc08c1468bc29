// Partial derivatives of any order in double-double: hodographs by differences of control points,
// de Casteljau's algorithm on each, the quotient rule with its binomial coefficients.
//
// The library expands in powers around the middle of a cell and divides synthetically, so there is
// no step that both share. Source: L. Piegl and W. Tiller, The NURBS Book, 2nd edition, A4.4.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "tests/support/nets/shape_nets.hpp"
#include "tests/support/oracle/oracle_arithmetic.hpp"

namespace simdbezier::tests {

/// [order in u][order in v]
template <typename Value>
using OrderTable = std::vector<std::vector<Value>>;

struct DerivativeOracle {
  OrderTable<DoubleDouble> value;
  /// What errors are relative to. Polynomials: the largest control value of the hodograph.
  /// Quotients: the same rule in absolute values, with the largest control values.
  OrderTable<double> size;
};

/// A scalar control net, [j][i].
using ScalarNet = std::vector<std::vector<DoubleDouble>>;

/// The hodograph in u; a net of one zero where it was constant.
[[nodiscard]] inline ScalarNet hodograph_u(const ScalarNet& net) {
  ScalarNet result;
  for (const auto& row : net) {
    std::vector<DoubleDouble> next;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      next.push_back(DoubleDouble(static_cast<double>(row.size() - 1)) * (row[i + 1] - row[i]));
    }
    result.push_back(next.empty() ? std::vector<DoubleDouble>(1) : next);
  }
  return result;
}

[[nodiscard]] inline ScalarNet transposed(const ScalarNet& net) {
  ScalarNet result(net[0].size(), std::vector<DoubleDouble>(net.size()));
  for (std::size_t j = 0; j < net.size(); ++j) {
    for (std::size_t i = 0; i < net[j].size(); ++i) {
      result[i][j] = net[j][i];
    }
  }
  return result;
}

[[nodiscard]] inline DoubleDouble de_casteljau(std::vector<DoubleDouble> b, DoubleDouble t) {
  for (std::size_t level = b.size() - 1; level > 0; --level) {
    for (std::size_t i = 0; i < level; ++i) {
      b[i] = b[i] + t * (b[i + 1] - b[i]);
    }
  }
  return b[0];
}

[[nodiscard]] inline DoubleDouble de_casteljau(const ScalarNet& net, DoubleDouble u,
                                               DoubleDouble v) {
  std::vector<DoubleDouble> column;
  for (const auto& row : net) {
    column.push_back(de_casteljau(row, u));
  }
  return de_casteljau(column, v);
}

/// The derivatives of a polynomial, of orders 0 … most_u and 0 … most_v.
[[nodiscard]] inline DerivativeOracle polynomial_derivatives(ScalarNet net, int most_u, int most_v,
                                                             DoubleDouble u, DoubleDouble v) {
  DerivativeOracle result;
  for (int a = 0; a <= most_u; ++a) {
    ScalarNet by_v = transposed(net);
    auto& values = result.value.emplace_back();
    auto& sizes = result.size.emplace_back();
    for (int b = 0; b <= most_v; ++b) {
      double size = 0;
      for (const auto& row : by_v) {
        for (const DoubleDouble p : row) {
          size = std::max(size, abs(p).to_double());
        }
      }
      sizes.push_back(size);
      values.push_back(de_casteljau(by_v, v, u));
      by_v = hodograph_u(by_v);
    }
    net = hodograph_u(net);
  }
  return result;
}

[[nodiscard]] inline double binomial(std::size_t n, std::size_t k) {
  double result = 1;
  for (std::size_t i = 1; i <= k; ++i) {
    result = result * static_cast<double>(n - k + i) / static_cast<double>(i);
  }
  return result;
}

[[nodiscard]] inline DerivativeOracle quotient_derivatives(const DerivativeOracle& h,
                                                           const DerivativeOracle& w) {
  DerivativeOracle s = h;
  const double weight = w.value[0][0].to_double();
  for (std::size_t a = 0; a < s.value.size(); ++a) {
    for (std::size_t b = 0; b < s.value[a].size(); ++b) {
      for (std::size_t i = 0; i <= a; ++i) {
        for (std::size_t j = i == 0 ? 1 : 0; j <= b; ++j) {
          const double factor = binomial(a, i) * binomial(b, j);
          s.value[a][b] =
              s.value[a][b] - DoubleDouble(factor) * w.value[i][j] * s.value[a - i][b - j];
          s.size[a][b] += factor * w.size[i][j] * s.size[a - i][b - j];
        }
      }
      s.value[a][b] = s.value[a][b] / w.value[0][0];
      s.size[a][b] /= weight;
    }
  }
  return s;
}

/// One channel of packed nets; components of rational nets times their weight.
template <typename S>
[[nodiscard]] ScalarNet scalar_net(const std::vector<S>& values, const ShapeCase& c,
                                   std::size_t patch, std::size_t channel) {
  ScalarNet net;
  const S* point = values.data() + patch * c.values();
  for (int j = 0; j <= c.degree_v; ++j) {
    auto& row = net.emplace_back();
    for (int i = 0; i <= c.degree_u; ++i, point += c.channels()) {
      const bool weighted = c.weights == Weights::cartesian && channel + 1 < c.channels();
      const DoubleDouble value = static_cast<double>(point[channel]);
      row.push_back(weighted ? value * static_cast<double>(point[c.channels() - 1]) : value);
    }
  }
  return net;
}

/// The derivatives of one component, at centred parameters.
template <typename S>
[[nodiscard]] DerivativeOracle exact_derivatives(const std::vector<S>& values, const ShapeCase& c,
                                                 std::size_t patch, std::size_t component,
                                                 int most_u, int most_v, double x, double y) {
  const auto of_channel = [&](std::size_t channel) {
    return polynomial_derivatives(scalar_net(values, c, patch, channel), most_u, most_v,
                                  (DoubleDouble(1) + DoubleDouble(x)) * DoubleDouble(0.5),
                                  (DoubleDouble(1) + DoubleDouble(y)) * DoubleDouble(0.5));
  };
  return c.weights == Weights::none
             ? of_channel(component)
             : quotient_derivatives(of_channel(component), of_channel(c.channels() - 1));
}

} // namespace simdbezier::tests
