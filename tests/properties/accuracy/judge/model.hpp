// The library's scheme once more in plain scalar code, with faults that can be switched on.
//
// Without a fault it must give the library's bits: that pins the one order of evaluation that
// reproducibility rests on (docs/architecture.md). With a fault it shows that the checks of this
// suite see what they are for. It is judged like any evaluator and never used as a reference.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "tests/support/even_odd_model.hpp"
#include "tests/support/nets/net.hpp"
#include "tests/support/oracle/oracle_arithmetic.hpp"

namespace simdbezier::tests {

enum class Fault : std::uint8_t {
  none,
  contracted,          ///< one multiply-add rounds once where its class rounds twice, or back
  no_corner_store,     ///< corners come from the edge polynomials
  reciprocal_step,     ///< x_i = 2 (i * (1/N)) - 1
  coefficients_in_type ///< the coefficients are formed in T instead of in higher precision
};

/// One component of one bicubic patch.
template <typename T, bool kFused>
class Model {
public:
  struct Sample {
    T position;
    T du;
    T dv;
    T duu;
    T duv;
    T dvv;
  };

  Model(const Net& net, std::size_t component, Fault fault) : fault_(fault) {
    if (fault == Fault::coefficients_in_type) {
      form<T>(net, component);
    } else if constexpr (std::is_same_v<T, float>) {
      form<double>(net, component);
    } else {
      form<DoubleDouble>(net, component);
    }
  }

  /// x_i of N intervals.
  [[nodiscard]] T centred(int i, int intervals) const {
    if (fault_ == Fault::reciprocal_step) {
      return 2 * (static_cast<T>(i) * (1 / static_cast<T>(intervals))) - 1;
    }
    return static_cast<T>(2 * i - intervals) / static_cast<T>(intervals);
  }

  [[nodiscard]] Sample evaluate(T x, T y) const {
    std::array<T, 4> along_y;
    std::array<T, 4> slope_x;
    std::array<T, 4> half_second_x;
    for (std::size_t l = 0; l < 4; ++l) {
      const ValueSlope row = horner({inner_[0][l], inner_[1][l], inner_[2][l], inner_[3][l]}, x);
      along_y[l] = row.value;
      slope_x[l] = row.slope;
      half_second_x[l] = row.half_second;
    }
    const bool on_u = x == -1 || x == 1;
    const bool on_v = y == -1 || y == 1;
    if (on_u) {
      along_y = edges_[x < 0 ? 2 : 3];
    }
    const ValueSlope outer = row_or_edge(along_y, y);
    const ValueSlope slope = row_or_edge(slope_x, y);
    Sample sample{outer.value,     2 * slope.value,
                  2 * outer.slope, 8 * row_or_edge(half_second_x, y).value,
                  4 * slope.slope, 8 * outer.half_second};
    if (on_v) {
      const ValueSlope edge = row_or_edge(edges_[y < 0 ? 0 : 1], x);
      sample.position = edge.value;
      sample.du = 2 * edge.slope;
      sample.duu = 8 * edge.half_second;
    }
    if (on_u && on_v && fault_ != Fault::no_corner_store) {
      sample.position = corners_[(y < 0 ? 0u : 2u) + (x < 0 ? 0u : 1u)];
    }
    return sample;
  }

private:
  using ValueSlope = EvenOddJet<T>;

  [[nodiscard]] static T madd(T a, T x, T c) {
    if constexpr (kFused) {
      return std::fma(a, x, c);
    } else {
      return a * x + c;
    }
  }

  /// The last step of a column's value, where the fault "contracted" sits.
  [[nodiscard]] T last(T a, T x, T c) const {
    if (fault_ == Fault::contracted) {
      return kFused ? a * x + c : std::fma(a, x, c);
    }
    return madd(a, x, c);
  }

  [[nodiscard]] ValueSlope horner(const std::array<T, 4>& a, T x) const {
    const T r2 = madd(a[3], x, a[2]);
    const T r1 = madd(r2, x, a[1]);
    const T s1 = madd(a[3], x, r2);
    return {last(r1, x, a[0]), madd(s1, x, r1), madd(a[3], x, s1)};
  }

  /// What comes last, and edges, whichever way they run: by even and odd parts.
  [[nodiscard]] static ValueSlope row_or_edge(const std::array<T, 4>& a, T x) {
    return even_odd(Rounded<T>{kFused}, std::span<const T>(a), x);
  }

  [[nodiscard]] static T to_type(double value) { return static_cast<T>(value); }
  [[nodiscard]] static T to_type(DoubleDouble value) { return static_cast<T>(value.hi); }

  /// Folded sums: a reversed edge gives the same numbers with the odd powers' signs turned.
  template <typename S>
  [[nodiscard]] static std::array<S, 4> to_centred(const std::array<S, 4>& b) {
    const S outer = b[0] + b[3];
    const S inner = b[1] + b[2];
    const S outer_step = b[3] - b[0];
    const S inner_step = b[2] - b[1];
    return {(outer + S(3) * inner) * S(0.125), (outer_step + inner_step) * S(0.375),
            ((b[0] - b[1]) + (b[3] - b[2])) * S(0.375),
            (outer_step - S(3) * inner_step) * S(0.125)};
  }

  template <typename S>
  void form(const Net& net, std::size_t c) {
    std::array<std::array<S, 4>, 4> rows;
    const auto value = [&](int j, int i) { return S(static_cast<T>(net.at(j, i)[c] + 0.0)); };
    for (int j = 0; j < 4; ++j) {
      rows[static_cast<std::size_t>(j)] =
          to_centred<S>({value(j, 0), value(j, 1), value(j, 2), value(j, 3)});
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const auto column = to_centred<S>({rows[0][k], rows[1][k], rows[2][k], rows[3][k]});
      for (std::size_t l = 0; l < 4; ++l) {
        inner_[k][l] = to_type(column[l]);
      }
    }
    for (int side = 0; side < 4; ++side) {
      const int fixed = side % 2 == 0 ? 0 : 3;
      const auto point = [&](int k) { return side < 2 ? value(fixed, k) : value(k, fixed); };
      const auto edge = to_centred<S>({point(0), point(1), point(2), point(3)});
      for (std::size_t k = 0; k < 4; ++k) {
        edges_[static_cast<std::size_t>(side)][k] = to_type(edge[k]);
      }
    }
    corners_ = {to_type(value(0, 0)), to_type(value(0, 3)), to_type(value(3, 0)),
                to_type(value(3, 3))};
  }

  Fault fault_;
  std::array<std::array<T, 4>, 4> inner_; ///< [k][l] multiplies x^k y^l
  std::array<std::array<T, 4>, 4> edges_; ///< v=0, v=1 in x; u=0, u=1 in y
  std::array<T, 4> corners_;              ///< [2*j + i]
};

} // namespace simdbezier::tests
