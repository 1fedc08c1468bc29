// A register of samples that lie alike: in one cell of one patch, all of them inside, or all on the
// same edge or corner. One formula therefore serves all lanes. It yields Taylor coefficients:
// derivatives of any order divided by their factorials. Synthetic division finds these rather than
// derivatives, and Leibniz's rule for them,
//   (w s)_(a,b) = sum_i sum_j w_(i,j) s_(a-i,b-j),
// has no binomial factors. The factorials follow once, at the very end.
#pragma once

#include "kernels/poly/sample_jets.hpp"
#include "kernels/shape/shape_cell.hpp"
#include "src/tables/derivative_task.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::kMostDerivatives;

/// A row is [order in v], the derivatives by v of one channel, or [order in u].
template <typename V>
using TaylorRow = V[kMostDerivatives];
/// A table is [order in u][order in v].
template <typename V>
using TaylorTable = V[kMostDerivatives][kMostDerivatives];

/// to[d] = d-th derivative of sum_k c(k) t^k over d!, d = 0 … highest, for order >= 2: a column,
/// with the operations of horner_series_abreast() and so its bits.
template <typename V, typename Coefficient>
SIMDBEZIER_INLINE void taylor_series(std::size_t order, V t, const Coefficient& c,
                                     std::size_t highest, V* to) {
  for (std::size_t d = 1; d <= highest; ++d) {
    to[d] = broadcast<V>(ScalarOf<V>(0));
  }
  to[0] = c(order - 1);
  for (std::size_t step = 1; step < order; ++step) {
    std::size_t d = step < highest ? step : highest;
    if (d == step) { // begins here, with the last coefficient
      to[d] = to[d - 1];
      --d;
    }
    for (; d > 0; --d) {
      to[d] = madd(to[d], t, to[d - 1]);
    }
    to[0] = madd(to[0], t, c(order - 1 - step));
  }
}

/// This is taylor_series() of a row or an edge: orders up to 2 have the operations of row_series().
template <typename V, typename Coefficient>
SIMDBEZIER_INLINE void taylor_row(std::size_t order, V t, const Coefficient& c, std::size_t highest,
                                  V* to) {
  taylor_series(order, t, c, highest, to);
  if (takes_even_odd(order)) {
    Series<V> s;
    even_odd_rows<2, 1>(Order<0>(order), &t, c, &s);
    const V low[3] = {s.value, s.first, s.second};
    for (std::size_t d = 0; d <= highest && d < 3; ++d) {
      to[d] = low[d];
    }
  }
}

/// h becomes s = h / w, orders 0 … highest; the weight's derivatives come negated.
template <typename V>
SIMDBEZIER_PART void divide_row(const V* minus_w, V inverse, std::size_t highest, V* h) {
  for (std::size_t d = 0; d <= highest; ++d) {
    V sum = h[d];
    for (std::size_t i = d; i > 0; --i) {
      sum = madd(h[d - i], minus_w[i], sum);
    }
    h[d] = sum * inverse;
  }
}

/// This is divide_row() in both directions. `orders` has, with every order, all lower ones. The
/// order of the sum is that of Quotient, for equal bits. to_patch is null, or what to add to the
/// position where derivatives by u use it; see ColumnPolynomials.
template <typename V>
SIMDBEZIER_PART void divide_table(const TaylorTable<V>& minus_w, V inverse,
                                  const detail::DerivativeOrders& orders, const V* to_patch,
                                  TaylorTable<V>& h) {
  V position = h[0][0];
  for (int a = 0; a <= orders.highest_u; ++a) {
    if (a == 1) {
      position = h[0][0];
      h[0][0] = to_patch == nullptr ? position : position + *to_patch;
    }
    for (int b = 0; b <= orders.highest_v[a]; ++b) {
      V sum = h[a][b];
      for (int j = b; j >= 0; --j) {
        for (int i = a; i >= (j == 0 ? 1 : 0); --i) {
          sum = madd(h[a - i][b - j], minus_w[i][j], sum);
        }
      }
      h[a][b] = sum * inverse;
    }
  }
  if (orders.highest_u > 0) {
    h[0][0] = position;
  }
}

