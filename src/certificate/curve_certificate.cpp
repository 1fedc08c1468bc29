// See bounds.hpp. Computed from the packed values on demand: they are all it depends on.
#include <algorithm>
#include <cmath>
#include <limits>

#include <simdbezier/bounds.hpp>

#include "src/certificate/certificate_sums.hpp"
#include "src/certificate/position_bounds.hpp"
#include "src/storage/curve_storage.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// A quantity by derivative: 0, 1, 2.
struct ByOrder {
  double at[3] = {0, 0, 0};
};

/// What is known of one polynomial on a cell, by the cell's parameter.
struct PolynomialBounds {
  ByOrder size;  ///< of the values
  ByOrder error; ///< of the computed ones
  ByOrder way;   ///< sums on the way to a value are no larger
};

template <typename T>
class CurveCertificate {
public:
  /// derivatives: the highest whose bounds are wanted.
  CurveCertificate(const CurveStorage<T>& storage, bool fused, std::size_t derivatives)
      : storage_(storage), shape_(storage.shape),
        values_(storage.values), control_{storage.given.net(0), shape_.order(), shape_.channels(),
                                          shape_.rational},
        derivatives_(derivatives), per_step_(fused ? 1 : 2) {
    const DirectionRoundings roundings{shape_.order(), shape_.cells() == 2, fused};
    for (std::size_t k = 0; k < shape_.order(); ++k) {
      scale_[k] = std::ldexp(1.0, -static_cast<int>(k));
      for (std::size_t d = 0; d < 3; ++d) {
        roundings_[k][d] = roundings.derivative(d, k);
      }
    }
  }

  /// Goes to one of the curves.
  void look_at(std::size_t curve) {
    values_ = storage_.values + curve * shape_.values();
    control_.net = storage_.given.net(curve * shape_.control_values());
  }

  /// Absolute errors of one component, by t.
  [[nodiscard]] ByOrder bounds(std::size_t component) const {
    ByOrder worst;
    for (std::size_t cell = 0; cell < shape_.cells(); ++cell) {
      const ByOrder here = shape_.rational ? quotient(cell, component) : plain(cell, component);
      double scale = 1;
      for (std::size_t d = 0; d < 3; ++d) {
        worst.at[d] = std::max(worst.at[d], scale * here.at[d]);
        scale *= static_cast<double>(shape_.cells());
      }
    }
    if (storage_.given.weights == Weights::homogeneous) {
      add_merged(component, worst);
    }
    return worst;
  }

private:
  static constexpr double kUnit = 1.01 * std::numeric_limits<T>::epsilon() / 2;
  static constexpr double kDenormals =
      64 * static_cast<double>(std::numeric_limits<T>::denorm_min());

  [[nodiscard]] const T* channel(std::size_t cell, std::size_t index) const {
    return values_ + cell * shape_.cell_values() + index * shape_.channel_values();
  }
  [[nodiscard]] double origin(std::size_t cell, std::size_t component) const {
    return shape_.origins ? static_cast<double>(channel(cell, component)[shape_.origin_at()]) : 0;
  }

  /// Term k of the d-th derivative is k!/(k-d)! a_k 2^-(k-d) at the cell's ends. It is rounded once
  /// as a coefficient, and on its way.
  [[nodiscard]] PolynomialBounds polynomial(std::size_t cell, std::size_t index) const {
    PolynomialBounds bounds;
    const T* const a = channel(cell, index);
    for (std::size_t k = 0; k < shape_.order(); ++k) {
      double way = std::fabs(static_cast<double>(a[k]));
      double term = way * scale_[k];
      for (std::size_t d = 0; d <= derivatives_ && d <= k; ++d) {
        bounds.size.at[d] += term;
        bounds.error.at[d] += kUnit * (roundings_[k][d] + 1) * term;
        bounds.way.at[d] += way;
        way *= static_cast<double>(k - d);
        term *= 2 * static_cast<double>(k - d);
      }
    }
    for (double& error : bounds.error.at) {
      error += kDenormals;
    }
    return bounds;
  }

  /// Adds what packing has rounded.
  void add_carried(double largest, PolynomialBounds& bounds) const {
    const int degree = static_cast<int>(shape_.order()) - 1;
    const double lost = carried_error<T>(degree, largest);
    bounds.error.at[0] += lost;
    bounds.error.at[1] += 2 * degree * lost;
    bounds.error.at[2] += 4 * degree * (degree - 1) * lost;
  }

  [[nodiscard]] ByOrder plain(std::size_t cell, std::size_t component) const {
    PolynomialBounds bounds = polynomial(cell, component);
    add_carried(control_.largest(component), bounds);
    if (shape_.origins) {
      const double o = std::fabs(origin(cell, component));
      bounds.error.at[0] += kUnit * (o + bounds.size.at[0]);
      bounds.way.at[0] += o;
    }
    for (std::size_t d = 0; d < 3; ++d) {
      bounds.error.at[d] = unless_overflow<T>(bounds.error.at[d], bounds.way.at[d]);
    }
    return bounds.error;
  }

