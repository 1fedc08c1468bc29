// Points between the ends of edges that one or two bicubic patches have, with merged normals: lanes
// are points. A grid of one row or column takes two to three times as long for the few samples of a
// side, because it prepares tiles and rows that would serve many. The operations of a sample are
// those of the grids, and so are its bits.
//
// A call takes many edges, so that the processor goes on with the next one while roots and
// quotients of the last one are on their way. Normals of both patches meet in registers.
#pragma once

#include <algorithm>

#include "kernels/drain/drain_kernel.hpp"
#include "kernels/poly/bicubic.hpp"
#include "kernels/poly/normal_lanes.hpp"
#include "src/tables/mesh_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// R registers of parameters on a side v = const (kAlongU) or u = const.
template <bool kAlongU, std::size_t R, typename V>
struct SidePoints {
  using T = ScalarOf<V>;

  V along[R];
  V across; ///< -1/2 or 1/2, in all lanes

  SIMDBEZIER_PART SidePoints(const V (&parameters)[R], V of_side) : across(of_side) {
    std::copy_n(parameters, R, along);
  }

  /// Finds component `at` of the positions, and of the derivatives along the side.
  SIMDBEZIER_PART void positions(const Component<T>& c, std::size_t at, std::size_t edge,
                                 V (&values)[R][3], V (&slopes)[R][3]) const {
    V k[kOrder];
    edge_cubic(c, edge, k);
    for (std::size_t r = 0; r < R; ++r) {
      values[r][at] = row_value(k, RowPoint<V>(along[r]), slopes[r][at]);
      if (c.origins != nullptr) [[unlikely]] {
        values[r][at] = values[r][at] + broadcast<V>(c.origin()[detail::kEdgeOriginsAt + edge]);
      }
    }
  }
  /// Finds component `at` of the derivatives across the side, which its control points do not
  /// determine.
  SIMDBEZIER_PART void slopes_across(const Component<T>& c, std::size_t at,
                                     V (&slopes)[R][3]) const {
    if constexpr (kAlongU) {
      V q[R][kOrder];
      for (std::size_t l = 0; l < kOrder; ++l) {
        V k[kOrder];
        matrix_column(c, l, k);
        for (std::size_t r = 0; r < R; ++r) {
          q[r][l] = horner(k, along[r]);
        }
      }
      for (std::size_t r = 0; r < R; ++r) {
        slopes[r][at] = row_slope(q[r], RowPoint<V>(across));
      }
    } else {
      V q[kOrder];
      column_slopes(c, q);
      for (std::size_t r = 0; r < R; ++r) {
        slopes[r][at] = row_value(q, RowPoint<V>(along[r]));
      }
    }
  }

private:
  /// Finds the u derivative's polynomial in Y, on one column for all lanes.
  SIMDBEZIER_PART void column_slopes(const Component<T>& c, V dq[kOrder]) const {
    V k[kOrder];
    if constexpr (kHasFours<V>) { // all four powers of Y at once
      load_fours(c.matrix, k);
      split_groups<4>(horner_slope(k, across), dq);
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

/// Computes one patch's positions and normals at R registers of points, of which the first `count`
/// lanes each are wanted.
template <bool kAlongU, std::size_t R, typename V>
SIMDBEZIER_PART void side_registers(const detail::EdgeTask<ScalarOf<V>>& task,
                                    const detail::EdgeTask<ScalarOf<V>>& shared_task,
                                    const typename detail::EdgeJob<ScalarOf<V>>::Member& member,
                                    const V (&along_side)[R], std::size_t count, V (&p)[R][3],
                                    V (&n)[R][3]) {
  using T = ScalarOf<V>;
  static_assert(detail::kEdgeV0 == 0 && detail::kEdgeV1 == 1 && detail::kEdgeU0 == 2);
  const bool far = member.side % 2 != 0;
  const SidePoints<kAlongU, R, V> points(along_side, broadcast<V>(far ? T(0.5) : T(-0.5)));
  V along[R][3];
  V across[R][3];
  Component<T> component(task, member.patch, 0);
  for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
    points.positions(component, c, member.side, p, along);
    points.slopes_across(component, c, across);
  }
  if (!task.out[output_index(Output::normal)].wanted()) {
    return;
  }
  const V floor = broadcast<V>(task.normal_floor[member.patch]);
  V squared[R];
  for (std::size_t r = 0; r < R; ++r) {
    squared[r] = kAlongU ? cross_product(along[r], across[r], n[r])
                         : cross_product(across[r], along[r], n[r]);
  }
  for (std::size_t r = 0; r < R; ++r) {
    normalise(n[r], squared[r]);
  }
  for (std::size_t r = 0; r < R; ++r) {
    if (!all_of<V>(squared[r] > floor)) [[unlikely]] {
      V again[3] = {n[r][0], n[r][1], n[r][2]};
      resolve_side(shared_task, member.patch, count, kAlongU ? points.along[r] : points.across,
                   kAlongU ? points.across : points.along[r], squared[r], again);
      for (std::size_t c = 0; c < 3; ++c) {
        n[r][c] = again[c];
      }
    }
  }
}

/// Turns sums of unit normals into their directions. A single term stays as it is, and so does the
/// first one where the sum is too short. The operations are those of finish_sums() in
/// src/mesh/vertices/waiting_vertices.hpp, which merges the other vertices' normals.
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

/// Computes R registers of an edge's points, the first `count` lanes each: the points from first[r]
/// on.
template <std::size_t R, typename T>
SIMDBEZIER_PART void
edge_registers(const detail::EdgeTask<T>& task, const detail::EdgeTask<T>& shared_task,
               const detail::EdgeJob<T>& job, const std::size_t (&first)[R], std::size_t count) {
  using V = vec<T>;
  const detail::Planes<T>& positions = task.out[output_index(Output::position)];
  const detail::Planes<T>& normals = task.out[output_index(Output::normal)];
  V first_normal[R][3];
  V sum[R][3];
  for (std::size_t m = 0; m < job.members; ++m) {
    const auto& member = job.member[m];
    V along_side[R];
    for (std::size_t r = 0; r < R; ++r) { // no -0
      along_side[r] = load_vector<V>(job.along + first[r]) * broadcast<V>(member.direction) +
                      broadcast<V>(T(0));
    }
    V p[R][3];
    V n[R][3];
    if (member.side < detail::kEdgeU0) {
      side_registers<true, R>(task, shared_task, member, along_side, count, p, n);
    } else {
      side_registers<false, R>(task, shared_task, member, along_side, count, p, n);
    }
    for (std::size_t r = 0; r < R; ++r) {
      if (m == 0 && positions.wanted()) {
        put_points(positions, job.place + first[r], task.step, count, p[r]);
      }
      for (std::size_t c = 0; c < 3 && normals.wanted(); ++c) { // else n is nothing
        n[r][c] = broadcast<V>(member.sign) * n[r][c];
        first_normal[r][c] = m == 0 ? n[r][c] : first_normal[r][c];
        sum[r][c] = m == 0 ? n[r][c] : sum[r][c] + n[r][c];
      }
    }
  }
  if (normals.wanted()) {
    for (std::size_t r = 0; r < R; ++r) {
      finish_sum(job.members, first_normal[r], sum[r]);
      put_points(normals, job.place + first[r], task.step, count, sum[r]);
    }
  }
}

/// Two registers at once, so that roots and quotients of one go on beside those of the other. The
/// last register ends with the last point: some points are computed twice instead of stored one by
/// one.
template <typename T>
SIMDBEZIER_PART void edge_points(const detail::EdgeTask<T>& task,
                                 const detail::EdgeTask<T>& shared_task,
                                 const detail::EdgeJob<T>& job) {
  constexpr std::size_t kL = kLanes<vec<T>>;
  const std::size_t count = std::min(job.points, kL);
  const std::size_t last = job.points - count;
  for (std::size_t first = 0; first < job.points; first += 2 * kL) {
    if (job.points - first > kL) {
      edge_registers<2>(task, shared_task, job, {first, std::min(first + kL, last)}, count);
    } else {
      edge_registers<1>(task, shared_task, job, {std::min(first, last)}, count);
    }
  }
}

template <typename T>
SIMDBEZIER_KERNEL void edge_kernel(detail::EdgeTask<T>& shared_task) {
  shared_task.executed = Isa::SIMDBEZIER_ISA;
  const detail::EdgeTask<T> task = shared_task;
  for (std::size_t k = 0; k < task.count; ++k) {
    edge_points(task, shared_task, task.jobs[k]);
    drain_some(task.drain, 6 * task.jobs[k].points);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
