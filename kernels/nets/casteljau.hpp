// De Casteljau's algorithm on groups of nets: cuts and pieces.
#pragma once

#include "kernels/nets/net_group.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns (1-t) a + t b. It is not fused, unlike everything that evaluates: a sum of two rounded
/// products is commutative, so that reversing the net only exchanges its terms; and it is the same
/// on all instruction sets. Equal points stay as they are, which (1-t) a + t a does not promise: a
/// collapsed edge must stay collapsed.
template <typename V>
SIMDBEZIER_INLINE V between(V a, V b, V complement, V t) {
  const V left = complement * a;
  const V right = t * b;
  return select_where<V>(a == b, a, left + right);
}

/// A parameter in every lane.
template <typename V>
struct Lever {
  SIMDBEZIER_INLINE explicit Lever(const detail::Weighting<ScalarOf<V>>& w)
      : t(broadcast<V>(w.t)), complement(broadcast<V>(w.complement)) {}
  SIMDBEZIER_INLINE V operator()(V a, V b) const { return between<V>(a, b, complement, t); }
  V t;
  V complement;
};

/// The parameter 1/2 in fewer operations, for values that do not overflow when doubled.
template <typename V>
struct Middle {
  SIMDBEZIER_INLINE V operator()(V a, V b) const { return half * (a + b); }
  V half = broadcast<V>(ScalarOf<V>(0.5));
};

/// Runs one level: the first `count` elements of a line become the points between them and their
/// successors.
template <typename V, typename At>
SIMDBEZIER_INLINE void one_level(ScalarOf<V>* line, std::size_t count, std::size_t block,
                                 const At& at) {
  const std::size_t values = count * block;
  for (std::size_t k = 0; k < values; ++k) {
    const V a = value_of<V>(line, k);
    const V b = value_of<V>(line, k + block);
    put_value<V>(line, k, at(a, b));
  }
}

template <typename V>
SIMDBEZIER_INLINE void copy_group(const ScalarOf<V>* from, std::size_t values, ScalarOf<V>* to) {
  for (std::size_t k = 0; k < values; ++k) {
    put_value<V>(to, k, value_of<V>(from, k));
  }
}

/// Cuts all lines: `net` becomes the part behind the parameter, `low` gets the one before it.
template <typename V, typename At>
SIMDBEZIER_INLINE void split_axis(ScalarOf<V>* net, ScalarOf<V>* low, const Axis& axis,
                                  const At& at) {
  const std::size_t length = axis.order * axis.block;
  for (std::size_t line = 0; line < axis.lines; ++line) {
    ScalarOf<V>* const points = lanes_of<V>(net, line * length);
    ScalarOf<V>* const first = lanes_of<V>(low, line * length);
    copy_group<V>(points, axis.block, first);
    for (std::size_t r = 1; r < axis.order; ++r) {
      one_level<V>(points, axis.order - r, axis.block, at);
      copy_group<V>(points, axis.block, lanes_of<V>(first, r * axis.block));
    }
  }
}

/// Finds the blossoms of one line, with `outer` inserted before `inner`: element k of the result
/// has `inner` k times. `line` is used up; temp has room for another.
template <typename V, typename Take>
SIMDBEZIER_INLINE void blossoms(ScalarOf<V>* line, ScalarOf<V>* temp, std::size_t order,
                                std::size_t block, const Lever<V>& outer, const Lever<V>& inner,
                                Take take) {
  for (std::size_t k = order; k-- > 0;) { // degree - k insertions of `outer` have been made
    copy_group<V>(line, (k + 1) * block, temp);
    for (std::size_t level = k; level > 0; --level) {
      one_level<V>(temp, level, block, inner);
    }
    take(k, temp);
    if (k > 0) {
      one_level<V>(line, k, block, outer);
    }
  }
}

