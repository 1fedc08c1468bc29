// Takes a group of control nets from memory to [value][lane], one patch a lane, and back.
#pragma once

#include "kernels/simd/transpose.hpp"
#include "src/storage/one_point.hpp"
#include "src/tables/net_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns where value k of a group lies.
template <typename V>
SIMDBEZIER_INLINE ScalarOf<V>* lanes_of(ScalarOf<V>* group, std::size_t k) {
  return group + k * kLanes<V>;
}
template <typename V>
SIMDBEZIER_INLINE V value_of(const ScalarOf<V>* group, std::size_t k) {
  return load_vector<V>(group + k * kLanes<V>);
}
template <typename V>
SIMDBEZIER_INLINE void put_value(ScalarOf<V>* group, std::size_t k, V value) {
  store_vector<V>(group + k * kLanes<V>, value);
}

template <typename S>
SIMDBEZIER_INLINE std::size_t values_of(const detail::NetView<S>& nets) {
  return nets.order_u * nets.order_v * nets.channels;
}

template <typename S>
SIMDBEZIER_INLINE S* net_at(const detail::NetView<S>& nets, std::size_t patch) {
  return nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride;
}

/// Calls visit(pointer to the value, its number) for values [first_value, …) of a net.
template <typename S, typename Visit>
SIMDBEZIER_INLINE void for_each_value(const detail::NetView<S>& nets, std::size_t patch,
                                      std::size_t first_value, Visit visit) {
  S* row = net_at(nets, patch);
  if (nets.packed) {
    const std::size_t values = values_of(nets);
    for (std::size_t k = first_value; k < values; ++k) {
      visit(row + k, k);
    }
    return;
  }
  std::size_t k = 0;
  for (std::size_t j = 0; j < nets.order_v; ++j, row += nets.row_stride) {
    S* point = row;
    for (std::size_t i = 0; i < nets.order_u; ++i, point += nets.point_stride) {
      for (std::size_t c = 0; c < nets.channels; ++c, ++k) {
        visit(point + static_cast<std::ptrdiff_t>(c) * nets.component_stride, k);
      }
    }
  }
}

/// A block has so many values, which are moved at once; 0: values are moved one by one.
template <typename V>
inline constexpr std::size_t kBlock = sizeof(ScalarOf<V>) == sizeof(double) ? kTransposed
                                      : kIsScalar<V>                        ? 0
                                      : kLineWide<V>                        ? kLanes<V>
                                                                            : kQuad<V>;

/// Loads group[k][p] = from[p * stride + k] + 0 for a block of k and all lanes p.
template <typename V, typename S>
SIMDBEZIER_INLINE void load_block(const S* from, std::ptrdiff_t stride, ScalarOf<V>* group) {
  V values[kBlock<V>];
  if constexpr (sizeof(ScalarOf<V>) == sizeof(double)) {
    load_transposed(from, stride, values);
  } else {
    load_values_across<kBlock<V>>(from, stride, values);
  }
  for (std::size_t k = 0; k < kBlock<V>; ++k) {
    store_vector<V>(group + k * kLanes<V>, values[k] + broadcast<V>(ScalarOf<V>(0)));
  }
}

/// Stores to[p * stride + k] = group[k][p] + 0, rounded to S.
template <typename V, typename S>
SIMDBEZIER_INLINE void store_block(const ScalarOf<V>* group, S* to, std::ptrdiff_t stride) {
  constexpr bool kWide = sizeof(ScalarOf<V>) == sizeof(double); // store_transposed() adds 0
  V values[kBlock<V>];
  for (std::size_t k = 0; k < kBlock<V>; ++k) {
    values[k] = load_vector<V>(group + k * kLanes<V>);
    values[k] = kWide ? values[k] : values[k] + broadcast<V>(ScalarOf<V>(0));
  }
  if constexpr (kWide) {
    store_transposed(values, to, stride);
  } else {
    store_values_across<kBlock<V>>(values, to, stride);
  }
}

/// Returns how many values are moved in blocks: in whole groups of packed nets, all except a few.
template <typename V, typename S>
SIMDBEZIER_INLINE std::size_t values_in_blocks(const detail::NetView<S>& nets, std::size_t count) {
  if constexpr ((kBlock<V>) != 0) {
    return nets.packed && count == kLanes<V> ? values_of(nets) / kBlock<V> * kBlock<V> : 0;
  } else {
    return 0;
  }
}

/// Replaces every component P of every point by change(P, w), where w is the point's weight.
template <typename V, typename Change>
SIMDBEZIER_INLINE void for_weighted(ScalarOf<V>* group, std::size_t points, std::size_t channels,
                                    const Change& change) {
  for (std::size_t k = 0; k < points; ++k) {
    ScalarOf<V>* const point = lanes_of<V>(group, k * channels);
    const V w = value_of<V>(point, channels - 1);
    for (std::size_t c = 0; c + 1 < channels; ++c) {
      put_value<V>(point, c, change(value_of<V>(point, c), w));
    }
  }
}

/// Puts w P in place of P.
template <typename V>
SIMDBEZIER_INLINE void weigh(ScalarOf<V>* group, std::size_t points, std::size_t channels) {
  for_weighted<V>(group, points, channels, [](V p, V w) SIMDBEZIER_INLINE_LAMBDA { return p * w; });
}
/// Puts P in place of w P.
template <typename V>
SIMDBEZIER_INLINE void project(ScalarOf<V>* group, std::size_t points, std::size_t channels) {
  for_weighted<V>(group, points, channels,
                  [](V p, V w) SIMDBEZIER_INLINE_LAMBDA { return divide(p, w); });
}

