// Hulls of parts of patches, and sizes of vectors that are measured from them: lanes are patches.
#pragma once

#include <limits>

#include "kernels/nets/net_boxes.hpp"
#include "kernels/rates/lane_nets.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The larger of two bounds; infinity where one of them is no number, because comparisons with nan
/// would pass it over.
template <typename V>
SIMDBEZIER_INLINE V larger_bound(V a, V b) {
  const V endless = broadcast<V>(std::numeric_limits<double>::infinity());
  return select_where<V>(b <= a, a, select_where<V>(b > a, b, endless));
}

/// See src/tables/bound_task.hpp.
template <typename V>
struct LaneHull {
  V middle[3];
  V radius;
  V smallest_weight;
};

/// Grows around points, and then is a hull.
template <typename V>
class LaneBox {
public:
  SIMDBEZIER_INLINE void include(const LaneNet<V, 4>& net) {
    for (std::size_t k = 0; k < net.columns * net.rows; ++k) { // of the patch's own degrees
      const V* const x = net.at[k].x;
      for (std::size_t c = 0; c < 3; ++c) {
        const V at = divide(x[c], x[3]);
        low_[c] = smaller_of<V>(at, low_[c]);
        high_[c] = larger_of<V>(at, high_[c]);
      }
      smallest_weight_ = smaller_of<V>(x[3], smallest_weight_);
    }
  }
  SIMDBEZIER_INLINE void include(const LaneBox& other) {
    for (std::size_t c = 0; c < 3; ++c) {
      low_[c] = smaller_of<V>(other.low_[c], low_[c]);
      high_[c] = larger_of<V>(other.high_[c], high_[c]);
    }
    smallest_weight_ = smaller_of<V>(other.smallest_weight_, smallest_weight_);
  }
  [[nodiscard]] SIMDBEZIER_INLINE LaneHull<V> hull() const {
    const V rounding = broadcast<V>(1 + 0x1p-40);
    LaneHull<V> hull;
    V square = broadcast<V>(0);
    for (std::size_t c = 0; c < 3; ++c) {
      hull.middle[c] = low_[c] + (high_[c] - low_[c]) * broadcast<V>(0.5);
      const V reach = larger_of<V>(high_[c] - hull.middle[c], hull.middle[c] - low_[c]);
      square = square + reach * reach;
    }
    hull.radius = square_root(square) * rounding;
    hull.smallest_weight = divide(smallest_weight_, rounding);
    return hull;
  }

private:
  static constexpr double kEndless = std::numeric_limits<double>::infinity();
  V low_[3] = {broadcast<V>(kEndless), broadcast<V>(kEndless), broadcast<V>(kEndless)};
  V high_[3] = {broadcast<V>(-kEndless), broadcast<V>(-kEndless), broadcast<V>(-kEndless)};
  V smallest_weight_ = broadcast<V>(kEndless);
};

/// Returns the size of vectors as it is compared with others: that of polynomial ones as a square,
/// whose roots are in the same order.
template <typename V, std::size_t kComponents>
SIMDBEZIER_INLINE V measure_of(const V (&v)[kComponents], const LaneHull<V>& hull) {
  constexpr bool kRational = kComponents == 4;
  V square = broadcast<V>(0);
  for (std::size_t c = 0; c < 3; ++c) {
    V along = v[c];
    if constexpr (kRational) {
      along = along - hull.middle[c] * v[3];
    }
    square = c == 0 ? along * along : square + along * along;
  }
  if constexpr (kRational) {
    return square_root(square) + hull.radius * size_of<V>(v[3]);
  }
  return square;
}

/// Finds the largest of some sizes.
template <typename V, std::size_t kComponents>
class LargestSize {
public:
  SIMDBEZIER_INLINE void include(V measure) {
    largest_ = larger_of<V>(measure, largest_);
    sum_ = sum_ + measure;
  }
  [[nodiscard]] SIMDBEZIER_INLINE V value() const {
    // A sum of sizes is nan where one of them is, which comparisons would pass over.
    return select_where<V>(sum_ == sum_, kComponents == 4 ? largest_ : square_root(largest_),
                           broadcast<V>(std::numeric_limits<double>::infinity()));
  }

private:
  V largest_ = broadcast<V>(0);
  V sum_ = broadcast<V>(0);
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
