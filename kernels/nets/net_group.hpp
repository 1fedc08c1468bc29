// Takes a group of control nets from memory to [value][lane], one patch a lane, and back.
#pragma once

#include "kernels/simd/squares.hpp"
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
  for (std::size_t p = 0; p < kLanes<V>; ++p) {
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
  if (nets.cartesian) {
    weigh<V>(group, nets.order_u * nets.order_v, nets.channels);
  }
}

/// Writes a group back to memory; `group` is used up.
template <typename V, typename S>
SIMDBEZIER_INLINE void scatter_group(ScalarOf<V>* group, const detail::NetView<S>& nets,
                                     std::size_t first, std::size_t count) {
  if (nets.cartesian) {
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

/// Finds the point of the input that point k of `order` is. Returns false where it is none of them.
SIMDBEZIER_INLINE bool kept_point(const detail::KeptPoints& kept, std::size_t k, std::size_t order,
                                  std::size_t order_in, std::size_t& source) {
  source = kept.all || k == 0 ? k : order_in - 1;
  return kept.all || (k == 0 && kept.first) || (k + 1 == order && kept.last);
}

SIMDBEZIER_INLINE std::ptrdiff_t steps(std::size_t k, std::ptrdiff_t stride) {
  return static_cast<std::ptrdiff_t>(k) * stride;
}

/// One edge of a net in memory.
template <typename S>
struct EdgeView {
  S* first;
  std::size_t order;
  std::ptrdiff_t stride;
};
/// Returns the edge in u (at v = 0 or 1), or in v.
template <typename S>
SIMDBEZIER_INLINE EdgeView<S> edge_of(const detail::NetView<S>& nets, std::size_t patch, bool in_u,
                                      bool last) {
  S* const net = net_at(nets, patch);
  return in_u ? EdgeView<S>{net + (last ? steps(nets.order_v - 1, nets.row_stride) : 0),
                            nets.order_u, nets.point_stride}
              : EdgeView<S>{net + (last ? steps(nets.order_u - 1, nets.point_stride) : 0),
                            nets.order_v, nets.row_stride};
}

/// Where all points of an edge of the input are equal, those of the result's edge are the same
/// point, whatever the weights.
template <typename S>
SIMDBEZIER_INLINE void restore_collapsed_edge(const detail::NetView<const S>& in,
                                              const detail::NetView<S>& out, std::size_t patch,
                                              bool in_u, bool last) {
  const EdgeView<const S> from = edge_of(in, patch, in_u, last);
  const EdgeView<S> to = edge_of(out, patch, in_u, last);
  for (std::size_t c = 0; c < in.components; ++c) {
    const S* const component = from.first + steps(c, in.component_stride);
    for (std::size_t k = 1; k < from.order; ++k) {
      if (component[steps(k, from.stride)] != component[0]) {
        return;
      }
    }
  }
  for (std::size_t k = 0; k < to.order; ++k) {
    for (std::size_t c = 0; c < in.components; ++c) {
      to.first[steps(k, to.stride) + steps(c, out.component_stride)] =
          from.first[steps(c, in.component_stride)] + S(0);
    }
  }
}

/// Repairs what the way through w P / w has done to cartesian nets: points that the operation has
/// not touched are copied, and collapsed edges made so again.
template <typename S>
SIMDBEZIER_INLINE void restore_points(const detail::NetView<const S>& in,
                                      const detail::NetView<S>& out, std::size_t first,
                                      std::size_t count, const detail::KeptPoints& kept_u,
                                      const detail::KeptPoints& kept_v) {
  if (!in.cartesian) {
    return;
  }
  for (std::size_t p = first; p < first + count; ++p) {
    for (std::size_t j = 0; j < out.order_v; ++j) {
      for (std::size_t i = 0; i < out.order_u; ++i) {
        std::size_t i_in = 0;
        std::size_t j_in = 0;
        if (!kept_point(kept_u, i, out.order_u, in.order_u, i_in) ||
            !kept_point(kept_v, j, out.order_v, in.order_v, j_in)) {
          continue;
        }
        const S* const from =
            net_at(in, p) + steps(j_in, in.row_stride) + steps(i_in, in.point_stride);
        S* const to = net_at(out, p) + steps(j, out.row_stride) + steps(i, out.point_stride);
        for (std::size_t c = 0; c < in.channels; ++c) {
          to[steps(c, out.component_stride)] = from[steps(c, in.component_stride)] + S(0);
        }
      }
    }
    for (const bool last : {false, true}) {
      if (kept_v.all || (last ? kept_v.last : kept_v.first)) {
        restore_collapsed_edge(in, out, p, true, last);
      }
      if (kept_u.all || (last ? kept_u.last : kept_u.first)) {
        restore_collapsed_edge(in, out, p, false, last);
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
