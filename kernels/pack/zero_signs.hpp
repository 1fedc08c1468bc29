// The sign of zero on edges and curves of degree 3 to 5, whose even part E(X^2) and odd part
// X O(X^2) are evaluated apart and then added. Where O vanishes and E is rounded to -0, both sides
// of an edge may get zeros of different signs. If that would happen at all small X, the constant is
// packed as the smallest negative denormal, for all instruction sets: docs/accuracy.md, "Zeros on
// edges that underflow".
#pragma once

#include <limits>

#include "kernels/pack/double_double.hpp"
#include "kernels/simd/extrema.hpp"
#include "src/storage/bicubic_layout.hpp"
#include "src/storage/even_odd_rule.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// From this size on, c2 X^2 (c4 X^4) stays above the denormals for all X but 0 that come from
/// parameters u of type T, or from uniform grids of up to 2^24 (2^53) intervals: |X| >= 2^-25 for
/// float and 2^-54 for double.
template <typename T>
inline constexpr double kSafeSecond = sizeof(T) == sizeof(float) ? 0x1p-98 : 0x1p-958;
template <typename T>
inline constexpr double kSafeFourth = sizeof(T) == sizeof(float) ? 0x1p-48 : 0x1p-850;

/// Returns the degree of an edge.
constexpr int degree_along(const detail::NetShape& shape, std::size_t edge) {
  return edge == detail::kEdgeV0 || edge == detail::kEdgeV1 ? shape.degree_u : shape.degree_v;
}

/// Which lanes of a group have even coefficients that need a second look.
template <typename T>
class TinyEvenCoefficients {
public:
  /// Looks at the even coefficients of the edges of one channel, [power][edge], before they are
  /// rounded.
  template <typename W>
  SIMDBEZIER_INLINE void look_at_edges(const detail::NetShape& shape, const W* edges) {
    for (std::size_t e = 0; e < detail::kEdges; ++e) {
      const int degree = degree_along(shape, e);
      if (detail::is_even_odd(degree)) {
        compare(to_wide(edges[2 * detail::kEdges + e]), kSafeSecond<T>);
        if (degree > 3) {
          compare(to_wide(edges[4 * detail::kEdges + e]), kSafeFourth<T>);
        }
      }
    }
  }
  [[nodiscard]] SIMDBEZIER_INLINE bool any() const { return any_of<Wide>(least_ < Wide(0.0)); }

private:
  /// Whether -safe < c < 0, in as few operations as there are for it.
  SIMDBEZIER_INLINE void compare(Wide c, double safe) {
    // c (c + safe) is negative; the factor keeps what is not zero in T from becoming zero
    const Wide from_safe = c + Wide(safe);
    const Wide size = sizeof(T) == sizeof(float) ? c : c * Wide(0x1p1000);
    least_ = smaller_of<Wide>(size * from_safe, least_);
  }

  Wide least_ = Wide(0.0);
};

/// Changes the constant of one edge or curve where it has to be. Its packed coefficients are c[k *
/// step], 0 <= k <= degree.
template <typename T>
SIMDBEZIER_INLINE void keep_even_part_from_zero(T* c, std::size_t step, int degree) {
  if (!detail::is_even_odd(degree) || c[0] != T(0)) {
    return;
  }
  const bool fourth = degree > 3 && c[2 * step] == T(0);
  const T first = c[(fourth ? 4 : 2) * step]; // the one that decides where X is small
  const T safe = static_cast<T>(fourth ? kSafeFourth<T> : kSafeSecond<T>);
  if (first < T(0) && first > -safe) {
    c[0] = -std::numeric_limits<T>::denorm_min();
  }
}

/// Keeps the four edges of every channel of one cell from zero, in the blocks of `count` patches.
template <typename T>
SIMDBEZIER_RARE void keep_edges_from_zero(const detail::NetShape& shape, T* blocks,
                                          std::size_t count) {
  for (std::size_t p = 0; p < count; ++p, blocks += shape.cells() * shape.cell_edges()) {
    for (std::size_t c = 0; c < shape.channels(); ++c) {
      for (std::size_t e = 0; e < detail::kEdges; ++e) {
        keep_even_part_from_zero(blocks + c * shape.edge_powers() * detail::kEdges + e,
                                 detail::kEdges, degree_along(shape, e));
      }
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
