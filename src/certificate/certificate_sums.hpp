// Running-error sums of packed polynomials, which certificates are made of. All in double.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

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
  /// The sum of |coefficient| by the same factors: sums on the way to a value or derivative are no
  /// larger.
  double way = 0;
  double way_u = 0;
  double way_v = 0;

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
        way += c;
        way_u += static_cast<double>(k) * c;
        way_v += static_cast<double>(l) * c;
      }
    }
  }
};

/// The error of packed coefficients, for all terms of a polynomial together: they are sums of up to
/// 2^degrees control values, at most `largest`, in double where T is float and else in
/// double-double, rounded at each of about 2 degrees levels. Only products and halvings are inexact
/// there. Derivatives have at most 2 n times as much, and second ones 4 n (n - 1) times.
template <typename T>
double carried_error(int degrees, double largest) {
  constexpr double kUnit = sizeof(T) == sizeof(float) ? 0x1p-53 : 0x1p-104;
  return std::ldexp(kUnit * (2 * degrees + 4) * largest, degrees) +
         std::ldexp(std::numeric_limits<double>::denorm_min(), degrees + 6);
}

/// The bound, or infinity where a sum on the way, at most `way`, might leave T's range.
template <typename T>
double unless_overflow(double bound, double way) {
  constexpr double kMost =
      static_cast<double>(std::numeric_limits<T>::max()) / 8; // halves scale by 4
  return way < kMost ? bound : std::numeric_limits<double>::infinity();
}

} // namespace simdbezier::detail
