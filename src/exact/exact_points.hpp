// Control points as exact questions see them.
#pragma once

#include <cmath>
#include <cstddef>

#include "src/exact/quantities.hpp"
#include "src/storage/given_points.hpp"
#include "src/storage/net_shape.hpp"
#include "src/storage/one_point.hpp"

namespace simdbezier::detail {

/// The control points of one patch or curve, up to three components and the weight of each, read
/// once. Not initialised beyond what there is.
class ExactPoints {
public:
  ExactPoints(const GivenNet& net, std::size_t count, std::size_t components)
      : count_(count), components_(components < 3 ? components : 3), weights_(net.all->weights),
        is_place_(components <= 3), tolerance_(one_point_tolerance(weights_, net.all->in_double)) {
    const std::size_t channels = components + (rational() ? 1 : 0);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t c = 0; c < components_; ++c) {
        point_[k][c] = net.value(k * channels + c);
        largest_point_ = std::fmax(largest_point_, std::fabs(point_[k][c]));
      }
      if (rational()) {
        weight_[k] = net.value(k * channels + components);
        largest_weight_ = std::fmax(largest_weight_, weight_[k]);
      }
    }
  }

  /// Puts point k where another one is: the caller says that both are one.
  void merge(std::size_t k, std::size_t into) {
    const bool divided = weights_ == Weights::homogeneous;
    for (std::size_t c = 0; c < components_; ++c) {
      point_[k][c] = divided ? point_[into][c] / weight_[into] * weight_[k] : point_[into][c];
    }
  }

  [[nodiscard]] std::size_t components() const { return components_; }
  [[nodiscard]] bool rational() const { return weights_ != Weights::none; }
  [[nodiscard]] double largest_point() const { return largest_point_; }
  [[nodiscard]] double largest_weight() const { return largest_weight_; }

  void include_in(DigitRange& points, DigitRange& weights) const {
    for (std::size_t k = 0; k < count_; ++k) {
      for (std::size_t c = 0; c < components_; ++c) {
        points.include(point_[k][c]);
      }
      if (rational()) {
        weights.include(weight_[k]);
      }
    }
  }
  /// Digits of the coordinates that place() returns.
  [[nodiscard]] int digits(const DigitRange& points, const DigitRange& weights) const {
    return points.digits() + (rational() ? weights.digits() + 1 : 0);
  }

  /// The additional factor by which place() multiplies numerators.
  [[nodiscard]] double numerator_factor(std::size_t origin) const {
    return weights_ == Weights::homogeneous ? weight_[origin] : 1;
  }
  /// Homogeneous coordinates of point k, components and then the weight, relative to another one
  /// where there are weights: what is one point with that one (one_point.hpp) has numerators of
  /// exactly zero. Of homogeneous input, these are multiplied by its weight, so that there is no
  /// quotient; a common factor of all numerators scales the figure and changes no direction.
  template <typename Field>
  void place(const Field& field, std::size_t k, std::size_t origin,
             typename Field::Value to[4]) const {
    const auto weight = rational() ? field.number(kWeight, weight_[k]) : field.one();
    const bool one = weights_ == Weights::homogeneous && are_one(k, origin);
    for (std::size_t c = 0; c < 3; ++c) {
      if (c >= components_ || one) {
        to[c] = field.zero();
        continue;
      }
      const auto p = field.number(kPoint, point_[k][c]);
      if (!rational()) {
        to[c] = p;
        continue;
      }
      const auto o = field.number(kPoint, point_[origin][c]);
      to[c] = weights_ == Weights::homogeneous
                  ? field.determinant(field.number(kWeight, weight_[origin]), p, weight, o)
                  : field.multiply(weight, field.subtract(p, o));
    }
    to[3] = weight;
  }

private:
  [[nodiscard]] bool are_one(std::size_t k, std::size_t l) const {
    double size = 0;
    double apart = 0;
    for (std::size_t c = 0; c < components_; ++c) {
      const double x = point_[k][c] / weight_[k];
      const double y = point_[l][c] / weight_[l];
      size = std::fmax(is_place_ ? size : 0, std::fmax(std::fabs(x), std::fabs(y)));
      apart = std::fmax(is_place_ ? apart : 0, std::fabs(x - y));
      if (!is_place_ && !(apart <= tolerance_ * size)) {
        return false;
      }
    }
    return apart <= tolerance_ * size;
  }

  std::size_t count_;
  std::size_t components_;
  Weights weights_;
  bool is_place_; ///< coordinates are compared with the largest one, as joint_components() says
  double tolerance_;
  double largest_point_ = 0;
  double largest_weight_ = 0;
  double point_[kMostOrder * kMostOrder][3];
  double weight_[kMostOrder * kMostOrder];
};

} // namespace simdbezier::detail
