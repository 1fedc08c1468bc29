// Exact control values of surfaces, and the bound that splines.hpp states for computed ones.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "tests/splines/spline_models.hpp"

namespace simdbezier::tests {

/// One channel of a surface as fractions, weights multiplied where they are Cartesian.
template <typename T>
Rational exact_value(const SurfaceModel<T>& model, std::size_t row, std::size_t column,
                     std::size_t c) {
  const Rational value(static_cast<double>(model.at(row, column, c)));
  const auto weight_at = static_cast<std::size_t>(model.components);
  return model.weights == Weights::cartesian && c < weight_at
             ? Rational(value * Rational(static_cast<double>(model.at(row, column, weight_at))))
             : value;
}

/// The exact control values [patch][j][i] of one channel.
template <typename T>
std::vector<Rational> exact_nets(const SurfaceModel<T>& model, std::size_t c) {
  std::vector<std::vector<std::vector<Rational>>> rows; // [row][span][i]
  for (std::size_t row = 0; row < model.v.points; ++row) {
    std::vector<Rational> line;
    for (std::size_t column = 0; column < model.u.points; ++column) {
      line.push_back(exact_value(model, row, column, c));
    }
    rows.push_back(exact_pieces(model.u, line));
  }
  const std::size_t spans_u = rows[0].size();
  const std::size_t order_u = model.u.order();
  std::vector<std::vector<std::vector<Rational>>> columns; // [span * order + i][span][j]
  for (std::size_t at = 0; at < spans_u * order_u; ++at) {
    std::vector<Rational> line;
    for (const auto& row : rows) {
      line.push_back(row[at / order_u][at % order_u]);
    }
    columns.push_back(exact_pieces(model.v, line));
  }
  std::vector<Rational> nets;
  for (std::size_t sv = 0; sv < columns[0].size(); ++sv) {
    for (std::size_t su = 0; su < spans_u; ++su) {
      for (std::size_t j = 0; j < model.v.order(); ++j) {
        for (std::size_t i = 0; i < order_u; ++i) {
          nets.push_back(columns[su * order_u + i][sv][j]);
        }
      }
    }
  }
  return nets;
}

/// A surface and its exact control values, once for all instruction sets.
template <typename T>
struct ExactCase {
  std::string name;
  SurfaceModel<T> model;
  std::vector<std::vector<Rational>> exact; // [channel][value]
  std::vector<Rational> bound;              // of each channel
};

template <typename T>
ExactCase<T> exact_case(const std::string& name, const SurfaceModel<T>& model) {
  ExactCase<T> item{name, model, {}, {}};
  const std::size_t points = model.u.points * model.v.points;
  for (std::size_t c = 0; c < model.channels(); ++c) {
    item.exact.push_back(exact_nets(model, c));
    Rational largest = 0;
    for (std::size_t k = 0; k < points; ++k) {
      largest = std::max(
          largest, Rational(abs(exact_value(model, k / model.u.points, k % model.u.points, c))));
    }
    item.bound.push_back(largest *
                         Rational(spline_error(model.u.degree, model.v.degree, model.weights)));
  }
  return item;
}

} // namespace simdbezier::tests
