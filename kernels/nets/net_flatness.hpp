// The distance of a patch from the bilinear patch of its corners; docs/accuracy.md has the proof.
// Nothing is fused, so that the bound has the same bits on all instruction sets.
#pragma once

#include "kernels/nets/net_boxes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A group of nets around their first points.
template <typename V>
struct MovedNet {
  const ScalarOf<V>* group;
  std::size_t order_u;
  std::size_t order_v;
  std::size_t channels;
  std::size_t components;
  V extent; ///< max |Q| over all components

  SIMDBEZIER_INLINE V at(std::size_t j, std::size_t i, std::size_t c) const {
    return value_of<V>(group, (j * order_u + i) * channels + c);
  }
  /// Returns the corner (a, b) in (u, v).
  SIMDBEZIER_INLINE V corner(std::size_t a, std::size_t b, std::size_t c) const {
    return at(b * (order_v - 1), a * (order_u - 1), c);
  }
};

/// Holds k / n and (n - k) / n.
template <typename V>
SIMDBEZIER_INLINE Lever<V> share(std::size_t k, std::size_t n) {
  using T = ScalarOf<V>;
  const T whole = static_cast<T>(n);
  return Lever<V>({static_cast<T>(k) / whole, static_cast<T>(n - k) / whole});
}

/// Returns the squared distance of the control points from those of the bilinear patch, over
/// extent^2.
template <typename V>
SIMDBEZIER_INLINE V polynomial_distance(const MovedNet<V>& net) {
  using T = ScalarOf<V>;
  V worst = broadcast<V>(T(0));
  for (std::size_t j = 0; j < net.order_v; ++j) {
    const Lever<V> v = share<V>(j, net.order_v - 1);
    for (std::size_t i = 0; i < net.order_u; ++i) {
      const Lever<V> u = share<V>(i, net.order_u - 1);
      V squares = broadcast<V>(T(0));
      for (std::size_t c = 0; c < net.components; ++c) {
        const V left = between<V>(net.corner(0, 0, c), net.corner(0, 1, c), v.complement, v.t);
        const V right = between<V>(net.corner(1, 0, c), net.corner(1, 1, c), v.complement, v.t);
        const V bilinear = between<V>(left, right, u.complement, u.t);
        const V part = divide(net.at(j, i, c) - bilinear, net.extent);
        squares = squares + part * part;
      }
      worst = larger_of<V>(squares, worst);
    }
  }
  return worst;
}

/// Returns the squared length of N_kl / w_kl of docs/accuracy.md, over extent^2.
template <typename V>
SIMDBEZIER_INLINE V rational_control_distance(const MovedNet<V>& net, std::size_t k,
                                              std::size_t l) {
  using T = ScalarOf<V>;
  const Lever<V> u = share<V>(k, net.order_u);
  const Lever<V> v = share<V>(l, net.order_v);
  V weight[2][2];
  V sum = broadcast<V>(T(0));
  for (std::size_t b = 0; b < 2; ++b) {
    for (std::size_t a = 0; a < 2; ++a) {
      const bool exists = k >= a && k - a < net.order_u && l >= b && l - b < net.order_v;
      weight[b][a] = broadcast<V>(T(0));
      if (exists) {
        const V factor = (a == 1 ? u.t : u.complement) * (b == 1 ? v.t : v.complement);
        weight[b][a] = factor * net.at(l - b, k - a, net.components);
        sum = sum + weight[b][a];
      }
    }
  }
  V squares = broadcast<V>(T(0));
  for (std::size_t c = 0; c < net.components; ++c) {
    V difference = broadcast<V>(T(0));
    for (std::size_t b = 0; b < 2; ++b) {
      for (std::size_t a = 0; a < 2; ++a) {
        const bool exists = k >= a && k - a < net.order_u && l >= b && l - b < net.order_v;
        if (exists) {
          const V away = net.at(l - b, k - a, c) - net.corner(a, b, c);
          const V part = divide(weight[b][a], sum) * away;
          difference = difference + part;
        }
      }
    }
    const V part = divide(difference, net.extent);
    squares = squares + part * part;
  }
  return squares;
}

