// One sample of a bicubic patch by de Casteljau's algorithm: u on the four rows, then v. Grids and
// scattered samples share it. It is in the including object's own namespace, which no two objects
// share.
#pragma once

#include <cmath>

#include "bench/baselines/cubic.hpp"
#include "bench/subjects/job.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

/// Writes the position at (u, v) of the patch with the control points net[j][i][xyz].
template <typename T>
[[gnu::always_inline]] inline void write_position(const T* net, T u, T v, T* __restrict position) {
  for (int c = 0; c < 3; ++c) {
    const T* const b = net + c;
    T row[4];
    T unused;
    for (int j = 0; j < 4; ++j) {
      row[j] = cubic(u, b[12 * j], b[12 * j + 3], b[12 * j + 6], b[12 * j + 9], unused);
    }
    position[c] = cubic(v, row[0], row[1], row[2], row[3], unused);
  }
}

/// Writes the position and, as kGroups says, the normal to `second`, or du to `second` and dv to
/// `third`. Both tangents take a second pass in v: one over the points on the rows, which gives the
/// position and dv, and one over the rows' own last differences, which gives du.
template <OutputGroups kGroups, typename T>
[[gnu::always_inline]] inline void
write_position_and_tangents(const T* net, T u, T v, T* __restrict position, T* __restrict second,
                            T* __restrict third) {
  T du[3]; // thirds of the derivatives
  T dv[3];
  for (int c = 0; c < 3; ++c) {
    const T* const b = net + c;
    T row[4];
    T row_du[4];
    T unused;
    for (int j = 0; j < 4; ++j) {
      row[j] = cubic(u, b[12 * j], b[12 * j + 3], b[12 * j + 6], b[12 * j + 9], row_du[j]);
    }
    position[c] = cubic(v, row[0], row[1], row[2], row[3], dv[c]);
    du[c] = cubic(v, row_du[0], row_du[1], row_du[2], row_du[3], unused);
  }
  if constexpr (kGroups == OutputGroups::position_normal) {
    // The direction does not depend on the factor 3.
    const T x = du[1] * dv[2] - du[2] * dv[1];
    const T y = du[2] * dv[0] - du[0] * dv[2];
    const T z = du[0] * dv[1] - du[1] * dv[0];
    const T scale = 1 / std::sqrt(x * x + y * y + z * z);
    second[0] = x * scale;
    second[1] = y * scale;
    second[2] = z * scale;
  } else {
    for (int c = 0; c < 3; ++c) {
      second[c] = 3 * du[c];
      third[c] = 3 * dv[c];
    }
  }
}

} // namespace
} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
