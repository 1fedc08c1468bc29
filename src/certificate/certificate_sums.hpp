// Running-error sums of packed polynomials, which certificates are made of. All in double.
#pragma once

#include <cmath>
#include <cstddef>

#include "src/certificate/direction_roundings.hpp"

namespace simdbezier::detail {

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
