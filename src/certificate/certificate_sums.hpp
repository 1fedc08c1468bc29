// Running-error sums of packed polynomials, which certificates are made of. All in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace simdbezier::detail {

/// One direction of a polynomial: how often the term of a power is rounded on its way through the
/// evaluation.
struct DirectionRoundings {
  std::size_t order = 1;
  bool halved = false; ///< there are two cells, whose parameter is rounded, too
  double per_step = 1; ///< roundings in a multiply-add

  /// Horner's rule: the power k enters at step k of order - 1, the last one with the first product.
  [[nodiscard]] double value(std::size_t k) const {
    return per_step * static_cast<double>(std::min(k + 1, order - 1)) +
           (halved ? static_cast<double>(k) : 0);
  }
  /// Its synthetic division, of which the constant is no part.
  [[nodiscard]] double slope(std::size_t k) const {
    return k == 0 ? 0
                  : per_step * static_cast<double>(std::min(k + 1, order - 1)) +
                        (halved ? static_cast<double>(k - 1) : 0);
  }
};

/// Sums over the terms of a polynomial at |X| = |Y| = 1/2, where they are largest.
struct TermSums {
  double constant = 0; ///< the coefficient of power 0
  double size = 0;     ///< of |term|
  double size_u = 0;
  double size_v = 0;
  double value = 0; ///< of (roundings + 1) |term|; the one is the coefficient's own
  double du = 0;
  double dv = 0;

  /// Terms C_kl 2^-(k+l), and for derivatives k C_kl 2^-(k+l-1). at(k, l): the coefficient.
  template <typename At>
  TermSums(const DirectionRoundings& u, const DirectionRoundings& v, const At& at)
      : constant(static_cast<double>(at(0, 0))) {
    for (std::size_t k = 0; k < u.order; ++k) {
      for (std::size_t l = 0; l < v.order; ++l) {
        const double c = std::fabs(static_cast<double>(at(k, l)));
        const double term = std::ldexp(c, -static_cast<int>(k + l));
        const double term_u = 2 * static_cast<double>(k) * term;
        const double term_v = 2 * static_cast<double>(l) * term;
        size += term;
        size_u += term_u;
        size_v += term_v;
        value += (u.value(k) + v.value(l) + 1) * term;
        du += (u.slope(k) + v.value(l) + 1) * term_u;
        dv += (u.value(k) + v.slope(l) + 1) * term_v;
      }
    }
  }
};

} // namespace simdbezier::detail
