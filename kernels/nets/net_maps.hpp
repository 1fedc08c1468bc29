// Linear maps of both directions of a net: degree elevation, derivatives, other bases. They run in
// double, whatever the nets are made of: sums of float nets are then nearly exact, and rounded
// once.
#pragma once

#include "kernels/nets/net_group.hpp"
#include "kernels/simd/transpose.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns one value of a row's image. `in` is the value's place in element 0, and elements are
/// `block` apart.
SIMDBEZIER_INLINE Wide mapped_value(const detail::LinearMap::Row& row, bool keeps_constants,
                                    const double* in, std::size_t block) {
  const detail::LinearMap::Pair& front = row.pair[0];
  const Wide first = value_of<Wide>(in, (front.entry_a != 0 ? front.a : front.b) * block);
  // These comparisons are false for nan on every instruction set; != is not in xsimd.
  MaskOf<Wide> same = Wide(0.0) <= Wide(0.0);
  Wide sum(0.0);
  for (std::size_t q = 0; q < row.pairs; ++q) {
    const detail::LinearMap::Pair& pair = row.pair[q];
    const Wide a = value_of<Wide>(in, pair.a * block);
    const Wide b = value_of<Wide>(in, pair.b * block);
    // This is not fused, so that the pair is commutative, and the same on all instruction sets.
    const Wide left = Wide(pair.entry_a) * a;
    const Wide right = Wide(pair.entry_b) * b;
    sum = sum + (left + right);
    if (pair.entry_a != 0) {
      same = same & (a == first);
    }
    if (pair.entry_b != 0) {
      same = same & (b == first);
    }
  }
  const Wide value = divide(sum * Wide(row.factor), Wide(row.divisor));
  return keeps_constants ? select_where<Wide>(same, first, value) : value;
}

/// Maps all lines from `in` to `out`.
SIMDBEZIER_INLINE void map_axis(const detail::LinearMap& map, const double* in, double* out,
                                const Axis& axis) {
  for (std::size_t line = 0; line < axis.lines; ++line) {
    const double* const from = in + line * axis.order * axis.block * kWideLanes;
    double* const to = out + line * map.rows * axis.block * kWideLanes;
    for (std::size_t r = 0; r < map.rows; ++r) {
      for (std::size_t c = 0; c < axis.block; ++c) {
        const Wide value =
            mapped_value(map.row[r], map.keeps_constants, from + c * kWideLanes, axis.block);
        put_value<Wide>(to, r * axis.block + c, value);
      }
    }
  }
}

template <typename T>
Isa map_kernel(const detail::MapTask<T>& task, std::size_t begin, std::size_t end,
               unsigned char* scratch) {
  const detail::NetView<const T>& in = task.in;
  const std::size_t order_u = in.order_u < task.out.order_u ? task.out.order_u : in.order_u;
  const std::size_t order_v = in.order_v < task.out.order_v ? task.out.order_v : in.order_v;
  const std::size_t most = order_u * order_v * in.channels;
  double* const buffers[3] = {reinterpret_cast<double*>(scratch),
                              reinterpret_cast<double*>(scratch) + most * kWideLanes,
                              reinterpret_cast<double*>(scratch) + 2 * most * kWideLanes};
  for_groups<Wide>(begin, end, [&](std::size_t first, std::size_t count) {
    double* net = buffers[0];
    gather_group<Wide>(in, first, count, net);
    if (!task.u->identity) {
      map_axis(*task.u, net, buffers[1], axis_u(in.order_u, in.order_v, in.channels));
      net = buffers[1];
    }
    if (!task.v->identity) {
      map_axis(*task.v, net, buffers[2], axis_v(task.out.order_u, in.order_v, in.channels));
      net = buffers[2];
    }
    scatter_group<Wide>(net, task.out, first, count);
    restore_points(in, task.out, first, count, task.support_u, task.support_v);
  });
  return Isa::SIMDBEZIER_ISA;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
