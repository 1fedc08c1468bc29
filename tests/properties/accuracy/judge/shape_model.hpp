// The library's scheme for patches of any degrees, with and without weights, in plain scalar code.
//
// An evaluator to be judged like any other, never a reference: it shows what the scheme itself can
// reach, and that the bounds and gates of the suite hold for it and fail for a worse one.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tests/properties/accuracy/judge/evaluator.hpp"
#include "tests/properties/accuracy/judge/model.hpp"
#include "tests/properties/accuracy/judge/shape_bounds.hpp"
#include "tests/support/even_odd_model.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace simdbezier::tests {

/// A patch or a quarter of one, one channel: polynomials in local centred parameters.
template <typename T, bool kFused>
class CellModel {
public:
  struct Sample {
    T value;
    T x;
    T y;
    T xx;
    T xy;
    T yy;
  };
  using Row = std::vector<T>;
  using Values = std::vector<std::vector<DoubleDouble>>; ///< [j][i]

  explicit CellModel(const Values& points) {
    const std::size_t n = points.size() - 1;
    const std::size_t m = points[0].size() - 1;
    Values rows;
    for (const auto& row : points) {
      rows.push_back(to_centred(row));
    }
    for (std::size_t k = 0; k <= m; ++k) {
      inner_.push_back(rounded(to_centred(column(rows, k))));
    }
    edges_ = {rounded(rows[0]), rounded(rows[n]), rounded(to_centred(column(points, 0))),
              rounded(to_centred(column(points, m)))};
    corners_ = {points[0][0], points[0][m], points[n][0], points[n][m]};
  }

  [[nodiscard]] T corner(bool right, bool top) const {
    return static_cast<T>(corners_[(top ? 2U : 0U) + (right ? 1U : 0U)].hi);
  }

  [[nodiscard]] Sample evaluate(T x, T y) const {
    const std::size_t powers = inner_[0].size();
    Row values(powers);
    Row slopes(powers);
    Row seconds(powers);
    for (std::size_t l = 0; l < powers; ++l) {
      Row row;
      for (const Row& coefficients : inner_) {
        row.push_back(coefficients[l]);
      }
      const auto [value, slope, half_second] = horner(row, x);
      values[l] = value;
      slopes[l] = slope;
      seconds[l] = half_second;
    }
    if (x == -1 || x == 1) {
      values = edges_[x < 0 ? 2 : 3];
    }
    const auto [value, y_slope, yy] = row_or_edge(values, y);
    const auto [x_slope, xy, unused] = row_or_edge(slopes, y);
    Sample sample{value, x_slope, y_slope, 2 * row_or_edge(seconds, y)[0], xy, 2 * yy};
    if (y == -1 || y == 1) {
      const auto edge = row_or_edge(edges_[y < 0 ? 0 : 1], x);
      sample.value = edge[0];
      sample.x = edge[1];
      sample.xx = 2 * edge[2];
    }
    return sample;
  }

private:
  [[nodiscard]] static T madd(T a, T x, T c) { return kFused ? std::fma(a, x, c) : a * x + c; }

  /// Value, slope and half the second derivative.
  [[nodiscard]] static std::array<T, 3> horner(const Row& a, T x) {
    std::array<T, 3> chain{a.back(), 0, 0};
    for (std::size_t k = a.size() - 1; k-- > 0;) {
      chain[2] = k + 3 == a.size() ? chain[1] : k + 3 < a.size() ? madd(chain[2], x, chain[1]) : 0;
      chain[1] = k + 2 == a.size() ? chain[0] : madd(chain[1], x, chain[0]);
      chain[0] = madd(chain[0], x, a[k]);
    }
    return chain;
  }

