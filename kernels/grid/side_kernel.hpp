// Points between the ends of one side of a bicubic patch, with normals: lanes are points. A grid of
// one row or column takes two to three times as long for these few samples, because it prepares
// tiles and rows that would serve many. The operations of a sample are those of the grids, and so
// are its bits.
#pragma once

#include "kernels/poly/bicubic.hpp"
#include "kernels/poly/normal_lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A register of parameters on a side v = const (kAlongU) or u = const.
template <bool kAlongU, typename V>
struct SidePoints {
  using T = ScalarOf<V>;

  V along;
  V across; ///< -1/2 or 1/2, in all lanes
  RowPoint<V> point;
  RowPoint<V> end;

  SIMDBEZIER_PART SidePoints(V parameters, V of_side)
      : along(parameters), across(of_side), point(parameters), end(of_side) {}

  /// One component's position, and the derivative along the side.
  SIMDBEZIER_PART V position(const Component<T>& c, std::size_t edge, V& slope) const {
    V k[kOrder];
    edge_cubic(c, edge, k);
    const V value = row_value(k, point, slope);
    if (c.origins != nullptr) [[unlikely]] {
      return value + broadcast<V>(c.origin()[detail::kEdgeOriginsAt + edge]);
    }
    return value;
  }
  /// The derivative across the side, which its control points do not determine.
  SIMDBEZIER_PART V slope_across(const Component<T>& c) const {
    V q[kOrder];
    if constexpr (kAlongU) {
      for (std::size_t l = 0; l < kOrder; ++l) {
        V k[kOrder];
        matrix_column(c, l, k);
        q[l] = horner(k, along);
      }
      return row_slope(q, end);
    } else {
      column_slopes(c, q);
      return row_value(q, point);
    }
  }

private:
  /// The u derivative's polynomial in Y, on one column for all lanes.
  SIMDBEZIER_PART void column_slopes(const Component<T>& c, V dq[kOrder]) const {
    V k[kOrder];
    if constexpr (kHasFours<V>) { // all four powers of Y at once
      load_fours(c.matrix, k);
      split_fours(horner_slope(k, across), dq);
    } else {
      for (std::size_t l = 0; l < kOrder; ++l) {
        matrix_column(c, l, k);
        dq[l] = horner_slope(k, across);
      }
    }
  }
};

/// Points [first, first + count), a register of them at most.
template <bool kAlongU, typename T>
SIMDBEZIER_PART void side_register(const detail::SideTask<T>& task,
                                   const detail::SideTask<T>& shared_task, std::size_t first,
                                   std::size_t count) {
  using V = vec<T>;
  const auto store = [&](const detail::Planes<T>& planes, std::size_t c, V value)
                         SIMDBEZIER_INLINE_LAMBDA {
                           T* const to = planes.component[c] + first;
                           if (count == kLanes<V>) {
                             store_vector(to, value);
                           } else {
                             store_first(to, value, count);
                           }
                         };
  const detail::Planes<T>& positions = task.out[detail::kPositionGroup];
  const detail::Planes<T>& normals = task.out[detail::kNormalGroup];
  static_assert(detail::kEdgeV0 == 0 && detail::kEdgeV1 == 1 && detail::kEdgeU0 == 2);
  const bool far = task.edge % 2 != 0;
  const SidePoints<kAlongU, V> points(load_vector<V>(task.along + first),
                                      broadcast<V>(far ? T(0.5) : T(-0.5)));
  V along[3];
  V across[3];
  Component<T> component(task, 0, 0);
  for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
    const V p = points.position(component, task.edge, along[c]);
    if (positions.wanted()) {
      store(positions, c, p);
    }
    across[c] = points.slope_across(component);
  }
  if (!normals.wanted()) {
    return;
  }
  V n[3];
  const V squared = kAlongU ? cross_product(along, across, n) : cross_product(across, along, n);
  normalise(n, squared);
  for (std::size_t c = 0; c < 3; ++c) {
    store(normals, c, n[c]);
  }
  const V floor = broadcast<V>(task.normal_floor[0]);
  if (!all_of<V>(squared > floor)) [[unlikely]] {
    const Suspects suspects{0, kLanes<V>, count, 1, first, 0, 1};
    resolve_normals(shared_task, 0, suspects, kAlongU ? points.along : points.across,
                    kAlongU ? points.across : points.along, squared, floor);
  }
}

template <typename T>
SIMDBEZIER_KERNEL void side_kernel(detail::SideTask<T>& shared_task) {
  constexpr std::size_t kL = kLanes<vec<T>>;
  shared_task.executed = Isa::SIMDBEZIER_ISA;
  // A copy, because stores through vector types might change anything that others can see.
  const detail::SideTask<T> task = shared_task;
  const bool along_u = task.edge < detail::kEdgeU0;
  for (std::size_t first = 0; first < task.points; first += kL) {
    const std::size_t left = task.points - first;
    const std::size_t count = left < kL ? left : kL;
    if (along_u) {
      side_register<true>(task, shared_task, first, count);
    } else {
      side_register<false>(task, shared_task, first, count);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