template <typename V>
SIMDBEZIER_INLINE V rational_distance(const MovedNet<V>& net) {
  V worst = broadcast<V>(ScalarOf<V>(0));
  for (std::size_t l = 0; l <= net.order_v; ++l) {
    for (std::size_t k = 0; k <= net.order_u; ++k) {
      worst = larger_of<V>(rational_control_distance<V>(net, k, l), worst);
    }
  }
  return worst;
}

/// Returns the bound for one group whose points are in `group`.
template <typename T>
SIMDBEZIER_INLINE vec<T> flatness_of(const detail::FlatnessTask<T>& task, bool rational, T* group) {
  using V = vec<T>;
  const detail::NetView<const T>& in = task.in;
  const std::size_t points = in.order_u * in.order_v;
  const V zero = broadcast<V>(T(0));
  V size = zero;
  V extent = zero;
  for (std::size_t c = 0; c < in.components; ++c) {
    const ValueRange<V> range = range_over<V>(group, points, in.channels, c);
    size = larger_of<V>(larger_of<V>(size_of<V>(range.low), size_of<V>(range.high)), size);
    const V origin = value_of<V>(group, c);
    for (std::size_t k = 0; k < points; ++k) {
      T* const point = lanes_of<V>(group, k * in.channels);
      const V moved = value_of<V>(point, c) - origin;
      extent = larger_of<V>(size_of<V>(moved), extent);
      put_value<V>(point, c, moved);
    }
  }
  const MovedNet<V> net{group, in.order_u, in.order_v, in.channels, in.components, extent};
  const V squares = rational ? rational_distance<V>(net) : polynomial_distance<V>(net);
  // The factor 1.0625 is for what the margin itself is rounded by, and for terms of higher order.
  constexpr T kSlack = T(1.0625) * kRoundoff<T>;
  const T roundings = (rational ? 40 : 16) * kSlack * task.root_components;
  const V length =
      square_root(squares) * broadcast<V>(1 + 32 * kRoundoff<T>) + broadcast<V>(roundings);
  const V denormals = broadcast<V>(T(16 * in.components) * kSmallest<T>);
  V bound = select_where<V>(extent > zero, length * extent + denormals, zero);
  MaskOf<V> safe = extent < broadcast<V>(kSafelyLarge<T>);
  if (rational) {
    const ValueRange<V> w = range_over<V>(group, points, in.channels, in.components);
    const MaskOf<V> not_light = w.low > broadcast<V>(kSafelySmall<T>);
    const MaskOf<V> not_heavy = w.high < broadcast<V>(kSafelyLarge<T>);
    safe = safe & not_light & not_heavy;
    if (in.weights != Weights::cartesian) {
      bound = bound + broadcast<V>(8 * kSlack * task.root_components) * size + denormals;
    }
  }
  const MaskOf<V> finite = bound < broadcast<V>(kInfinity<T>);
  return select_where<V>(safe & finite, bound, broadcast<V>(kInfinity<T>));
}

template <typename T>
Isa flatness_kernel(const detail::FlatnessTask<T>& task, std::size_t begin, std::size_t end,
                    unsigned char* scratch) {
  using V = vec<T>;
  T* const group = reinterpret_cast<T*>(scratch);
  const bool rational = task.in.channels > task.in.components;
  for_groups<V>(begin, end, [&](std::size_t first, std::size_t count) {
    gather_points<V>(task.in, rational, first, count, group);
    const V bound = flatness_of<T>(task, rational, group);
    alignas(64) T lanes[kLanes<V>];
    store_vector<V>(lanes, bound);
    for (std::size_t p = 0; p < count; ++p) {
      task.out[first + p] = lanes[p];
    }
  });
  return Isa::SIMDBEZIER_ISA;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
