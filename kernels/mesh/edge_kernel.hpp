// Points between the ends of edges that one or two bicubic patches have, with merged normals: lanes
// are points. A grid of one row or column takes two to three times as long for the few samples of a
// side, because it prepares tiles and rows that would serve many. The operations of a sample are
// those of the grids, and so are its bits.
//
// A call takes many edges, so that the processor goes on with the next one while roots and
// quotients of the last one are on their way. Normals of both patches meet in registers.
#pragma once

#include "kernels/drain/drain_kernel.hpp"
#include "kernels/poly/bicubic.hpp"
#include "kernels/poly/normal_lanes.hpp"
#include "src/tables/mesh_table.hpp"

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

  /// Returns one component's position, and finds the derivative along the side.
  SIMDBEZIER_PART V position(const Component<T>& c, std::size_t edge, V& slope) const {
    V k[kOrder];
    edge_cubic(c, edge, k);
    const V value = row_value(k, point, slope);
    if (c.origins != nullptr) [[unlikely]] {
      return value + broadcast<V>(c.origin()[detail::kEdgeOriginsAt + edge]);
    }
    return value;
  }
  /// Returns the derivative across the side, which its control points do not determine.
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
  /// Finds the u derivative's polynomial in Y, on one column for all lanes.
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

/// Looks again at the uncertain normals of a register.
template <typename V>
SIMDBEZIER_RARE void resolve_side(const detail::EdgeTask<ScalarOf<V>>& task, std::size_t patch,
                                  std::size_t count, V x, V y, V squared, V n[3]) {
  using T = ScalarOf<V>;
  alignas(64) T values[3][kLanes<V>];
  detail::SampleTask<T> own = task;
  for (std::size_t c = 0; c < 3; ++c) {
    store_vector(values[c], n[c]);
    own.out[output_index(Output::normal)].component[c] = values[c];
  }
  resolve_normals(own, patch, UncertainNormals{0, kLanes<V>, count, 1, 0, 0, 1}, x, y, squared,
                  broadcast<V>(task.normal_floor[patch]));
  for (std::size_t c = 0; c < 3; ++c) {
    n[c] = load_vector<V>(values[c]);
  }
}

/// Computes one patch's positions and normals at a register of points, of which `count` are wanted.
template <bool kAlongU, typename V>
SIMDBEZIER_PART void side_register(const detail::EdgeTask<ScalarOf<V>>& task,
                                   const detail::EdgeTask<ScalarOf<V>>& shared_task,
                                   const typename detail::EdgeJob<ScalarOf<V>>::Member& member,
                                   V along_side, std::size_t count, V p[3], V n[3]) {
  using T = ScalarOf<V>;
  static_assert(detail::kEdgeV0 == 0 && detail::kEdgeV1 == 1 && detail::kEdgeU0 == 2);
  const bool far = member.side % 2 != 0;
  const SidePoints<kAlongU, V> points(along_side, broadcast<V>(far ? T(0.5) : T(-0.5)));
  V along[3];
  V across[3];
  Component<T> component(task, member.patch, 0);
  for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
    p[c] = points.position(component, member.side, along[c]);
    across[c] = points.slope_across(component);
  }
  if (!task.out[output_index(Output::normal)].wanted()) {
    return;
  }
  const V squared = kAlongU ? cross_product(along, across, n) : cross_product(across, along, n);
  normalise(n, squared);
  if (!all_of<V>(squared > broadcast<V>(task.normal_floor[member.patch]))) [[unlikely]] {
    V again[3] = {n[0], n[1], n[2]};
    resolve_side(shared_task, member.patch, count, kAlongU ? points.along : points.across,
                 kAlongU ? points.across : points.along, squared, again);
    for (std::size_t c = 0; c < 3; ++c) {
      n[c] = again[c];
    }
  }
}