  /// Adds what a curve that is a point up to roundings loses when it becomes that point: with its
  /// points up to a apart, weights in a ratio of R and degree n, |C'| <= n R a, as for patches, and
  /// w C'' = h'' - 2 C' w' - C w'' around one of the points is at most (8 + 2 R) n^2 R a w.
  void add_merged(std::size_t component, ByOrder& error) const {
    const double apart = 1.01 * control_.merged_distance({0, 1, shape_.order()}, component);
    const double ratio =
        control_.largest(static_cast<std::size_t>(shape_.components)) / control_.least_weight();
    const double slope = static_cast<double>(shape_.degree) * ratio;
    error.at[0] += apart;
    error.at[1] += slope * apart;
    error.at[2] += slope * (8 + 2 * ratio) * static_cast<double>(shape_.degree) * apart;
  }

  /// Errors of C = h/w and its derivatives w C^(d) = h^(d) - …, in the order of their computation:
  /// those of the operands, then the operations' own.
  [[nodiscard]] ByOrder quotient(std::size_t cell, std::size_t component) const {
    const auto weight = static_cast<std::size_t>(shape_.components);
    const double o = origin(cell, component);
    PolynomialBounds h = polynomial(cell, component);
    PolynomialBounds w = polynomial(cell, weight);
    const double most_weight = control_.largest(weight);
    add_carried((control_.largest(component) + std::fabs(o)) * most_weight, h);
    add_carried(most_weight, w);
    const double most = control_.reach_from(o, component, kUnit); // |C - O|
    const double divisor =
        control_.least_weight() - w.error.at[0]; // bounds all w that are computed
    if (!(divisor > 0)) {
      constexpr double kUnknown = std::numeric_limits<double>::infinity();
      return {{kUnknown, kUnknown, kUnknown}};
    }
    const double by_inverse = w.error.at[0] / divisor + 2 * kUnit;
    ByOrder error;
    const double position = 1.01 * (h.error.at[0] / divisor + most * by_inverse) + kDenormals;
    // Ends are points, which are quotients of homogeneous ones less the set's origin; where two
    // halves meet, what h and w gave by three roundings.
    const double end = (shape_.cells() == 2 ? 3 : 2) * kUnit * (std::fabs(o) + most);
    error.at[0] = std::max(position + kUnit * (std::fabs(o) + most), end);

    const double numerator = h.size.at[1] + most * w.size.at[1];
    const double first = numerator / divisor;
    error.at[1] = 1.01 * ((h.error.at[1] + most * w.error.at[1] + position * w.size.at[1] +
                           per_step_ * kUnit * numerator + kDenormals) /
                              divisor +
                          first * by_inverse) +
                  kDenormals;

    const double second_numerator = h.size.at[2] + most * w.size.at[2] + 2 * first * w.size.at[1];
    error.at[2] = 1.01 * ((h.error.at[2] + most * w.error.at[2] + position * w.size.at[2] +
                           2 * (first * w.error.at[1] + error.at[1] * w.size.at[1]) +
                           3 * per_step_ * kUnit * second_numerator + kDenormals) /
                              divisor +
                          second_numerator / divisor * by_inverse) +
                  kDenormals;
    const double numerators[3] = {most + std::fabs(o), numerator + first,
                                  second_numerator + second_numerator / divisor};
    double way = 0; // derivatives take the lower ones
    for (std::size_t d = 0; d < 3; ++d) {
      way += h.way.at[d] + w.way.at[d] + numerators[d];
      error.at[d] = unless_overflow<T>(error.at[d], way);
    }
    return error;
  }

  const CurveStorage<T>& storage_;
  const CurveShape& shape_;
  const T* values_;
  ControlValues control_;
  std::size_t derivatives_;
  double scale_[kMostOrder]; ///< 2^-power
  double roundings_[kMostOrder][3];
  int per_step_;
};

} // namespace

template <typename T>
void find_position_bounds(const CurveSet<T>& set, Isa isa, std::size_t begin, std::size_t end,
                          PositionBound* out) noexcept {
  CurveCertificate<T> certificate(*set.storage(), fuses_multiply_add(isa), 0);
  for (std::size_t curve = begin; curve < end; ++curve, ++out) {
    certificate.look_at(curve);
    for (std::size_t c = 0; c < static_cast<std::size_t>(set.components()); ++c) {
      (*out)[c] = certificate.bounds(c).at[0];
    }
  }
}

template void find_position_bounds(const CurveSet<float>&, Isa, std::size_t, std::size_t,
                                   PositionBound*) noexcept;
template void find_position_bounds(const CurveSet<double>&, Isa, std::size_t, std::size_t,
                                   PositionBound*) noexcept;

} // namespace detail

template <typename T>
CurveErrorBounds error_bounds(const CurveSet<T>& set, std::size_t curve, Isa isa) noexcept {
  return detail::find_bounds<CurveErrorBounds>(
      set, curve, isa, [&](bool fuses, CurveErrorBounds& bounds) {
        detail::CurveCertificate<T> certificate(*set.storage(), fuses, 2);
        certificate.look_at(curve);
        for (std::size_t c = 0; c < static_cast<std::size_t>(set.components()); ++c) {
          const detail::ByOrder error = certificate.bounds(c);
          bounds.position[c] = error.at[0];
          bounds.d1[c] = error.at[1];
          bounds.d2[c] = error.at[2];
        }
      });
}

template SIMDBEZIER_API CurveErrorBounds error_bounds(const CurveSet<float>&, std::size_t,
                                                      Isa) noexcept;
template SIMDBEZIER_API CurveErrorBounds error_bounds(const CurveSet<double>&, std::size_t,
                                                      Isa) noexcept;

} // namespace simdbezier
