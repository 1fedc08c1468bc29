#include "tests/support/oracle/oracle.hpp"

#include <algorithm>

namespace simdbezier::tests {
namespace {

[[nodiscard]] OracleSample rational_sample(const Net& net, OracleParameter u, OracleParameter v) {
  const auto h = channel_derivatives(net, u, v, {0, 0});
  const auto h_u = channel_derivatives(net, u, v, {1, 0});
  const auto h_v = channel_derivatives(net, u, v, {0, 1});
  const auto h_uu = channel_derivatives(net, u, v, {2, 0});
  const auto h_uv = channel_derivatives(net, u, v, {1, 1});
  const auto h_vv = channel_derivatives(net, u, v, {0, 2});
  constexpr std::size_t w = kWeightChannel;
  OracleSample s;
  for (std::size_t c = 0; c < 3; ++c) {
    s.position[c] = h[c] / h[w];
    s.du[c] = (h_u[c] - s.position[c] * h_u[w]) / h[w];
    s.dv[c] = (h_v[c] - s.position[c] * h_v[w]) / h[w];
    s.duu[c] = (h_uu[c] - s.du[c] * h_u[w] * 2.0 - s.position[c] * h_uu[w]) / h[w];
    s.duv[c] = (h_uv[c] - s.du[c] * h_v[w] - s.dv[c] * h_u[w] - s.position[c] * h_uv[w]) / h[w];
    s.dvv[c] = (h_vv[c] - s.dv[c] * h_v[w] * 2.0 - s.position[c] * h_vv[w]) / h[w];
  }
  return s;
}

} // namespace

std::vector<DoubleDouble> bernstein_weights(int degree, OracleParameter at) {
  std::vector<DoubleDouble> weights(static_cast<std::size_t>(degree) + 1, DoubleDouble(1.0));
  DoubleDouble power = 1.0;
  double binomial = 1;
  for (int i = 0; i <= degree; ++i) {
    weights[static_cast<std::size_t>(i)] = power * binomial;
    power = power * at.t;
    binomial = binomial * (degree - i) / (i + 1); // exact: C(n,i) * (n-i) is a multiple of i+1
  }
  power = 1.0;
  for (int i = degree; i >= 0; --i) {
    weights[static_cast<std::size_t>(i)] = weights[static_cast<std::size_t>(i)] * power;
    power = power * at.complement;
  }
  return weights;
}

std::vector<DoubleDouble> hodograph(const Net& net, std::size_t c, Derivative order) {
  auto columns = static_cast<std::size_t>(net.degree_u) + 1;
  auto rows = static_cast<std::size_t>(net.degree_v) + 1;
  std::vector<DoubleDouble> values;
  values.reserve(rows * columns);
  for (int j = 0; j <= net.degree_v; ++j) {
    for (int i = 0; i <= net.degree_u; ++i) {
      values.push_back(channel_value(net, j, i, c));
    }
  }
  // Differences replace the points: what is overwritten has been read by then.
  for (int done = 0; done < order.u; ++done, --columns) {
    const double factor = net.degree_u - done;
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i + 1 < columns; ++i) {
        const std::size_t from = j * columns + i;
        values[j * (columns - 1) + i] = (values[from + 1] - values[from]) * factor;
      }
    }
  }
  for (int done = 0; done < order.v; ++done, --rows) {
    const double factor = net.degree_v - done;
    for (std::size_t k = 0; k < (rows - 1) * columns; ++k) {
      values[k] = (values[k + columns] - values[k]) * factor;
    }
  }
  values.resize(rows * columns);
  return values;
}

double largest_hodograph(const Net& net, std::size_t component, Derivative order) {
  double largest = 0;
  if (order.u > net.degree_u || order.v > net.degree_v) {
    return largest;
  }
  for (const DoubleDouble& value : hodograph(net, component, order)) {
    largest = std::max(largest, std::abs(value.to_double()));
  }
  return largest;
}

std::array<DoubleDouble, 4> channel_derivatives(const Net& net, OracleParameter u,
                                                OracleParameter v, Derivative order) {
  std::array<DoubleDouble, 4> sum;
  if (order.u > net.degree_u || order.v > net.degree_v) {
    return sum;
  }
  const auto weights_u = bernstein_weights(net.degree_u - order.u, u);
  const auto weights_v = bernstein_weights(net.degree_v - order.v, v);
  for (std::size_t c = 0; c < (net.is_rational() ? 4U : 3U); ++c) {
    const std::vector<DoubleDouble> values = hodograph(net, c, order);
    const DoubleDouble* value = values.data();
    for (const DoubleDouble& weight_v : weights_v) {
      DoubleDouble row;
      for (const DoubleDouble& weight_u : weights_u) {
        row = row + *value++ * weight_u;
      }
      sum[c] = sum[c] + row * weight_v;
    }
  }
  return sum;
}

OracleSample oracle_sample(const Net& net, OracleParameter u, OracleParameter v) {
  if (net.is_rational()) {
    return rational_sample(net, u, v);
  }
  return {oracle_derivative(net, u, v, {0, 0}), oracle_derivative(net, u, v, {1, 0}),
          oracle_derivative(net, u, v, {0, 1}), oracle_derivative(net, u, v, {2, 0}),
          oracle_derivative(net, u, v, {1, 1}), oracle_derivative(net, u, v, {0, 2})};
}

} // namespace simdbezier::tests
