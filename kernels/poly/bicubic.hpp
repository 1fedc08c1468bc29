// The formulas of one bicubic component, over V = one register of samples or one sample.
//
// The bits of every result depend on this order of operations:
//   q_l(X) = Horner in X over C[.][l]           once per column: 3 madd, 5 with the derivative
//   S(X,Y) = even and odd part in Y of q_l(X)   once per pair of rows: poly/even_odd.hpp
// Derivatives reuse the intermediates of either. Where X (Y) is exactly -1/2 or 1/2 the edge's own
// cubic takes the place of the column (row).
#pragma once

#include "kernels/poly/columns.hpp"
#include "kernels/simd/quads.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// One column position X, or a register of them, and which lanes lie on the edges u = 0 and u = 1.
template <typename V, bool kTurns = false>
struct Column {
  V x;
  PairSelector<V> edges;
  bool on_edge; ///< false: no lane is on an edge u = const
  std::conditional_t<kTurns, TurnedColumns<V>, Nothing> turned;

  /// Where patches are not watertight, edges are as good as any column.
  SIMDBEZIER_INLINE Column(V half_centred, bool watertight)
      : x(half_centred),
        edges(x == broadcast<V>(ScalarOf<V>(-0.5)), x == broadcast<V>(ScalarOf<V>(0.5))),
        on_edge(watertight && edges.worthwhile()), turned(half_centred, watertight) {}

  /// Replaces the lanes that lie on edges; of a few values, for there are faster ways for many.
  SIMDBEZIER_INLINE V replace(V inside, const ScalarOf<V>* pair) const {
    if constexpr (kTurns) {
      if (!turned.others) [[likely]] {
        return turned.replace(inside, pair);
      }
    }
    return edges.replace(inside, pair);
  }
  /// Returns the columns as parameters of the edges v = const.
  SIMDBEZIER_INLINE RowPoint<V> along() const {
    if constexpr (kTurns) {
      return turned.along;
    } else {
      return RowPoint<V>(x);
    }
  }
};

/// The coefficients of one component of one patch.
template <typename T>
struct Component {
  const T* matrix;       ///< [k][l]
  const T* edge;         ///< [power][edge]
  const T* corner;       ///< [corner]
  const T* origins;      ///< of the set; null where it has none
  std::size_t origin_at; ///< of this component in there

  /// task is any that holds coefficients, edges and origins.
  template <typename Task>
  SIMDBEZIER_INLINE Component(const Task& task, std::size_t patch, std::size_t component)
      : matrix(own_address(task.coefficients + patch * detail::kCoefficients +
                           component * kOrder * kOrder)),
        edge(own_address(task.edges + patch * detail::kEdgeBlock + component * kOrder * kEdges)),
        corner(own_address(task.edges + patch * detail::kEdgeBlock + detail::kCornersAt +
                           component * kEdges)),
        origins(task.origins),
        origin_at(patch * detail::kOriginBlock + component * detail::kOriginsPerComponent) {}

  /// Returns the patch's next component, at constant distances: addresses made anew take registers.
  [[nodiscard]] SIMDBEZIER_INLINE Component next() const {
    Component after = *this;
    after.matrix += kOrder * kOrder;
    after.edge += kOrder * kEdges;
    after.corner += kEdges;
    after.origin_at += detail::kOriginsPerComponent;
    return after;
  }

  /// Returns the origins of the patch and, from kEdgeOriginsAt on, of its edges; for sets with
  /// origins.
  SIMDBEZIER_INLINE const T* origin() const { return origins + origin_at; }
};

/// A column on an edge u = const is the polynomial of that edge.
template <typename V, bool kTurns>
SIMDBEZIER_INLINE void replace_edge_columns(const Component<ScalarOf<V>>& c,
                                            const Column<V, kTurns>& column, V q[kOrder]) {
  if (column.on_edge) [[likely]] {
    for (std::size_t l = 0; l < kOrder; ++l) {
      q[l] = column.edges.replace(q[l], c.edge + l * kEdges + detail::kEdgeU0);
    }
  }
}

template <typename V>
SIMDBEZIER_INLINE void matrix_column(const Component<ScalarOf<V>>& c, std::size_t l, V k[kOrder]) {
  for (std::size_t i = 0; i < kOrder; ++i) {
    k[i] = broadcast<V>(c.matrix[i * kOrder + l]);
  }
}

template <typename V, bool kTurns>
SIMDBEZIER_INLINE void column_polynomial(const Component<ScalarOf<V>>& c,
                                         const Column<V, kTurns>& column, V q[kOrder]) {
  if constexpr (kTurns) {
    column.turned.template polynomials<false>(c.matrix, c.edge, q, q);
    if (!column.turned.others) [[likely]] {
      return;
    }
  } else {
    for (std::size_t l = 0; l < kOrder; ++l) {
      V k[kOrder];
      matrix_column(c, l, k);
      q[l] = horner(k, column.x);
    }
  }
  replace_edge_columns(c, column, q);
}

/// The polynomials in Y that a column is: q, and dq of the u derivative, which on an edge u = const
/// still comes from the patch, because the edge's control points do not determine it.
template <typename V, bool kTurns>
SIMDBEZIER_INLINE void column_polynomial(const Component<ScalarOf<V>>& c,
                                         const Column<V, kTurns>& column, V q[kOrder],
                                         V dq[kOrder]) {
  if constexpr (kTurns) {
    column.turned.template polynomials<true>(c.matrix, c.edge, q, dq);
    if (!column.turned.others) [[likely]] {
      return;
    }
  } else {
    for (std::size_t l = 0; l < kOrder; ++l) {
      V k[kOrder];
      matrix_column(c, l, k);
      q[l] = horner(k, column.x, dq[l]);
    }
  }
  replace_edge_columns(c, column, q);
}

