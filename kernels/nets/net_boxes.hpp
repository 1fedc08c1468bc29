// Boxes of groups of nets; the proofs are in docs/accuracy.md.
#pragma once

#include <limits>

#include "kernels/nets/casteljau.hpp"
#include "kernels/simd/extrema.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

template <typename V>
SIMDBEZIER_INLINE V size_of(V a) {
  return larger_of<V>(a, broadcast<V>(ScalarOf<V>(0)) - a);
}

template <typename T>
inline constexpr T kRoundoff = std::numeric_limits<T>::epsilon() / 2;
template <typename T>
inline constexpr T kSmallest = std::numeric_limits<T>::denorm_min();
template <typename T>
inline constexpr T kInfinity = std::numeric_limits<T>::infinity();
/// Values below the first may be added and doubled, weights above the second multiplied by
/// fractions of 1/256.
template <typename T>
inline constexpr T kSafelyLarge = std::numeric_limits<T>::max() / 4;
template <typename T>
inline constexpr T kSafelySmall = std::numeric_limits<T>::min() * 256;

// Values are finite, or else the results below are not used: nan needs no care in comparisons.

/// The values of one component, or of the weight, over `points` points.
template <typename V>
struct ValueRange {
  V low;
  V high;
};
template <typename V>
SIMDBEZIER_INLINE ValueRange<V> range_over(const ScalarOf<V>* group, std::size_t points,
                                           std::size_t channels, std::size_t c) {
  ValueRange<V> range{value_of<V>(group, c), value_of<V>(group, c)};
  for (std::size_t k = 1; k < points; ++k) {
    const V value = value_of<V>(group, k * channels + c);
    range.low = smaller_of<V>(value, range.low);
    range.high = larger_of<V>(value, range.high);
  }
  return range;
}

/// Reads the points themselves: homogeneous nets are projected.
template <typename V>
SIMDBEZIER_INLINE void gather_points(const detail::NetView<const ScalarOf<V>>& in, bool rational,
                                     std::size_t first, std::size_t count, ScalarOf<V>* group) {
  read_group<V>(in, first, count, group);
  if (rational && in.weights != Weights::cartesian) {
    project<V>(group, in.order_u * in.order_v, in.channels);
  }
}

/// Opens a range by the rounding of its values, up to u of each, and by that of this very step.
template <typename V>
SIMDBEZIER_INLINE ValueRange<V> opened(const ValueRange<V>& range) {
  using T = ScalarOf<V>;
  const V relative = broadcast<V>(4 * kRoundoff<T>);
  const V absolute = broadcast<V>(4 * kSmallest<T>);
  const V below = relative * size_of<V>(range.low) + absolute;
  const V above = relative * size_of<V>(range.high) + absolute;
  return {range.low - below, range.high + above};
}

template <typename T>
SIMDBEZIER_INLINE void store_range(const detail::BoxTask<T>& task, std::size_t first,
                                   std::size_t count, std::size_t c,
                                   const ValueRange<vec<T>>& range) {
  using V = vec<T>;
  alignas(64) T low[kLanes<V>];
  alignas(64) T high[kLanes<V>];
  store_vector<V>(low, range.low + broadcast<V>(T(0)));
  store_vector<V>(high, range.high + broadcast<V>(T(0)));
  for (std::size_t p = 0; p < count; ++p) {
    task.low[(first + p) * task.in.components + c] = low[p];
    task.high[(first + p) * task.in.components + c] = high[p];
  }
}

/// What is subdivided: a net moved to its first point, and what came of it.
template <typename V>
struct Pieces {
  Axis u;
  Axis v;
  std::size_t points;
  std::size_t channels;
  std::size_t components;
  ValueRange<V>* hull; ///< of every component, around the first point
};

/// Opens the hull to the control points of all pieces, 4^levels of them. `net` is used up; behind
/// it is room for two nets a level.
template <typename V>
void add_pieces(Pieces<V>& pieces, ScalarOf<V>* net, int levels) {
  using T = ScalarOf<V>;
  if (levels == 0) {
    if (pieces.channels > pieces.components) {
      project<V>(net, pieces.points, pieces.channels);
    }
    for (std::size_t c = 0; c < pieces.components; ++c) {
      const ValueRange<V> range = range_over<V>(net, pieces.points, pieces.channels, c);
      pieces.hull[c] = {smaller_of<V>(range.low, pieces.hull[c].low),
                        larger_of<V>(range.high, pieces.hull[c].high)};
    }
    return;
  }
  const Middle<V> middle;
  const std::size_t values = pieces.points * pieces.channels;
  T* const low_u = lanes_of<V>(net, values);
  T* const low_v = lanes_of<V>(low_u, values);
  split_axis<V>(net, low_u, pieces.u, middle);
  for (T* const half : {low_u, net}) {
    // Quarters go where the levels below may use them up: behind everything that is still needed.
    split_axis<V>(half, low_v, pieces.v, middle);
    add_pieces<V>(pieces, low_v, levels - 1);
    copy_group<V>(half, values, low_v);
    add_pieces<V>(pieces, low_v, levels - 1);
  }
}

