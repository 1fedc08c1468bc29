// What bounds on triangles are formed of: lanes are patches.
#pragma once

#include "kernels/simd/extrema.hpp"
#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Three edge terms of a triangle in order, and how far the largest one is above the sum of the
/// others. Where one of them is far smaller than the rest, differences of their products would have
/// few correct digits; differences of neighbours keep theirs.
template <typename V>
struct SortedTerms {
  V least;
  V middle;
  V largest;
  V excess;

  SIMDBEZIER_INLINE SortedTerms(V a, V c, V d) {
    const V low = smaller_of<V>(a, c);
    const V high = larger_of<V>(a, c);
    least = smaller_of<V>(low, d);
    middle = larger_of<V>(low, smaller_of<V>(high, d));
    largest = larger_of<V>(high, d);
    excess = (largest - middle) - least;
  }
  [[nodiscard]] SIMDBEZIER_INLINE MaskOf<V> obtuse() const {
    return excess >= broadcast<V>(ScalarOf<V>(0));
  }
  /// Returns twice the products of two terms, less the squares.
  [[nodiscard]] SIMDBEZIER_INLINE V divisor() const {
    const V product = (least + least) * (middle + middle);
    return product - excess * excess;
  }
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
