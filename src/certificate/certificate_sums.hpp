// Running-error sums of packed polynomials, which certificates are made of. All in double.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "src/certificate/direction_roundings.hpp"
#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {

/// What the terms of a polynomial are multiplied by in the sums below, which depends on its degrees
/// and not on its coefficients.
class TermFactors {
public:
  TermFactors(const DirectionRoundings& u, const DirectionRoundings& v)
      : order_u_(u.order), order_v_(v.order) {
    for (std::size_t k = 0; k < order_u_; ++k) {
      for (std::size_t l = 0; l < order_v_; ++l) {
        const std::size_t term = k * order_v_ + l;
        scale_[term] = std::ldexp(1.0, -static_cast<int>(k + l));
        value_[term] = u.value(k) + v.value(l) + 1;
        du_[term] = u.slope(k) + v.value(l) + 1;
        dv_[term] = u.value(k) + v.slope(l) + 1;
        weight_[term] = value_[term] * scale_[term];
      }
    }
  }

  [[nodiscard]] std::size_t terms() const { return order_u_ * order_v_; }
  /// Sets to[term] to what each coefficient c adds to TermSums::value.
  template <typename T>
  void weigh(const T* c, std::size_t count, double* to) const {
    for (std::size_t term = 0; term < count; ++term) {
      to[term] = weight_[term] * std::fabs(static_cast<double>(c[term]));
    }
  }

private:
  friend struct TermSums;
  std::size_t order_u_;
  std::size_t order_v_;
  // Of all terms, [power k of X][power l of Y]:
  double scale_[kMostOrder * kMostOrder]; ///< 2^-(k+l)
  double value_[kMostOrder * kMostOrder]; ///< roundings of a term, and one of its coefficient
  double du_[kMostOrder * kMostOrder];
  double dv_[kMostOrder * kMostOrder];
  double weight_[kMostOrder * kMostOrder]; ///< scale_ * value_, which is exact
};

/// Sums over the terms of a polynomial at |X| = |Y| = 1/2, where they are largest.
struct TermSums {
  double constant = 0; ///< the coefficient of power 0
  double size = 0;     ///< of |term|
  double value = 0;    ///< of (roundings + 1) |term|; the one is the coefficient's own
  /// The sum of |coefficient| by the same factors: sums on the way to a value or derivative are no
  /// larger.
  double way = 0;

  // Likewise of the derivatives; 0 where they are not asked for.
  double size_u = 0;
  double size_v = 0;
  double du = 0;
  double dv = 0;
  double way_u = 0;
  double way_v = 0;

  /// Terms C_kl 2^-(k+l), and for derivatives k C_kl 2^-(k+l-1). at(k, l): the coefficient.
  template <typename At>
  TermSums(const TermFactors& factors, bool derivatives, const At& at)
      : constant(static_cast<double>(at(0, 0))) {
    std::size_t k_l = 0;
    for (std::size_t k = 0; k < factors.order_u_; ++k) {
      for (std::size_t l = 0; l < factors.order_v_; ++l, ++k_l) {
        const double c = std::fabs(static_cast<double>(at(k, l)));
        const double term = c * factors.scale_[k_l];
        size += term;
        value += factors.value_[k_l] * term;
        way += c;
        if (derivatives) {
          const double term_u = 2 * static_cast<double>(k) * term;
          const double term_v = 2 * static_cast<double>(l) * term;
          size_u += term_u;
          size_v += term_v;
          du += factors.du_[k_l] * term_u;
          dv += factors.dv_[k_l] * term_v;
          way_u += static_cast<double>(k) * c;
          way_v += static_cast<double>(l) * c;
        }
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