/// Entry n is n!.
constexpr double kFactorials[kMostDerivatives] = {
    1,     1,      2,       6,        24,        120,        720,         5040,
    40320, 362880, 3628800, 39916800, 479001600, 6227020800, 87178291200, 1307674368000};

/// Returns what turns the Taylor coefficients of a cell into derivatives by u and v: a! b!, rounded
/// once in double and once in T, and 2 for every order in a direction that has two cells.
template <typename T>
SIMDBEZIER_PART T derivative_factor(int order_u, int order_v, const detail::NetShape& shape) {
  const int doublings = (shape.cells_u() == 2 ? order_u : 0) + (shape.cells_v() == 2 ? order_v : 0);
  return static_cast<T>(kFactorials[order_u] * kFactorials[order_v] *
                        static_cast<double>(std::uint64_t{1} << doublings));
}

using detail::DerivativeTask;

/// The place of a sample in a cell, along one direction.
enum Side : std::size_t { kInside, kLowEnd, kHighEnd, kSides };

/// Computes Taylor coefficients of single channels and of quotients, at the local x, y.
template <typename V>
class CellDerivatives {
  using T = ScalarOf<V>;

public:
  CellDerivatives(const DerivativeTask<T>& task, const Cell<T>& cell, Side side_u, Side side_v, V x,
                  V y)
      : shape_(*task.shape), orders_(*task.orders), cell_(cell), side_u_(side_u), side_v_(side_v),
        x_(x), y_(y) {
    if (shape_.rational) {
      point_u_ = side_u_ != kInside && cell_.origins == nullptr && mark_u() != T(0);
      prepare_weight();
    }
  }

  /// Computes the derivatives of one component that the orders ask for.
  void evaluate(std::size_t component, TaylorTable<V>& to) const {
    merged_table(component, to);
    if (shape_.rational) {
      V to_patch;
      const bool moved = point_u_ || (cell_.origins != nullptr && side_u_ != kInside);
      if (moved) {
        to_patch = relative_origin_u(component);
      }
      divide_table(minus_w_, inverse_, orders_, moved ? &to_patch : nullptr, to);
    }
    if (side_v_ != kInside) {
      TaylorRow<V> along_u;
      along_edge_v(component, along_u);
      if (shape_.rational) {
        divide_row(minus_w_v_, inverse_v_, highest_u(), along_u);
      }
      for (std::size_t a = 0; a <= highest_u(); ++a) {
        to[a][0] = along_u[a];
      }
    }
    place(component, to[0][0]);
  }

private:
  [[nodiscard]] SIMDBEZIER_PART std::size_t highest_u() const {
    return static_cast<std::size_t>(orders_.highest_u);
  }
  [[nodiscard]] SIMDBEZIER_PART std::size_t highest_v(std::size_t a) const {
    return static_cast<std::size_t>(orders_.highest_v[a]);
  }
  [[nodiscard]] SIMDBEZIER_PART std::size_t edge_u() const {
    return side_u_ == kLowEnd ? detail::kEdgeU0 : detail::kEdgeU1;
  }
  [[nodiscard]] SIMDBEZIER_PART std::size_t edge_v() const {
    return side_v_ == kLowEnd ? detail::kEdgeV0 : detail::kEdgeV1;
  }

  /// Finds a channel's Taylor table from the patch's own coefficients, whatever the sides are.
  SIMDBEZIER_KERNEL void table(std::size_t channel, TaylorTable<V>& to) const {
    const T* const matrix = cell_.coefficients + channel * shape_.matrix();
    const std::size_t order_v = shape_.order_v();
    V power[detail::kMostOrder][kMostDerivatives]; // [power of Y][order in u]
    for (std::size_t l = 0; l < order_v; ++l) {
      taylor_series(
          shape_.order_u(), x_,
          [&](std::size_t k) { return broadcast<V>(matrix[k * order_v + l]); }, highest_u(),
          power[l]);
    }
    for (std::size_t a = 0; a <= highest_u(); ++a) {
      if (orders_.highest_v[a] >= 0) {
        taylor_row(
            order_v, y_, [&](std::size_t l) { return power[l][a]; }, highest_v(a), to[a]);
      }
    }
  }

  /// This is table(), but for samples on an edge u = const, what does not depend on u comes from
  /// the edge.
  void merged_table(std::size_t channel, TaylorTable<V>& to) const {
    table(channel, to);
    if (side_u_ != kInside && orders_.highest_v[0] >= 0) {
      along_edge_u(channel, to[0]);
    }
  }