/// Turns sums of unit normals into their directions. A single term stays as it is, and so does the
/// first one where the sum is too short.
template <typename V>
SIMDBEZIER_INLINE void finish_sum(std::size_t terms, const V first[3], V sum[3]) {
  using T = ScalarOf<V>;
  const V one = broadcast<V>(T(1));
  const T least = detail::kLeastSum<T> * static_cast<T>(terms);
  const T limit = terms > 1 ? least * least : static_cast<T>(__builtin_inf());
  const V square = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
  const V zero = square - square; // squares of sums of unit vectors are finite
  const V kept = select_where<V>(square >= broadcast<V>(limit), zero, zero + one);
  const V inverse = divide(one - kept, square_root(square + kept));
  for (std::size_t c = 0; c < 3; ++c) {
    sum[c] = sum[c] * inverse + kept * first[c] + broadcast<V>(T(0)); // never -0
  }
}

/// Writes the first `count` lanes to consecutive places.
template <typename V>
SIMDBEZIER_INLINE void put_points(const detail::Planes<ScalarOf<V>>& planes, std::size_t place,
                                  std::size_t step, std::size_t count, const V values[3]) {
  using T = ScalarOf<V>;
  for (std::size_t c = 0; c < 3; ++c) {
    T* const to = planes.component[c] + place * step;
    if (step != 1) {
      alignas(64) T lanes[kLanes<V>];
      store_vector(lanes, values[c]);
      for (std::size_t k = 0; k < count; ++k) {
        to[k * step] = lanes[k];
      }
    } else if (count == kLanes<V>) {
      store_vector(to, values[c]);
    } else {
      store_first(to, values[c], count);
    }
  }
}

/// Computes points [first, first + count) of an edge, a register of them at most.
template <typename T>
SIMDBEZIER_PART void
edge_register(const detail::EdgeTask<T>& task, const detail::EdgeTask<T>& shared_task,
              const detail::EdgeJob<T>& job, std::size_t first, std::size_t count) {
  using V = vec<T>;
  const detail::Planes<T>& positions = task.out[output_index(Output::position)];
  const detail::Planes<T>& normals = task.out[output_index(Output::normal)];
  const V along = load_vector<V>(job.along + first);
  V first_normal[3];
  V sum[3];
  for (std::size_t m = 0; m < job.members; ++m) {
    const auto& member = job.member[m];
    const V along_side = along * broadcast<V>(member.direction) + broadcast<V>(T(0)); // no -0
    V p[3];
    V n[3];
    if (member.side < detail::kEdgeU0) {
      side_register<true>(task, shared_task, member, along_side, count, p, n);
    } else {
      side_register<false>(task, shared_task, member, along_side, count, p, n);
    }
    if (m == 0 && positions.wanted()) {
      put_points(positions, job.place + first, task.step, count, p);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      n[c] = broadcast<V>(member.sign) * n[c];
      first_normal[c] = m == 0 ? n[c] : first_normal[c];
      sum[c] = m == 0 ? n[c] : sum[c] + n[c];
    }
  }
  if (normals.wanted()) {
    finish_sum(job.members, first_normal, sum);
    put_points(normals, job.place + first, task.step, count, sum);
  }
}

template <typename T>
SIMDBEZIER_KERNEL void edge_kernel(detail::EdgeTask<T>& shared_task) {
  constexpr std::size_t kL = kLanes<vec<T>>;
  shared_task.executed = Isa::SIMDBEZIER_ISA;
  // A copy, because stores through vector types might change anything that others can see.
  const detail::EdgeTask<T> task = shared_task;
  for (std::size_t k = 0; k < task.count; ++k) {
    const detail::EdgeJob<T>& job = task.jobs[k];
    for (std::size_t first = 0; first < job.points; first += kL) {
      const std::size_t left = job.points - first;
      edge_register(task, shared_task, job, first, left < kL ? left : kL);
    }
    drain_some(task.drain, 6 * job.points);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
