// Decides where the plain cross product of du and dv is good enough as a normal, for patches of any
// shape.
#pragma once

#include "kernels/pack/pack_formulas.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Finds what the quick test of normals compares with, for patches in space; zero for others.
///
/// Polynomial, one floor for the patch: |du| <= m max|P[j][i+1] - P[j][i]|, and du's error is some
/// u times that, and what packing has left.
///
/// Rational, two sizes, E_u w^2 and E_v w^2, because errors depend on the sample's weight. With
/// h = w (P - O), which the kernels form beside w, and
///     w du = h_u - S w_u,  S = h / w,
/// let R >= |P - O|, and so >= |S|, since S is in the hull; W the largest weight; over neighbours
/// P, P' in u, D the largest max(w,w') |P' - P| and B the largest |w' - w|. Errors of polynomials
/// are K u times their largest control value (docs/accuracy.md), which is
///     R W of h,  W of w,  m (D + B R) of h_u, as w'p' - wp = w'(p' - p) + (w' - w) p,  m B of w_u.
/// Hence S is wrong by K u 2 R W / w, and as |w_u| <= m B, du by at most K u times
///     (m (D + B R) + R m B + m B 2 R W / w) / w <= m (D + 4 B R) W / w^2 = E_u,
/// with the quotient's own roundings by K + 3. The error of the last division is left out: it makes
/// du longer, but does not turn it. The test
///     |du x dv|^2 > 2 c^2 (E_u^2 |dv|^2 + E_v^2 |du|^2)  [>= c^2 (E_u |dv| + E_v |du|)^2]
/// has c = 2^-10 (in double 2^-20, stricter): what passes needs no second look, as it is turned by
/// 2^-14 K (2^-33 K) at the most, up to the norms' factors. What passes has W / w < 2^10, as |du|
/// <= m (D + 2 B R) / w: there w itself is known well enough.
///
/// Errors of packing: packing_doubt_of() for polynomials with one cell. Of others, which it would
/// judge too harshly, let s be the sum of all terms of a packed polynomial, at their largest. No
/// control value is larger, nor any coefficient of a row or a column on the way, so that both
/// directions together leave at most (2^m + 2^n) s times the roundings of a sum (packing_doubt()).
/// If that is e_h in h and e_w in w, they add 6 m (e_h + R e_w) / w to du: E_u is at least that in
/// units of c.
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