  SIMDBEZIER_KERNEL void edge(std::size_t channel, std::size_t number, std::size_t order, V t,
                              std::size_t highest, V* to) const {
    const T* const powers = cell_.edges + channel * shape_.edge_powers() * 4 + number;
    taylor_row(
        order, t, [&](std::size_t k) { return broadcast<V>(powers[k * 4]); }, highest, to);
  }
  void along_edge_u(std::size_t channel, V* to) const {
    edge(channel, edge_u(), shape_.order_v(), y_, highest_v(0), to);
  }
  void along_edge_v(std::size_t channel, V* to) const {
    edge(channel, edge_v(), shape_.order_u(), x_, highest_u(), to);
  }

  void prepare_weight() {
    const auto weight = static_cast<std::size_t>(shape_.components);
    merged_table(weight, minus_w_);
    inverse_ = Quotient<V>::by(minus_w_[0][0]).inverse;
    for (std::size_t a = 0; a <= highest_u(); ++a) {
      negate(minus_w_[a], highest_v(a));
    }
    if (side_v_ != kInside) {
      along_edge_v(weight, minus_w_v_);
      inverse_v_ = Quotient<V>::by(minus_w_v_[0]).inverse;
      negate(minus_w_v_, highest_u());
    }
  }
  static SIMDBEZIER_PART void negate(V* row, std::size_t highest) {
    for (std::size_t d = 0; d <= highest; ++d) {
      row[d] = negated(row[d]);
    }
  }

  /// Positions are relative to origins; corners are stored.
  SIMDBEZIER_PART void place(std::size_t component, V& position) const {
    if (side_u_ != kInside && side_v_ != kInside) {
      const std::size_t corner =
          detail::corner_index(side_u_ == kHighEnd ? 1 : 0, side_v_ == kHighEnd ? 1 : 0);
      position = broadcast<V>(cell_.edges[shape_.corners_at() + component * 4 + corner]);
    } else if (cell_.origins != nullptr) {
      position =
          position + (side_v_ != kInside ? origin(component, detail::kEdgeOriginsAt + edge_v())
                                         : origin_u(component));
    } else if (point_u_ && side_v_ == kInside) {
      position = position + broadcast<V>(point_u(component));
    }
  }
  SIMDBEZIER_PART V origin(std::size_t component, std::size_t which) const {
    return broadcast<V>(cell_.origins[component * detail::kOriginsPerComponent + which]);
  }
  /// Returns what is added to positions on an edge u = const where derivatives by u use them.
  SIMDBEZIER_PART V relative_origin_u(std::size_t component) const {
    return point_u_ ? broadcast<V>(point_u(component))
                    : origin(component, detail::kRelativeOriginsAt + edge_u() - detail::kEdgeU0);
  }
  /// Returns the mark of an edge u = const, see NetShape.
  SIMDBEZIER_PART T mark_u() const {
    const auto weight = static_cast<std::size_t>(shape_.components);
    return cell_.edges[shape_.corners_at() + weight * 4 + edge_u() - detail::kEdgeU0];
  }
  /// Returns where an edge u = const with a mark is.
  SIMDBEZIER_PART T point_u(std::size_t component) const {
    const std::size_t corner =
        detail::corner_index(edge_u() - detail::kEdgeU0, mark_u() > 1 ? 1 : 0);
    return cell_.edges[shape_.corners_at() + component * 4 + corner];
  }
  /// Returns the origin of the edge u = const if the samples are on one, and the cell's own
  /// elsewhere.
  SIMDBEZIER_PART V origin_u(std::size_t component) const {
    return origin(component, side_u_ == kInside ? 0 : detail::kEdgeOriginsAt + edge_u());
  }

  const NetShape& shape_;
  const detail::DerivativeOrders& orders_;
  Cell<T> cell_;
  Side side_u_;
  Side side_v_;
  bool point_u_ = false; ///< on an edge u = const that is packed around its point
  V x_;
  V y_;
  // Rational patches need the weight, and that along an edge v = const if the samples are on one.
  TaylorTable<V> minus_w_;
  TaylorRow<V> minus_w_v_;
  V inverse_;
  V inverse_v_;
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