/// Replaces all lines by their piece from one parameter to the other. Which of the two is inserted
/// first makes a difference in the last bits, so the result is the mean of both orders. line has
/// room for two lines, temp for one.
template <typename V>
SIMDBEZIER_INLINE void segment_axis(ScalarOf<V>* net, ScalarOf<V>* line, ScalarOf<V>* temp,
                                    const Axis& axis, const Lever<V>& from, const Lever<V>& to) {
  using T = ScalarOf<V>;
  const std::size_t length = axis.order * axis.block;
  const V half = broadcast<V>(T(0.5));
  for (std::size_t k = 0; k < axis.lines; ++k) {
    T* const points = lanes_of<V>(net, k * length);
    copy_group<V>(points, length, line);
    T* const other = lanes_of<V>(line, length);
    copy_group<V>(points, length, other);
    blossoms<V>(line, temp, axis.order, axis.block, from, to,
                [&](std::size_t i, const T* point) SIMDBEZIER_INLINE_LAMBDA {
                  copy_group<V>(point, axis.block, lanes_of<V>(points, i * axis.block));
                });
    blossoms<V>(other, temp, axis.order, axis.block, to, from,
                [&](std::size_t i, const T* point) SIMDBEZIER_INLINE_LAMBDA {
                  T* const mean = lanes_of<V>(points, (axis.order - 1 - i) * axis.block);
                  for (std::size_t c = 0; c < axis.block; ++c) {
                    const V both =
                        between<V>(value_of<V>(mean, c), value_of<V>(point, c), half, half);
                    put_value<V>(mean, c, both);
                  }
                });
  }
}

template <typename T>
Isa split_kernel(const detail::SplitTask<T>& task, std::size_t begin, std::size_t end,
                 unsigned char* scratch) {
  using V = vec<T>;
  const detail::NetView<const T>& in = task.in;
  const std::size_t values = values_of(in);
  T* const whole = reinterpret_cast<T*>(scratch);
  T* const low_u = lanes_of<V>(whole, values);
  T* const low_v = lanes_of<V>(low_u, values);
  const Axis u = axis_u(in.order_u, in.order_v, in.channels);
  const Axis v = axis_v(in.order_u, in.order_v, in.channels);
  const Lever<V> at_u(task.u);
  const Lever<V> at_v(task.v);
  for_groups<V>(begin, end, [&](std::size_t first, std::size_t count) {
    const auto deliver = [&](T* group, std::size_t half_u, std::size_t half_v) {
      const detail::NetView<T>& out = task.out[2 * half_v + half_u];
      scatter_group<V>(group, out, first, count);
      restore_points(in, out, first, count, task.support_u[half_u], task.support_v[half_v]);
    };
    const auto finish = [&](T* group, std::size_t half_u) {
      if (task.in_v) {
        split_axis<V>(group, low_v, v, at_v);
        deliver(low_v, half_u, 0);
      }
      deliver(group, half_u, task.in_v ? 1 : 0);
    };
    gather_group<V>(in, first, count, whole);
    if (task.in_u) {
      split_axis<V>(whole, low_u, u, at_u);
      finish(low_u, 0);
    }
    finish(whole, task.in_u ? 1 : 0);
  });
  return Isa::SIMDBEZIER_ISA;
}

template <typename T>
Isa segment_kernel(const detail::SegmentTask<T>& task, std::size_t begin, std::size_t end,
                   unsigned char* scratch) {
  using V = vec<T>;
  const detail::NetView<const T>& in = task.in;
  const std::size_t values = values_of(in);
  T* const net = reinterpret_cast<T*>(scratch);
  T* const lines = lanes_of<V>(net, values); // two of them, a net long at most
  T* const temp = lanes_of<V>(lines, 2 * values);
  const Axis u = axis_u(in.order_u, in.order_v, in.channels);
  const Axis v = axis_v(in.order_u, in.order_v, in.channels);
  for_groups<V>(begin, end, [&](std::size_t first, std::size_t count) {
    gather_group<V>(in, first, count, net);
    if (task.in_u) {
      segment_axis<V>(net, lines, temp, u, Lever<V>(task.u[0]), Lever<V>(task.u[1]));
    }
    if (task.in_v) {
      segment_axis<V>(net, lines, temp, v, Lever<V>(task.v[0]), Lever<V>(task.v[1]));
    }
    scatter_group<V>(net, task.out, first, count);
    restore_points(in, task.out, first, count, task.support_u, task.support_v);
  });
  return Isa::SIMDBEZIER_ISA;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