/// Reads patches [first, first + count), count <= lanes. Lanes without a patch repeat the last one.
/// Adding +0 turns -0 into +0, so that edges that differ only in the sign of a zero stay equal.
template <typename V, typename S>
SIMDBEZIER_INLINE void read_group(const detail::NetView<const S>& nets, std::size_t first,
                                  std::size_t count, ScalarOf<V>* group) {
  using T = ScalarOf<V>;
  const std::size_t done = values_in_blocks<V>(nets, count);
  if constexpr ((kBlock<V>) != 0) {
    for (std::size_t k = 0; k < done; k += kBlock<V>) {
      load_block<V>(net_at(nets, first) + k, nets.patch_stride, lanes_of<V>(group, k));
    }
  }
  for (std::size_t p = 0; done < values_of(nets) && p < kLanes<V>; ++p) {
    for_each_value(nets, first + (p < count ? p : count - 1), done,
                   [&](const S* value, std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
                     group[k * kLanes<V> + p] = static_cast<T>(*value) + T(0);
                   });
  }
}

/// This is read_group(), but in homogeneous coordinates.
template <typename V, typename S>
SIMDBEZIER_INLINE void gather_group(const detail::NetView<const S>& nets, std::size_t first,
                                    std::size_t count, ScalarOf<V>* group) {
  read_group<V>(nets, first, count, group);
  if (nets.weights == Weights::cartesian) {
    weigh<V>(group, nets.order_u * nets.order_v, nets.channels);
  }
}

/// Writes a group back to memory; `group` is used up.
template <typename V, typename S>
SIMDBEZIER_INLINE void scatter_group(ScalarOf<V>* group, const detail::NetView<S>& nets,
                                     std::size_t first, std::size_t count) {
  if (nets.weights == Weights::cartesian) {
    project<V>(group, nets.order_u * nets.order_v, nets.channels);
  }
  const std::size_t done = values_in_blocks<V>(nets, count);
  if constexpr ((kBlock<V>) != 0) {
    for (std::size_t k = 0; k < done; k += kBlock<V>) {
      store_block<V>(lanes_of<V>(group, k), net_at(nets, first) + k, nets.patch_stride);
    }
  }
  for (std::size_t p = 0; p < count; ++p) {
    for_each_value(nets, first + p, done, [&](S* value, std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
      *value = static_cast<S>(group[k * kLanes<V> + p]) + S(0);
    });
  }
}

SIMDBEZIER_INLINE std::ptrdiff_t steps(std::size_t k, std::ptrdiff_t stride) {
  return static_cast<std::ptrdiff_t>(k) * stride;
}

/// Replaces a point of a result, a mean of columns x rows points of the input, if these are one.
template <typename S>
SIMDBEZIER_PART void restore_point(const detail::NetView<const S>& in, const S* from,
                                   std::size_t columns, std::size_t rows, std::ptrdiff_t stride,
                                   S* to) {
  const bool cartesian = in.weights == Weights::cartesian;
  if (columns * rows == 1) {
    for (std::size_t c = 0; cartesian && c < in.channels; ++c) {
      to[steps(c, stride)] = from[steps(c, in.component_stride)] + S(0);
    }
    return;
  }
  double point[detail::kMostChannels];
  const auto at = [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    return from + steps(k / columns, in.row_stride) + steps(k % columns, in.point_stride);
  };
  if (detail::are_one_point<S>(at, columns * rows, in.components, in.component_stride, in.weights,
                               point)) {
    const double weight = cartesian ? 1 : static_cast<double>(to[steps(in.components, stride)]);
    for (std::size_t c = 0; c < in.components; ++c) {
      to[steps(c, stride)] = static_cast<S>(point[c] * weight) + S(0);
    }
  }
}

/// Makes points that are means of one point that point again, in rational nets: see Support.
template <typename S>
SIMDBEZIER_INLINE void
restore_points(const detail::NetView<const S>& in, const detail::NetView<S>& out, std::size_t first,
               std::size_t count, const detail::Support& u, const detail::Support& v) {
  if (in.weights == Weights::none) {
    return;
  }
  for (std::size_t p = first; p < first + count; ++p) {
    for (std::size_t j = 0; j < out.order_v; ++j) {
      for (std::size_t i = 0; i < out.order_u; ++i) {
        if (u.first[i] <= u.last[i] && v.first[j] <= v.last[j]) {
          restore_point(in,
                        net_at(in, p) + steps(v.first[j], in.row_stride) +
                            steps(u.first[i], in.point_stride),
                        u.last[i] - u.first[i] + std::size_t{1},
                        v.last[j] - v.first[j] + std::size_t{1}, out.component_stride,
                        net_at(out, p) + steps(j, out.row_stride) + steps(i, out.point_stride));
        }
      }
    }
  }
}

/// Calls body(first, count) for every group of patches [begin, end).
template <typename V, typename Body>
SIMDBEZIER_INLINE void for_groups(std::size_t begin, std::size_t end, Body body) {
  for (std::size_t at = begin; at < end; at += kLanes<V>) {
    body(at, end - at < kLanes<V> ? end - at : kLanes<V>);
  }
}

/// One direction of a net in scratch: `lines` runs of degree + 1 elements, which are `block` values
/// each, everything side by side. u: lines are rows, elements points; v: one line of rows.
struct Axis {
  std::size_t order;
  std::size_t lines;
  std::size_t block;
};
SIMDBEZIER_INLINE Axis axis_u(std::size_t order_u, std::size_t order_v, std::size_t channels) {
  return {order_u, order_v, channels};
}
SIMDBEZIER_INLINE Axis axis_v(std::size_t order_u, std::size_t order_v, std::size_t channels) {
  return {order_v, 1, order_u * channels};
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
