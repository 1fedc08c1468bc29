// What certificates are made of: how often the term of each power is rounded, by direction (the
// proof is in docs/accuracy.md), running-error sums of packed polynomials, and what is asked of the
// control points as they were given. All in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <simdbezier/options.hpp>

#include "src/runtime/fp_environment.hpp"
#include "src/storage/even_odd_rule.hpp"
#include "src/storage/given_points.hpp"
#include "src/storage/net_shape.hpp"
#include "src/storage/one_point.hpp"

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
  /// What |coefficient| is multiplied by in TermSums::value.
  [[nodiscard]] const double* weights() const { return weight_; }

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

/// What error_bounds() returns: what find(fuses, bounds) writes for a member of the set.
template <typename Bounds, typename Set, typename Find>
Bounds find_bounds(const Set& set, std::size_t member, Isa isa, const Find& find) noexcept {
  Bounds bounds;
  Isa chosen = Isa::automatic;
  if (resolve_isa(isa, chosen) != Status::ok) {
    auto& [position, first, second] = bounds;
    for (double* const of : {position, first, second}) {
      std::fill_n(of, kMostComponents, std::numeric_limits<double>::infinity());
    }
  } else if (member < set.size()) {
    const DefaultFpEnvironment environment;
    find(fuses_multiply_add(chosen), bounds);
  }
  return bounds;
}

/// Some control points, `step` of them apart.
struct PointRun {
  std::size_t first;
  std::size_t step;
  std::size_t count;
};

struct ControlValues {
  GivenNet net;
  std::size_t points;
  std::size_t channels; ///< of a point; the last one is the weight where it is rational
  bool rational;

  /// A point's coordinate, or its weight.
  [[nodiscard]] double value(std::size_t point, std::size_t channel) const {
    return rational && channel + 1 == channels ? net.value(point * channels + channel)
                                               : net.coordinate(point, channels, channel);
  }
  /// Largest |value| of a channel.
  [[nodiscard]] double largest(std::size_t channel) const {
    double most = 0;
    for (std::size_t k = 0; k < points; ++k) {
      most = std::max(most, std::fabs(value(k, channel)));
    }
    return most;
  }
  [[nodiscard]] double least_weight() const {
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < points; ++k) {
      least = std::min(least, value(k, channels - 1));
    }
    return least;
  }
  /// Bounds the distance from a number in one component, with `unit` of roundoff: all samples are
  /// in the hull of the control points.
  [[nodiscard]] double reach_from(double around, std::size_t component, double unit) const {
    double reach = 0;
    for (std::size_t k = 0; k < points; ++k) {
      const double point = value(k, component);
      reach = std::max(reach, std::fabs(point - around) + 8 * unit * std::fabs(point));
    }
    return reach;
  }
  /// How far apart the coordinates of homogeneous points are that count as one although they differ
  /// by roundings, quotients' roundings included; 0 where they are not one.
  [[nodiscard]] double merged_distance(const PointRun& run, std::size_t component) const {
    const GivenPoints& all = *net.all;
    if (all.weights != Weights::homogeneous ||
        !(all.in_double ? are_one<double>(run) : are_one<float>(run))) {
      return 0;
    }
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (std::size_t k = 0; k < run.count; ++k) {
      const double x = value(run.first + k * run.step, component);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    const double origin = component < 3 ? std::fabs(all.relative_to[component]) : 0;
    return high - low + 0x1p-51 * (std::max(-low, high) + origin) +
           4 * std::numeric_limits<double>::denorm_min();
  }

private:
  template <typename S>
  [[nodiscard]] bool are_one(const PointRun& run) const {
    return are_one_point(static_cast<const S*>(net.values) + run.first * channels,
                         static_cast<std::ptrdiff_t>(run.step * channels), run.count, channels - 1,
                         1, net.all->weights);
  }
};

} // namespace simdbezier::detail