/// This is column_polynomial() for a single column, which all lanes share: it computes all four
/// powers of Y at once, for a quarter of the operations.
template <typename V, bool kTurns>
SIMDBEZIER_INLINE void single_column_polynomial(const Component<ScalarOf<V>>& c,
                                                const Column<V, kTurns>& column, V q[kOrder]) {
  V k[kOrder];
  load_fours(c.matrix, k);
  split_groups<4>(horner(k, column.x), q);
  replace_edge_columns(c, column, q);
}

template <typename V, bool kTurns>
SIMDBEZIER_INLINE void single_column_polynomial(const Component<ScalarOf<V>>& c,
                                                const Column<V, kTurns>& column, V q[kOrder],
                                                V dq[kOrder]) {
  V k[kOrder];
  load_fours(c.matrix, k);
  V slopes;
  split_groups<4>(horner(k, column.x, slopes), q);
  split_groups<4>(slopes, dq);
  replace_edge_columns(c, column, q);
}

/// What second derivatives are made of: q as above, dq and ddq of the patch.
template <typename V>
struct SecondColumns {
  V q[kOrder];
  V dq[kOrder];
  V ddq[kOrder];

  template <bool kTurns>
  SIMDBEZIER_INLINE void build(const Component<ScalarOf<V>>& c, const Column<V, kTurns>& column) {
    for (std::size_t l = 0; l < kOrder; ++l) {
      V k[kOrder];
      matrix_column(c, l, k);
      q[l] = horner(k, column.x, dq[l]);
      ddq[l] = horner_second(k, column.x);
    }
    replace_edge_columns(c, column, q);
  }

  /// These are for samples away from the edges v = 0 and 1, where duu comes from the edge.
  SIMDBEZIER_INLINE Parts<V> duu_parts(const RowPoint<V>& at) const { return value_parts(ddq, at); }
  SIMDBEZIER_INLINE Parts<V> duv_parts(const RowPoint<V>& at) const { return slope_parts(dq, at); }
  /// Returns the parts of half of dvv, which is doubled last.
  SIMDBEZIER_INLINE Parts<V> half_dvv_parts(const RowPoint<V>& at) const {
    return half_second_parts(q, at);
  }
  SIMDBEZIER_INLINE V duu(const RowPoint<V>& at) const { return duu_parts(at).sum(); }
  SIMDBEZIER_INLINE V duv(const RowPoint<V>& at) const { return duv_parts(at).sum(); }
  SIMDBEZIER_INLINE V dvv(const RowPoint<V>& at) const { return row_second(q, at); }
};

/// What positions are relative to, in sets with origins. It is added last, so that far away only
/// this addition rounds at the size of the result. The set is asked at run time: a branch that
/// always goes the same way costs nothing beside the arithmetic, kernels of their own cost code.
template <typename V>
struct LocalOrigin {
  bool exists;
  V value;

  SIMDBEZIER_INLINE V add_to(V p) const {
    if (exists) [[unlikely]] {
      p = p + value;
    }
    return p;
  }
};

/// Returns the origin of a column. One on an edge u = const has that edge's origin.
template <typename V, bool kTurns>
SIMDBEZIER_INLINE LocalOrigin<V> column_origin(const Component<ScalarOf<V>>& c,
                                               const Column<V, kTurns>& column) {
  LocalOrigin<V> origin{c.origins != nullptr, column.x};
  if (origin.exists) [[unlikely]] {
    constexpr std::size_t kAt = detail::kEdgeOriginsAt + detail::kEdgeU0;
    const V inside = broadcast<V>(c.origin()[0]);
    origin.value = column.on_edge ? column.edges.replace(inside, c.origin() + kAt) : inside;
  }
  return origin;
}

template <typename V>
SIMDBEZIER_INLINE void edge_cubic(const Component<ScalarOf<V>>& c, std::size_t edge, V k[kOrder]) {
  const ScalarOf<V>* const from = own_address(c.edge + edge);
  for (std::size_t i = 0; i < kOrder; ++i) {
    k[i] = broadcast<V>(from[i * kEdges]);
  }
}

/// Finds N = du x dv and returns |N|^2.
template <typename V>
SIMDBEZIER_INLINE V cross_product(const V du[3], const V dv[3], V n[3]) {
  n[0] = msub(du[1], dv[2], du[2] * dv[1]);
  n[1] = msub(du[2], dv[0], du[0] * dv[2]);
  n[2] = msub(du[0], dv[1], du[1] * dv[0]);
  return madd(n[0], n[0], madd(n[1], n[1], n[2] * n[2]));
}

/// Gives n unit length. The IEEE square root and division are reproducible, unlike the reciprocal
/// estimates, and hidden behind the other arithmetic.
template <typename V>
SIMDBEZIER_INLINE void normalise(V n[3], V squared_length) {
  const V inverse = divide(broadcast<V>(ScalarOf<V>(1)), square_root(squared_length));
  for (int c = 0; c < 3; ++c) {
    n[c] = n[c] * inverse;
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
