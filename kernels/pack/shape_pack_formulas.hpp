// What packing computes for polynomials of any degree, for one channel of as many patches as a
// register has doubles; pack/pack_formulas.hpp has degree 3.
//
// With E the shift to the next control value, a polynomial is ((1-t) + t E)^n b_0, and for
// X = t - 1/2 that is
//     ((1 + E)/2 + X (E - 1))^n b_0 = sum_k X^k C(n,k) (E - 1)^k ((1 + E)/2)^(n-k) b_0:
// coefficients are k-fold differences of (n-k)-fold sums of neighbours, times C(n,k) 2^(k-n). Both
// are symmetric or antisymmetric under reversal, operation by operation, which is what shared edges
// need; there is no product before the last one. Degree 3 uses centred_cubic() everywhere, so that
// an edge gets the same bits from every patch that it bounds.
#pragma once

#include "kernels/pack/pack_formulas.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::kMostOrder;

/// The factors C(n,k) 2^(k-n), which are exact.
struct CentringFactors {
  double at[kMostOrder][kMostOrder] = {};

  constexpr CentringFactors() {
    for (std::size_t n = 0; n < kMostOrder; ++n) {
      double binomial = 1;
      for (std::size_t k = 0; k <= n; ++k) {
        at[n][k] = binomial;
        for (std::size_t m = k; m < n; ++m) {
          at[n][k] *= 0.5;
        }
        binomial = binomial * static_cast<double>(n - k) / static_cast<double>(k + 1);
      }
    }
  }
};
inline constexpr CentringFactors kCentring;

/// Packs [begin, end) by `group`, a register of patches or curves at a time, up to the first group
/// that may hold a fault.
template <typename Group>
SIMDBEZIER_INLINE detail::PackDoubt pack_groups(Group& group, std::size_t begin, std::size_t end) {
  for (std::size_t at = begin; at < end; at += kWideLanes) {
    const std::size_t count = end - at < kWideLanes ? end - at : kWideLanes;
    if (!group.pack(at, count)) {
      return {at, at + count};
    }
  }
  return {end, end};
}

/// Replaces control values by the half-centred power coefficients of the polynomial. `degree` is a
/// constant where the caller knows it.
template <typename W>
SIMDBEZIER_INLINE void centre_by_pyramid(W* values, std::size_t step, std::size_t degree) {
  W sums[kMostOrder];
  for (std::size_t i = 0; i <= degree; ++i) {
    sums[i] = values[i * step];
  }
  for (std::size_t k = degree + 1; k-- > 0;) { // sums[0..k]: (1 + E)^(degree - k) b
    W differences[kMostOrder];
    for (std::size_t i = 0; i <= k; ++i) {
      differences[i] = sums[i];
    }
    for (std::size_t left = k; left > 0; --left) {
      for (std::size_t i = 0; i < left; ++i) {
        differences[i] = difference_of<W>(differences[i + 1], differences[i]);
      }
    }
    values[k * step] = product(differences[0], Wide(kCentring.at[degree][k]));
    for (std::size_t i = 0; i < k; ++i) {
      sums[i] = sum_of<W>(sums[i], sums[i + 1]);
    }
  }
}

/// Replaces control values values[i * step], 0 <= i <= degree, by the half-centred power
/// coefficients of the polynomial.
template <typename W>
void centre(W* values, std::size_t step, std::size_t degree) {
  switch (degree) {
  case 1:
    return centre_by_pyramid(values, step, 1);
  case 2:
    return centre_by_pyramid(values, step, 2);
  case 3: {
    W c[detail::kOrder];
    centred_cubic<W>(values[0], values[step], values[2 * step], values[3 * step], c);
    for (std::size_t k = 0; k < detail::kOrder; ++k) {
      values[k * step] = c[k];
    }
    return;
  }
  default:
    return centre_by_pyramid(values, step, degree);
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
