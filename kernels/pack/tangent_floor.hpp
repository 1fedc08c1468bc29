// What tangents are tested with; lanes are curves.
#pragma once

#include "kernels/pack/pack_formulas.hpp"
#include "src/tables/curve_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Finds what |C'| is compared with: where it is above 2^-7 (float) or 2^-20 (double) of what its
/// errors are relative to, the kernel's own tangent is good.
///
/// Polynomial, the square of that: errors of C' are some u times its largest control value.
/// Rational, the part of it that does not depend on the sample; over w^2, squared, it is the floor.
/// As with patches (pack/shape_floor.hpp), errors are some u times
///     n (D + 4 B R) W / w^2:
/// R >= |P - O|, W the largest weight, D and B the largest max(w,w') |P' - P| and |w' - w| of
/// neighbours.
template <typename T>
class TangentFloor {
public:
  /// weights: null for polynomials.
  TangentFloor(const detail::CurveShape& shape, const Wide* weights)
      : shape_(shape), weights_(weights) {}

  SIMDBEZIER_INLINE void add(const Wide* points) {
    for (std::size_t i = 0; i < shape_.order(); ++i) {
      extent_ = larger_of<Wide>(magnitude(points[i] - points[0]), extent_);
      size_ = larger_of<Wide>(magnitude(points[i]), size_);
    }
    for (std::size_t i = 1; weights_ != nullptr && i < shape_.order(); ++i) {
      const Wide weight = larger_of<Wide>(weights_[i - 1], weights_[i]);
      step_ = larger_of<Wide>(weight * magnitude(points[i] - points[i - 1]), step_);
    }
  }
  /// Returns the floor, or infinity where products of the test could leave the range of T.
  SIMDBEZIER_INLINE Wide value() const {
    const Wide degree(static_cast<double>(shape_.degree));
    if (weights_ != nullptr) {
      return rational_size(degree);
    }
    const Wide power = power_of_two_below(degree * extent_);
    const MaskOf<Wide> in_range =
        (power >= Wide(kSingle ? 0x1p-40 : 0x1p-450)) & (power <= Wide(kSingle ? 0x1p40 : 0x1p450));
    return select_where<Wide>(in_range, power * power * Wide(kClear * kClear), infinity());
  }

private:
  static constexpr bool kSingle = sizeof(T) == sizeof(float);
  static constexpr double kClear = kSingle ? 0x1p-7 : 0x1p-20;

  static Wide infinity() { return Wide(std::numeric_limits<double>::infinity()); }

  SIMDBEZIER_INLINE Wide rational_size(Wide degree) const {
    Wide heaviest = weights_[0];
    Wide turn(0.0);
    for (std::size_t i = 1; i < shape_.order(); ++i) {
      heaviest = larger_of<Wide>(weights_[i], heaviest);
      turn = larger_of<Wide>(magnitude(weights_[i] - weights_[i - 1]), turn);
    }
    // Origins are rounded to T.
    constexpr double kUnit = kSingle ? 0x1p-24 : 0x1p-53;
    const Wide reach = shape_.origins ? extent_ + extent_ + Wide(kUnit) * size_ : size_;
    const Wide size = Wide(kClear) * degree * (step_ + Wide(4.0) * turn * reach) * heaviest;
    return error_size<T>(size, heaviest);
  }

  const detail::CurveShape& shape_;
  const Wide* weights_;
  Wide extent_ = Wide(0.0); ///< largest distance from the first point, max norm
  Wide size_ = Wide(0.0);   ///< largest distance from the origin
  Wide step_ = Wide(0.0);   ///< largest weighted distance of neighbours
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
