// What packing computes for polynomials of any degree, for one channel of as many patches as a
// register has doubles; pack/pack_formulas.hpp has degree 3.
//
// With E the shift to the next control value, a polynomial is ((1-t) + t E)^n b_0, and for
// X = t - 1/2 that is
//     ((1 + E)/2 + X (E - 1))^n b_0 = sum_k X^k C(n,k) 2^(k-n) (E - 1)^k (1 + E)^(n-k) b_0.
// The factors of b_i in (E - 1)^k (1 + E)^(n-k) b_0 are integers of 13 bits, symmetric in i for
// even k and antisymmetric for odd k, and their sum is zero for all k but 0. So coefficients are
// formed from sums of the values that mirror each other (k = 0), from differences of these sums
// (even k), or from differences of the values (odd k). Reversal keeps or turns these, operation by
// operation, which is what shared edges need; and of equal values, all coefficients but the
// constant one are exactly zero, which is what edges need that are a point. Degree 3 uses
// centred_cubic() everywhere, so that an edge gets the same bits from every patch that it bounds.
#pragma once

#include "kernels/pack/pack_formulas.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::kMostOrder;

/// The integers of centring.
struct CentringFactors {
  /// [n][k][i]: of b_{n-i} in (E - 1)^k (1 + E)^(n-k), half of it where that is the middle one; for
  /// even k from 2 on the sum of those up to i, of which the last one is zero.
  short pair[kMostOrder][kMostOrder][kMostOrder / 2 + 1] = {};
  short binomial[kMostOrder][kMostOrder] = {}; ///< [n][k]

  constexpr CentringFactors() {
    for (std::size_t n = 0; n < kMostOrder; ++n) {
      for (std::size_t k = 0; k <= n; ++k) {
        int powers[kMostOrder + 1] = {1}; // of E, the highest first
        for (std::size_t factor = 0; factor < n; ++factor) {
          for (std::size_t i = factor + 1; i > 0; --i) {
            powers[i] += factor < k ? -powers[i - 1] : powers[i - 1];
          }
        }
        int sum = 0;
        for (std::size_t i = 0; 2 * i <= n; ++i) {
          const int own = 2 * i == n ? powers[i] / 2 : powers[i];
          sum += own;
          pair[n][k][i] = static_cast<short>(k > 0 && k % 2 == 0 ? sum : own);
        }
        binomial[n][k] = static_cast<short>(
            k == 0 ? 1 : binomial[n][k - 1] * static_cast<int>(n - k + 1) / static_cast<int>(k));
      }
    }
  }
};
inline constexpr CentringFactors kCentring;

/// Replaces control values values[i * step], 0 <= i <= degree, by the half-centred power
/// coefficients of the polynomial. `degree` is a constant where the caller knows it.
template <typename W>
SIMDBEZIER_INLINE void centre_by_pairs(W* values, std::size_t step, std::size_t degree) {
  W sums[kMostOrder / 2 + 1];
  W steps[kMostOrder / 2 + 1];
  W differences[kMostOrder / 2];
  const std::size_t pairs = (degree + 1) / 2;
  for (std::size_t i = 0; i < pairs; ++i) {
    const W first = values[i * step];
    const W last = values[(degree - i) * step];
    sums[i] = sum_of<W>(first, last);
    differences[i] = difference_of<W>(last, first);
  }
  if (degree % 2 == 0) {
    sums[pairs] = scaled(values[pairs * step], 2);
  }
  for (std::size_t i = 0; i < degree / 2; ++i) {
    steps[i] = difference_of<W>(sums[i], sums[i + 1]);
  }
  double power = 1; // 2^(k - degree)
  for (std::size_t k = degree + 1; k-- > 0; power /= 2) {
    const bool odd = k % 2 != 0;
    const W* const of = k == 0 ? sums : odd ? differences : steps;
    const std::size_t count = k == 0 ? degree / 2 + 1 : odd ? pairs : degree / 2;
    W sum = of[0];
    for (std::size_t i = 1; i < count; ++i) {
      sum = sum_of<W>(sum, times_integer(of[i], kCentring.pair[degree][k][i]));
    }
    values[k * step] = scaled(times_integer(sum, kCentring.binomial[degree][k]), power);
  }
}

template <typename W>
void centre(W* values, std::size_t step, std::size_t degree) {
  switch (degree) {
  case 1:
    return centre_by_pairs(values, step, 1);
  case 2:
    return centre_by_pairs(values, step, 2);
  case 3: {
    W c[detail::kOrder];
    centred_cubic<W>(values[0], values[step], values[2 * step], values[3 * step], c);
    for (std::size_t k = 0; k < detail::kOrder; ++k) {
      values[k * step] = c[k];
    }
    return;
  }
  case 4:
    return centre_by_pairs(values, step, 4);
  case 5:
    return centre_by_pairs(values, step, 5);
  default:
    return centre_by_pairs(values, step, degree);
  }
}

/// Replaces control values by those of the polynomial's first (half 0) or second half: de
/// Casteljau's algorithm at 1/2. What both halves share, they compute alike.
template <typename W>
void halve(W* values, std::size_t step, std::size_t degree, std::size_t half) {
  for (std::size_t level = 1; level <= degree; ++level) {
    for (std::size_t n = degree; n >= level; --n) {
      // The place that is not needed any more gets the mean: seen from the end that stays.
      const std::size_t to = half == 0 ? n : degree - n;
      const std::size_t with = half == 0 ? to - 1 : to + 1;
      values[to * step] = scaled(sum_of<W>(values[to * step], values[with * step]), 0.5);
    }
  }
}

/// Splits the origin of a polynomial of `count` coefficients off; of h/w it is h0/w0, and the
/// numerator of h/w - origin is h - origin w. weights: null for polynomials.
template <typename T, typename W>
SIMDBEZIER_INLINE Wide split_origin(W* values, const W* weights, std::size_t count,
                                    std::size_t step) {
  if (weights == nullptr) {
    return take_origin<T>(values[0]);
  }
  const Wide origin = rounded_to<T>(divide(to_wide(values[0]), to_wide(weights[0])));
  for (std::size_t k = 0; k < count; ++k) {
    values[k * step] = difference_of<W>(values[k * step], product(weights[k * step], origin));
  }
  return origin;
}

/// Replaces one channel's control values of a cell, [j][i], by its coefficients, [l][k], and forms
/// those of its edges, [power][edge].
template <typename W>
void form_channel(const detail::NetShape& shape, W* values, W* edges) {
  const std::size_t order_u = shape.order_u();
  const std::size_t order_v = shape.order_v();
  for (std::size_t e = 0; e < shape.edge_powers() * detail::kEdges; ++e) {
    edges[e] = carried<W>(Wide(0.0));
  }
  for (std::size_t side = 0; side < 2; ++side) {
    W* const edge = edges + detail::kEdgeU0 + side;
    for (std::size_t j = 0; j < order_v; ++j) {
      edge[j * detail::kEdges] = values[j * order_u + side * (order_u - 1)];
    }
    centre(edge, detail::kEdges, order_v - 1);
  }
  for (std::size_t j = 0; j < order_v; ++j) {
    centre(values + j * order_u, 1, order_u - 1);
  }
  for (std::size_t k = 0; k < order_u; ++k) {
    edges[k * detail::kEdges + detail::kEdgeV0] = values[k];
    edges[k * detail::kEdges + detail::kEdgeV1] = values[(order_v - 1) * order_u + k];
    centre(values + k, order_u, order_v - 1);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
