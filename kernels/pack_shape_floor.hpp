// Where the plain cross product of du and dv is good enough as a normal, for patches of any shape.
#pragma once

#include "kernels/pack_formulas.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Finds the normal floor of patches in space from what |du| and |dv| stay below; zero for others.
///
/// Polynomial: |du| <= m max|P[j][i+1] - P[j][i]|, and du's error is some u times that. Rational:
/// with h = w (P - O) and b = P[j][i],
///     w du = h_u - S w_u = m sum B B (w[j][i+1] (b' - S) - w[j][i] (b - S)),   b' = P[j][i+1]
///          = m sum B B (w[j][i+1] (b' - b) + (w[j][i+1] - w[j][i]) (b - S)),
/// so that m (max(w,w') |b' - b| + |w' - w| R) / min w bounds |du|, where R bounds |b - S|; with
/// R >= |b - O|, too, each term of h_u - S w_u is of that size at the most, and so are its errors
/// in units of u. R is twice the largest |b|, or with local origins the extent of the net. The
/// quotient rounds about twice as often as a polynomial does, hence the factor 2.
template <typename T>
class ShapeFloor {
public:
  ShapeFloor(const detail::NetShape& shape, bool origins, const Wide* weights)
      : order_u_(shape.order_u()), order_v_(shape.order_v()),
        in_space_(shape.components == 3 && shape.degree_v > 0), origins_(origins),
        weights_(shape.rational ? weights : nullptr) {}

  /// One component of the control points, Cartesian and rounded to T, [j][i].
  void add(const Wide* points) {
    if (!in_space_) {
      return;
    }
    const Wide reach = weights_ == nullptr ? Wide(0.0) : reach_of(points);
    for (std::size_t j = 0; j < order_v_; ++j) {
      for (std::size_t i = 0; i < order_u_; ++i) {
        const std::size_t at = j * order_u_ + i;
        if (i + 1 < order_u_) {
          size_u_ = larger(step(points, at, at + 1, reach), size_u_);
        }
        if (j + 1 < order_v_) {
          size_v_ = larger(step(points, at, at + order_u_, reach), size_v_);
        }
      }
    }
  }

  [[nodiscard]] Wide value() const {
    if (!in_space_) {
      return Wide(0.0);
    }
    Wide u = Wide(static_cast<double>(order_u_ - 1)) * size_u_;
    Wide v = Wide(static_cast<double>(order_v_ - 1)) * size_v_;
    if (weights_ != nullptr) {
      Wide least = weights_[0];
      for (std::size_t k = 1; k < order_u_ * order_v_; ++k) {
        least = select_where<Wide>(weights_[k] < least, weights_[k], least);
      }
      u = divide(Wide(2.0) * u, least);
      v = divide(Wide(2.0) * v, least);
    }
    return normal_floor<T>(u, v);
  }

private:
  [[nodiscard]] SIMDBEZIER_INLINE Wide step(const Wide* points, std::size_t a, std::size_t b,
                                            Wide reach) const {
    const Wide distance = magnitude(points[b] - points[a]);
    if (weights_ == nullptr) {
      return distance;
    }
    return larger(weights_[a], weights_[b]) * distance +
           magnitude(weights_[b] - weights_[a]) * reach;
  }

  [[nodiscard]] Wide reach_of(const Wide* points) const {
    Wide highest = points[0];
    Wide lowest = points[0];
    for (std::size_t k = 1; k < order_u_ * order_v_; ++k) {
      highest = larger(points[k], highest);
      lowest = select_where<Wide>(points[k] < lowest, points[k], lowest);
    }
    return origins_ ? highest - lowest : Wide(2.0) * larger(magnitude(highest), magnitude(lowest));
  }

  std::size_t order_u_;
  std::size_t order_v_;
  bool in_space_;
  bool origins_;
  const Wide* weights_;     ///< null for polynomials
  Wide size_u_ = Wide(0.0); ///< largest step between neighbours, max norm
  Wide size_v_ = Wide(0.0);
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