  /// Evaluates what comes last, and edges: the order of operations follows the degree.
  [[nodiscard]] static std::array<T, 3> row_or_edge(const Row& a, T x) {
    if (!by_even_and_odd_parts(a.size() - 1)) {
      return horner(a, x);
    }
    const EvenOddJet<T> jet = even_odd(Rounded<T>{kFused}, std::span<const T>(a), x);
    return {jet.value, jet.slope, jet.half_second};
  }

  [[nodiscard]] static std::vector<DoubleDouble> column(const Values& rows, std::size_t k) {
    std::vector<DoubleDouble> result;
    for (const auto& row : rows) {
      result.push_back(row[k]);
    }
    return result;
  }

  [[nodiscard]] static Row rounded(const std::vector<DoubleDouble>& exact) {
    Row row;
    for (const DoubleDouble value : exact) {
      row.push_back(static_cast<T>(value.hi));
    }
    return row;
  }

  /// a_k = C(n,k) (difference/2)^k mean^(n-k).
  [[nodiscard]] static std::vector<DoubleDouble>
  to_centred(const std::vector<DoubleDouble>& values) {
    const std::size_t degree = values.size() - 1;
    std::vector<DoubleDouble> result;
    double binomial = 1;
    for (std::size_t k = 0; k <= degree; ++k) {
      std::vector<DoubleDouble> row = values;
      for (std::size_t step = 0; step < degree; ++step) {
        for (std::size_t i = 0; i + 1 < row.size(); ++i) {
          row[i] = (step < k ? row[i + 1] - row[i] : row[i] + row[i + 1]) * 0.5;
        }
        row.pop_back();
      }
      result.push_back(row[0] * binomial);
      binomial = binomial * static_cast<double>(degree - k) / static_cast<double>(k + 1);
    }
    return result;
  }

  std::vector<Row> inner_;   ///< [k][l] multiplies x^k y^l
  std::array<Row, 4> edges_; ///< v=0, v=1 in x; u=0, u=1 in y
  std::array<DoubleDouble, 4> corners_;
};

template <typename T, bool kFused>
class ShapeModelEvaluator : public Evaluator<T> {
public:
  /// `cut` false: directions stay whole whatever their degree, which is the scheme with a fault.
  explicit ShapeModelEvaluator(bool cut = true) : cut_(cut) {}

  [[nodiscard]] std::string name() const override { return kFused ? "model" : "model_nofma"; }
  [[nodiscard]] ResultClass result_class() const override {
    return kFused ? ResultClass::fma : ResultClass::nofma;
  }
  [[nodiscard]] Capabilities capabilities(const Net& /*net*/) const override {
    return {.normal = false, .second_derivatives = true};
  }
  [[nodiscard]] bool reads_centred() const override { return true; }

  void evaluate(const Net& net, std::span<const Parameters2<T>> at, int /*grid*/,
                std::span<Result<T>> results) override {
    const std::size_t channels = net.is_rational() ? 4 : 3;
    std::vector<std::vector<CellModel<T, kFused>>> cells(channels); // [channel][cell]
    for (std::size_t c = 0; c < channels; ++c) {
      cells[c] = cells_of(net, c);
    }
    for (std::size_t k = 0; k < at.size(); ++k) {
      const Local u = local(net.degree_u, at[k].x);
      const Local v = local(net.degree_v, at[k].y);
      const std::size_t cell = v.cell * (cuts(net.degree_u) ? 2 : 1) + u.cell;
      std::array<Sample, 4> sample{};
      for (std::size_t c = 0; c < channels; ++c) {
        sample[c] = scaled(cells[c][cell].evaluate(u.x, v.x), u.per_unit, v.per_unit);
      }
      for (std::size_t c = 0; c < 3; ++c) {
        store(net.is_rational() ? quotient(sample[c], sample[3]) : sample[c], c, results[k]);
        if ((u.x == -1 || u.x == 1) && (v.x == -1 || v.x == 1)) {
          const T h = cells[c][cell].corner(u.x > 0, v.x > 0);
          results[k].position[c] =
              net.is_rational() ? h / cells[3][cell].corner(u.x > 0, v.x > 0) : h;
        }
      }
      results[k].status = SampleStatus::regular;
    }
  }

private:
  using Sample = typename CellModel<T, kFused>::Sample;
  using Values = typename CellModel<T, kFused>::Values;

