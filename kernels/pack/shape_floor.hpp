// Decides where the plain cross product of du and dv is good enough as a normal, for patches of any
// shape.
#pragma once

#include "kernels/pack/pack_formulas.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Finds what the quick test of normals compares with, for patches in space; zero for others.
/// Polynomial patches have one floor: |du| <= m max|P[j][i+1] - P[j][i]|, and du's error is some u
/// times that, and what packing has left. Rational ones have two sizes, E_u w^2 and E_v w^2,
/// because errors depend on the sample's weight: docs/accuracy.md, "Normals", has the proof and the
/// letters.
template <typename T, typename W>
class ShapeFloor {
public:
  ShapeFloor(const detail::NetShape& shape, bool origins, const Wide* weights)
      : shape_(shape), order_u_(shape.order_u()), order_v_(shape.order_v()),
        in_space_(shape.components == 3), origins_(origins),
        weights_(shape.rational ? weights : nullptr) {}

  /// Adds one component of the control points, Cartesian, [j][i].
  void add(const Wide* points) {
    if (!in_space_) {
      return;
    }
    for_neighbours([&](std::size_t a, std::size_t b, Wide& size) SIMDBEZIER_INLINE_LAMBDA {
      const Wide distance = magnitude(points[b] - points[a]);
      size = larger_of<Wide>(
          weights_ == nullptr ? distance : larger_of<Wide>(weights_[a], weights_[b]) * distance,
          size);
    });
    size_.point = larger_of<Wide>(magnitude(points[0]), size_.point);
    if (weights_ != nullptr) {
      add_reach(points);
    }
  }
  /// Adds the coefficients of a cell, [l][k], of a component or of the weight.
  void add_terms(const W* values, bool is_weight = false) {
    if (!in_space_ || (weights_ == nullptr && shape_.cells() == 1)) {
      return; // nothing asks for them
    }
    Wide sum(0.0);
    for (std::size_t l = order_v_; l-- > 0;) {
      Wide row(0.0);
      for (std::size_t k = order_u_; k-- > 0;) {
        row = Wide(0.5) * row + magnitude(to_wide(values[l * order_u_ + k]));
      }
      sum = Wide(0.5) * sum + row;
    }
    Wide& largest = is_weight ? weight_terms_ : terms_;
    largest = larger_of<Wide>(sum, largest);
  }

  /// Finds as many floors as NetShape::floors() says.
  void finish(Wide floors[2]) {
    floors[0] = floors[1] = Wide(0.0);
    if (!in_space_) {
      return;
    }
    const Wide m(static_cast<double>(shape_.degree_u));
    const Wide n(static_cast<double>(shape_.degree_v));
    const double halves = shape_.cells() > 1 ? 2 : 1; // whose parameters run twice as fast
    const Wide doubt = packing_doubt<W>(
        shape_.degree_u + shape_.degree_v,
        halves * static_cast<double>((1U << shape_.degree_u) + (1U << shape_.degree_v)));
    if (weights_ == nullptr) {
      const Wide packed = shape_.cells() > 1
                              ? doubt * terms_
                              : packing_doubt_of<W>(size_, shape_.degree_u, shape_.degree_v);
      floors[0] = normal_floor<T>(m, n, size_, packed);
      return;
    }
    const Wide steps_u = size_.u;
    const Wide steps_v = size_.v;
    size_.u = size_.v = Wide(0.0);
    for_neighbours([&](std::size_t a, std::size_t b, Wide& turn) SIMDBEZIER_INLINE_LAMBDA {
      turn = larger_of<Wide>(magnitude(weights_[b] - weights_[a]), turn);
    });
    Wide heaviest(0.0);
    for (std::size_t k = 0; k < order_u_ * order_v_; ++k) {
      heaviest = larger_of<Wide>(weights_[k], heaviest);
    }
    const Wide four_reaches = Wide(4.0) * reach_;
    const Wide packed =
        Wide(kSingle ? 0x6p10 : 0x6p20) * (doubt * (terms_ + reach_ * weight_terms_));
    const auto floor = [&](Wide degree, Wide steps, Wide turn) {
      // This is sqrt(2) c, rounded up.
      const Wide factor(kSingle ? 0x1.7p-10 : 0x1.7p-20);
      const Wide size = larger_of<Wide>(steps + turn * four_reaches, packed);
      return error_size<T>(factor * (degree * size) * heaviest, heaviest);
    };
    floors[0] = floor(m, steps_u, size_.u);
    floors[1] = floor(n, steps_v, size_.v);
  }

private:
  static constexpr bool kSingle = sizeof(T) == sizeof(float);

  /// Calls f(a, b, size_.u or size_.v) for all neighbours in u and in v.
  template <typename F>
  SIMDBEZIER_INLINE void for_neighbours(const F& f) {
    for (std::size_t j = 0; j < order_v_; ++j) {
      for (std::size_t i = 0; i < order_u_; ++i) {
        const std::size_t at = j * order_u_ + i;
        if (i + 1 < order_u_) {
          f(at, at + 1, size_.u);
        }
        if (j + 1 < order_v_) {
          f(at, at + order_u_, size_.v);
        }
      }
    }
  }

  void add_reach(const Wide* points) {
    Wide highest = points[0];
    Wide lowest = points[0];
    for (std::size_t k = 1; k < order_u_ * order_v_; ++k) {
      highest = larger_of<Wide>(points[k], highest);
      lowest = select_where<Wide>(points[k] < lowest, points[k], lowest);
    }
    const Wide distance = larger_of<Wide>(magnitude(highest), magnitude(lowest));
    // Origins are rounded to T.
    constexpr double kUnit = kSingle ? 0x1p-24 : 0x1p-53;
    const Wide reach = origins_ ? highest - lowest + Wide(kUnit) * distance : distance;
    reach_ = larger_of<Wide>(reach, reach_);
  }

  const detail::NetShape& shape_;
  std::size_t order_u_;
  std::size_t order_v_;
  bool in_space_;
  bool origins_;
  const Wide* weights_;  ///< null for polynomials
  DifferenceSizes size_; ///< of neighbours, times weights where there are any
  Wide reach_ = Wide(0.0);
  Wide terms_ = Wide(0.0); ///< largest sum of a component's terms
  Wide weight_terms_ = Wide(0.0);
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
