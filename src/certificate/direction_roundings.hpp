// How often the term of each power is rounded in the evaluation of one direction: certificates
// multiply terms by these counts, whose proof is in docs/accuracy.md.
#pragma once

#include <algorithm>
#include <cstddef>

#include "src/storage/even_odd_rule.hpp"

namespace simdbezier::detail {

/// The counts of even and odd parts, rounded up where roundings reach only a part of a term:
/// [with or without fused operations][order of the derivative][degree - 3][power].
inline constexpr unsigned char kEvenOddRoundings[2][3][3][6] = {
    {{{2, 3, 4, 5}, {2, 3, 5, 5, 7}, {2, 3, 5, 6, 7, 8}},
     {{0, 3, 2, 5}, {0, 3, 4, 5, 6}, {0, 3, 4, 6, 6, 8}},
     {{0, 0, 1, 3}, {0, 0, 4, 3, 5}, {0, 0, 4, 6, 5, 7}}},
    {{{2, 3, 3, 4}, {2, 3, 4, 4, 5}, {2, 3, 4, 5, 5, 6}},
     {{0, 3, 2, 4}, {0, 3, 4, 4, 5}, {0, 3, 4, 5, 5, 6}},
     {{0, 0, 1, 3}, {0, 0, 4, 3, 4}, {0, 0, 4, 6, 4, 6}}}};

/// One direction of a polynomial.
struct DirectionRoundings {
  std::size_t order = 1;
  bool halved = false; ///< there are two cells, whose parameter is rounded, too
  bool fused = true;   ///< a multiply-add rounds once
  bool column = false; ///< evaluated first, which is Horner's rule at any degree

  [[nodiscard]] constexpr double value(std::size_t k) const { return derivative(0, k); }
  [[nodiscard]] constexpr double slope(std::size_t k) const { return derivative(1, k); }

  /// The count of the term k (k - 1) … c_k t^(k - taken); 0 where it vanishes in the derivative.
  [[nodiscard]] constexpr double derivative(std::size_t taken, std::size_t k) const {
    if (k < taken) {
      return 0;
    }
    const auto degree = static_cast<int>(order) - 1;
    if (!column && is_even_odd(degree)) {
      return kEvenOddRoundings[fused ? 1 : 0][taken][degree - kLeastEvenOddDegree][k];
    }
    // Horner's rule and every synthetic division: the power k enters at step k of order - 1, the
    // last one with the first product.
    return (fused ? 1.0 : 2.0) * static_cast<double>(std::min(k + 1, order - 1)) +
           (halved ? static_cast<double>(k - taken) : 0);
  }
};

} // namespace simdbezier::detail