  struct Local {
    std::size_t cell;
    T x;
    T per_unit; ///< dx/du
  };

  [[nodiscard]] bool cuts(int degree) const { return cut_ && is_cut(degree); }

  [[nodiscard]] Local local(int degree, T x) const {
    if (!cuts(degree)) {
      return {0, x, 2};
    }
    return x < 0 ? Local{0, 2 * x + 1, 4} : Local{1, 2 * x - 1, 4};
  }

  [[nodiscard]] static Sample scaled(Sample s, T u, T v) {
    return {s.value, u * s.x, v * s.y, u * u * s.xx, u * v * s.xy, v * v * s.yy};
  }

  [[nodiscard]] static Sample quotient(const Sample& h, const Sample& w) {
    const T r = 1 / w.value;
    const auto less = [](T a, T b, T c) { return kFused ? std::fma(-a, b, c) : c - a * b; };
    Sample s;
    s.value = h.value * r;
    s.x = less(s.value, w.x, h.x) * r;
    s.y = less(s.value, w.y, h.y) * r;
    s.xx = less(2 * s.x, w.x, less(s.value, w.xx, h.xx)) * r;
    s.xy = less(s.x, w.y, less(s.y, w.x, less(s.value, w.xy, h.xy))) * r;
    s.yy = less(2 * s.y, w.y, less(s.value, w.yy, h.yy)) * r;
    return s;
  }

  static void store(const Sample& s, std::size_t c, Result<T>& result) {
    result.position[c] = s.value;
    result.du[c] = s.x;
    result.dv[c] = s.y;
    result.duu[c] = s.xx;
    result.duv[c] = s.xy;
    result.dvv[c] = s.yy;
  }

  /// The lower half of a row of control values, or the upper one, by repeated means.
  [[nodiscard]] static std::vector<DoubleDouble> half(std::vector<DoubleDouble> values,
                                                      bool upper) {
    if (upper) {
      values = half({values.rbegin(), values.rend()}, false);
      return {values.rbegin(), values.rend()};
    }
    std::vector<DoubleDouble> result;
    while (!values.empty()) {
      result.push_back(values.front());
      for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        values[i] = (values[i] + values[i + 1]) * 0.5;
      }
      values.pop_back();
    }
    return result;
  }

  [[nodiscard]] static Values transposed_values(const Values& rows) {
    Values result(rows[0].size());
    for (const auto& row : rows) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        result[i].push_back(row[i]);
      }
    }
    return result;
  }

  [[nodiscard]] static Values halves(Values rows, bool upper) {
    for (auto& row : rows) {
      row = half(row, upper);
    }
    return rows;
  }

  [[nodiscard]] std::vector<CellModel<T, kFused>> cells_of(const Net& net, std::size_t c) const {
    Values points(static_cast<std::size_t>(net.degree_v) + 1);
    for (int j = 0; j <= net.degree_v; ++j) {
      for (int i = 0; i <= net.degree_u; ++i) {
        points[static_cast<std::size_t>(j)].push_back(channel_value(net, j, i, c));
      }
    }
    std::vector<CellModel<T, kFused>> cells;
    for (const bool top : {false, true}) {
      for (const bool right : {false, true}) {
        if ((top && !cuts(net.degree_v)) || (right && !cuts(net.degree_u))) {
          continue;
        }
        Values part = cuts(net.degree_u) ? halves(points, right) : points;
        if (cuts(net.degree_v)) {
          part = transposed_values(halves(transposed_values(part), top));
        }
        cells.emplace_back(part);
      }
    }
    return cells;
  }

  bool cut_;
};

} // namespace simdbezier::tests