/// Returns the bound of docs/accuracy.md on what rounding did to a component's hull.
template <typename V>
SIMDBEZIER_INLINE V hull_margin(const ValueRange<V>& control, const ValueRange<V>& moved,
                                V weight_low, V weight_high, bool rational, ScalarOf<V> means) {
  using T = ScalarOf<V>;
  // The factor 1.0625 is for the margin's own roundings and all terms of higher order.
  constexpr T kSlack = T(1.0625) * kRoundoff<T>;
  const V extent = larger_of<V>(size_of<V>(moved.low), size_of<V>(moved.high));
  const V size = larger_of<V>(size_of<V>(control.low), size_of<V>(control.high));
  const T passes = rational ? 2 * means + 5 : means + 3;
  V units = broadcast<V>(4 * (means + 4));
  MaskOf<V> unsafe = !(size < broadcast<V>(kSafelyLarge<T>));
  if (rational) {
    // Denormals in w Q and w count by what they are after the division by w.
    units = units + divide(units * (broadcast<V>(T(1)) + extent), weight_low);
    const V most = weight_high * larger_of<V>(extent, broadcast<V>(T(1)));
    unsafe = unsafe | (weight_low < broadcast<V>(kSafelySmall<T>));
    unsafe = unsafe | !(most < broadcast<V>(kSafelyLarge<T>));
  }
  const V relative = broadcast<V>(passes * kSlack) * extent + broadcast<V>(4 * kSlack) * size;
  const V margin = relative + units * broadcast<V>(kSmallest<T>);
  return select_where<V>(unsafe, broadcast<V>(kInfinity<T>), margin);
}

/// Returns the tighter box, or that of the control points where nothing better is certain: every
/// comparison with nan fails.
template <typename V>
SIMDBEZIER_INLINE ValueRange<V> tightened(const ValueRange<V>& control, V origin,
                                          const ValueRange<V>& hull, V margin) {
  const V low = (origin + hull.low) - margin;
  const V high = (origin + hull.high) + margin;
  return {select_where<V>(low > control.low, low, control.low),
          select_where<V>(high < control.high, high, control.high)};
}

template <typename T>
Isa box_kernel(const detail::BoxTask<T>& task, std::size_t begin, std::size_t end,
               unsigned char* scratch) {
  using V = vec<T>;
  const detail::NetView<const T>& in = task.in;
  const std::size_t components = in.components;
  const bool rational = in.channels > components;
  const std::size_t points = in.order_u * in.order_v;
  T* const net = reinterpret_cast<T*>(scratch);
  ValueRange<V> hull[detail::kMostChannels];
  ValueRange<V> control[detail::kMostChannels];
  V origin[detail::kMostChannels];
  Pieces<V> pieces{axis_u(in.order_u, in.order_v, in.channels),
                   axis_v(in.order_u, in.order_v, in.channels),
                   points,
                   in.channels,
                   components,
                   hull};
  const auto means =
      static_cast<T>(static_cast<std::size_t>(task.levels) * (in.order_u + in.order_v - 2));
  for_groups<V>(begin, end, [&](std::size_t first, std::size_t count) {
    gather_points<V>(in, rational, first, count, net);
    for (std::size_t c = 0; c < in.channels; ++c) {
      control[c] = range_over<V>(net, points, in.channels, c);
      control[c] =
          rational && in.weights != Weights::cartesian ? opened<V>(control[c]) : control[c];
    }
    ValueRange<V> moved[detail::kMostChannels];
    for (std::size_t c = 0; task.levels > 0 && c < components; ++c) {
      origin[c] = value_of<V>(net, c);
      for (std::size_t k = 0; k < points; ++k) {
        T* const point = lanes_of<V>(net, k * in.channels);
        put_value<V>(point, c, value_of<V>(point, c) - origin[c]);
      }
      moved[c] = range_over<V>(net, points, in.channels, c);
      hull[c] = {broadcast<V>(kInfinity<T>), broadcast<V>(-kInfinity<T>)};
    }
    if (task.levels > 0) {
      if (rational) {
        weigh<V>(net, points, in.channels);
      }
      add_pieces<V>(pieces, net, task.levels);
    }
    for (std::size_t c = 0; c < components; ++c) {
      if (task.levels > 0) {
        const ValueRange<V> w = control[in.channels - 1];
        const V margin = hull_margin<V>(control[c], moved[c], w.low, w.high, rational, means);
        control[c] = tightened<V>(control[c], origin[c], hull[c], margin);
      }
      store_range(task, first, count, c, control[c]);
    }
  });
  return Isa::SIMDBEZIER_ISA;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
