// Taylor coefficients: derivatives of any order divided by their factorials, over V = one register
// of samples.
//
// Synthetic division yields these rather than derivatives, and Leibniz's rule for them,
//   (w s)_(a,b) = sum_i sum_j w_(i,j) s_(a-i,b-j),
// has no binomial factors. The factorials follow once, at the very end.
#pragma once

#include "kernels/poly/sample_jets.hpp"
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

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
