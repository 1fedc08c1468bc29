// Columns of a bicubic component: their cubics in Y, by Horner's rule in X.
#pragma once

#include <type_traits>

#include "kernels/poly/even_odd.hpp"
#include "kernels/simd/quads.hpp"
#include "kernels/simd/register_pair.hpp"
#include "kernels/simd/repeat.hpp"
#include "src/storage/bicubic_layout.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::kEdges;
using detail::kOrder;

/// Returns c[0] + t c[1] + t^2 c[2] + t^3 c[3], for columns.
template <typename V>
SIMDBEZIER_INLINE V horner(const V c[kOrder], V t) {
  return madd(madd(madd(c[3], t, c[2]), t, c[1]), t, c[0]);
}

/// Returns the same value, bit for bit, and finds its derivative.
template <typename V>
SIMDBEZIER_INLINE V horner(const V c[kOrder], V t, V& derivative) {
  const V b1 = madd(c[3], t, c[2]);
  const V b0 = madd(b1, t, c[1]);
  derivative = madd(madd(c[3], t, b1), t, b0);
  return madd(b0, t, c[0]);
}

/// Returns the derivative alone.
template <typename V>
SIMDBEZIER_INLINE V horner_slope(const V c[kOrder], V t) {
  V slope;
  horner(c, t, slope);
  return slope;
}

/// Returns the second derivative: two more synthetic divisions, and a factor 2 that rounds nothing.
template <typename V>
SIMDBEZIER_INLINE V horner_second(const V c[kOrder], V t) {
  const V b1 = madd(c[3], t, c[2]);
  const V half = madd(c[3], t, madd(c[3], t, b1));
  return half + half;
}

/// Whether whole registers of columns are evaluated column by column, all powers of Y side by side,
/// and the cubics turned. SSE2 needs two instructions to bring a coefficient to all lanes, and six
/// for each power of a column on an edge; turning takes two a power, and such a column is another
/// register. In WebAssembly, positions gain by it, which are pairs of registers, and nothing else.
template <typename V>
constexpr bool kTurnsColumns = kSse2&& kLanes<V> > (kSimd128 ? kLanes<vec<ScalarOf<V>>> : 1);

/// Such columns, of one register or two. Usually only the first one lies on the edge u = 0, and
/// only the last one on u = 1.
template <typename V>
struct TurnedColumns {
  using T = ScalarOf<V>;
  using Register = vec<T>;
  static constexpr std::size_t kL = kLanes<Register>;

  Register x[kLanes<V>]; ///< each in all lanes
  RowPoint<V> along;     ///< as parameters of the edges v = const
  bool first;            ///< the first column is on u = 0
  bool last;             ///< the last one is on u = 1
  bool others;           ///< there is a column on an edge besides

  SIMDBEZIER_INLINE TurnedColumns(V columns, bool watertight) : along(columns) {
    if constexpr (kLanes<V> == kL) {
      split_groups<kL>(columns, x);
    } else {
      split_groups<kL>(columns.low, x);
      split_groups<kL>(columns.high, x + kL);
    }
    constexpr unsigned kLast = 1U << (kLanes<V> - 1);
    const unsigned at_0 = watertight ? lane_bits(columns == broadcast<V>(T(-0.5))) : 0;
    const unsigned at_1 = watertight ? lane_bits(columns == broadcast<V>(T(0.5))) : 0;
    first = (at_0 & 1) != 0;
    last = (at_1 & kLast) != 0;
    others = (at_0 & ~1U) != 0 || (at_1 & ~kLast) != 0;
  }

  /// Finds the cubics in Y, with those of edges u = const where only the first and the last column
  /// are on them, and their derivatives by u.
  template <bool kSlopes>
  SIMDBEZIER_INLINE void polynomials(const T* matrix, const T* edge, V q[kOrder],
                                     V dq[kOrder]) const {
    if constexpr (kLanes<V> == kL) {
      register_polynomials<kSlopes>(matrix, edge, x, first, last, q, dq);
    } else {
      Register low[kOrder];
      Register low_slopes[kOrder];
      Register high[kOrder];
      Register high_slopes[kOrder];
      register_polynomials<kSlopes>(matrix, edge, x, first, false, low, low_slopes);
      register_polynomials<kSlopes>(matrix, edge, x + kL, false, last, high, high_slopes);
      for (std::size_t l = 0; l < kOrder; ++l) {
        q[l] = {low[l], high[l]};
        if constexpr (kSlopes) {
          dq[l] = {low_slopes[l], high_slopes[l]};
        }
      }
    }
  }

  SIMDBEZIER_INLINE V replace(V inside, const T* pair) const {
    if (first) [[likely]] {
      inside = with_lane<0>(inside, pair);
    }
    if (last) [[likely]] {
      inside = with_lane<kLanes<V> - 1>(inside, pair + 1);
    }
    return inside;
  }

private:
  template <bool kSlopes>
  static SIMDBEZIER_INLINE void
  register_polynomials(const T* matrix, const T* edge, const Register columns[kL], bool at_first,
                       bool at_last, Register q[kOrder], Register dq[kOrder]) {
    for (std::size_t power = 0; power < kOrder; power += kL) {
      Register k[kOrder];
      for (std::size_t i = 0; i < kOrder; ++i) {
        k[i] = load_vector<Register>(matrix + i * kOrder + power);
      }
      for (std::size_t i = 0; i < kL; ++i) {
        if constexpr (kSlopes) {
          q[power + i] = horner(k, columns[i], dq[power + i]);
        } else {
          q[power + i] = horner(k, columns[i]);
        }
      }
      if (at_first) [[likely]] {
        q[power] = edge_powers<detail::kEdgeU0>(edge + power * kEdges);
      }
      if (at_last) [[likely]] {
        q[power + kL - 1] = edge_powers<detail::kEdgeU1>(edge + power * kEdges);
      }
      lane_transpose<Register>(q + power);
      if constexpr (kSlopes) {
        lane_transpose<Register>(dq + power);
      }
    }
  }

  /// Returns an edge's coefficients of kL powers, which lie in memory power by power.
  template <detail::Edge kEdge>
  static SIMDBEZIER_INLINE Register edge_powers(const T* edges) {
    if constexpr (kSimd128) { // whose loads of single lanes are fewer instructions
      return from_lanes<Register>(
          [=](std::size_t i) SIMDBEZIER_INLINE_LAMBDA { return edges[i * kEdges + kEdge]; });
    }
    Register of[kL];
    for (std::size_t i = 0; i < kL; ++i) {
      of[i] = load_vector<Register>(edges + i * kEdges + (kEdges - kL));
    }
    lane_transpose<Register>(of);
    return of[kEdge - (kEdges - kL)];
  }
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
