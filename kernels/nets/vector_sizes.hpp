// The largest of some control vectors' sizes: lanes are vectors of one patch, so that each patch
// can be searched in steps of its own.
#pragma once

#include <limits>

#include "kernels/nets/net_boxes.hpp"
#include "kernels/simd/extrema.hpp"
#include "kernels/simd/lanes.hpp"
#include "src/tables/vector_sizes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The vectors of one register: x, y, z and w.
template <typename V>
struct VectorGroup {
  V at[4];

  template <bool kRational>
  static SIMDBEZIER_INLINE VectorGroup load(const detail::VectorList& list, std::size_t k) {
    VectorGroup group{};
    for (std::size_t c = 0; c < (kRational ? 4 : 3); ++c) {
      group.at[c] = load_vector<V>(list.first + c * list.stride + k);
    }
    return group;
  }
};

/// Finds the largest size of the vectors it is shown. Sizes of polynomial vectors are compared as
/// squares, whose roots are in the same order.
template <typename V, bool kRational>
class LargestSize {
public:
  explicit SIMDBEZIER_INLINE LargestSize(const detail::Hull& hull)
      : middle_{broadcast<V>(hull.middle[0]), broadcast<V>(hull.middle[1]),
                broadcast<V>(hull.middle[2])},
        radius_(broadcast<V>(hull.radius)) {}

  SIMDBEZIER_INLINE void include(const V (&v)[4]) {
    V square = broadcast<V>(0);
    for (std::size_t c = 0; c < 3; ++c) {
      const V along = kRational ? v[c] - middle_[c] * v[3] : v[c];
      square = c == 0 ? along * along : square + along * along;
    }
    const V size = kRational ? square_root(square) + radius_ * size_of<V>(v[3]) : square;
    largest_ = larger_of<V>(size, largest_);
    sum_ = sum_ + size;
  }
  [[nodiscard]] SIMDBEZIER_INLINE double value() const {
    alignas(64) double largest[kLanes<V>];
    alignas(64) double sum[kLanes<V>];
    store_vector<V>(largest, kRational ? largest_ : square_root(largest_));
    store_vector<V>(sum, sum_);
    double most = 0;
    bool known = true; // a sum of sizes is nan where one of them is, which extrema would pass over
    for (std::size_t p = 0; p < kLanes<V>; ++p) {
      most = largest[p] > most ? largest[p] : most;
      known = known && sum[p] == sum[p];
    }
    return known ? most : std::numeric_limits<double>::infinity();
  }

private:
  V middle_[3];
  V radius_;
  V largest_ = broadcast<V>(0);
  V sum_ = broadcast<V>(0);
};

template <bool kRational>
SIMDBEZIER_KERNEL double largest_size(const detail::VectorList& list, const detail::Hull& hull) {
  using V = vec<double>;
  LargestSize<V, kRational> largest(hull);
  for (std::size_t k = 0; k < list.count; k += kLanes<V>) {
    largest.include(VectorGroup<V>::template load<kRational>(list, k).at);
  }
  return largest.value();
}

template <bool kRational>
SIMDBEZIER_KERNEL detail::DiagonalSizes diagonal_sizes(const detail::DiagonalTask& task,
                                                       const detail::Hull& hull) {
  using V = vec<double>;
  using Group = VectorGroup<V>;
  LargestSize<V, kRational> rising(hull);
  LargestSize<V, kRational> falling(hull);
  const V factor_uu = broadcast<V>(task.factor_uu);
  const V factor_uv = broadcast<V>(task.factor_uv);
  const V factor_vv = broadcast<V>(task.factor_vv);
  for (std::size_t k = 0; k < task.uu.count; k += kLanes<V>) {
    const Group uu = Group::template load<kRational>(task.uu, k);
    const Group uv = Group::template load<kRational>(task.uv, k);
    const Group vv = Group::template load<kRational>(task.vv, k);
    Group up{};
    Group down{};
    for (std::size_t c = 0; c < (kRational ? 4 : 3); ++c) {
      const V first = factor_uu * uu.at[c];
      const V mixed = factor_uv * uv.at[c];
      const V last = factor_vv * vv.at[c];
      up.at[c] = (first + mixed) + last;
      down.at[c] = (first - mixed) + last;
    }
    rising.include(up.at);
    falling.include(down.at);
  }
  return {rising.value(), falling.value()};
}

inline double largest_kernel(const detail::VectorList& list, const detail::Hull& hull,
                             bool rational) {
  return rational ? largest_size<true>(list, hull) : largest_size<false>(list, hull);
}
inline detail::DiagonalSizes diagonal_kernel(const detail::DiagonalTask& task,
                                             const detail::Hull& hull, bool rational) {
  return rational ? diagonal_sizes<true>(task, hull) : diagonal_sizes<false>(task, hull);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
