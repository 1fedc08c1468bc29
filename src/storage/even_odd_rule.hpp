// Which polynomials of one variable are evaluated by their even and odd parts.
//
// A patch's rows (its last direction), its edges, and curves are such polynomials; columns, which
// are evaluated first, take Horner's rule at every degree. The rule has to be one of the degree
// alone: an edge does not know what lies on its other side, and both sides must round alike.
#pragma once

namespace simdbezier::detail {

/// Below degree 3 there is nothing to share between the parameters y and -y of a pair of rows;
/// above degree 5 a direction has two halves, each with parameters of its own, and no pairs.
inline constexpr int kLeastEvenOddDegree = 3;
inline constexpr int kMostEvenOddDegree = 5;

[[nodiscard]] constexpr bool is_even_odd(int degree) {
  return degree >= kLeastEvenOddDegree && degree <= kMostEvenOddDegree;
}

} // namespace simdbezier::detail
