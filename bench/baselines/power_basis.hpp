// One cubic in the power basis, its derivatives, the normal of two tangents, and the planes that
// results go to. They are in the including object's own namespace, which no two objects share.
#pragma once

#include <cmath>
#include <cstddef>

#include "bench/subjects/job.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

template <typename T>
[[gnu::always_inline]] inline T cubic(T t, T a0, T a1, T a2, T a3) {
  return ((a3 * t + a2) * t + a1) * t + a0;
}

template <typename T>
[[gnu::always_inline]] inline T cubic_slope(T t, T a1, T a2, T a3) {
  return (3 * a3 * t + 2 * a2) * t + a1;
}

template <typename T>
[[gnu::always_inline]] inline T cubic_curvature(T t, T a2, T a3) {
  return 6 * a3 * t + 2 * a2;
}

template <typename T>
struct Normal {
  T x, y, z;
};

template <typename T>
[[gnu::always_inline]] inline Normal<T> unit_normal(T ux, T uy, T uz, T vx, T vy, T vz) {
  const T x = uy * vz - uz * vy;
  const T y = uz * vx - ux * vz;
  const T z = ux * vy - uy * vx;
  const T scale = 1 / std::sqrt(x * x + y * y + z * z);
  return {x * scale, y * scale, z * scale};
}

/// The planes of the first three vectors, from one sample on.
template <typename T>
struct OutputPlanes {
  T* __restrict const x;
  T* __restrict const y;
  T* __restrict const z;
  T* __restrict const x2;
  T* __restrict const y2;
  T* __restrict const z2;
  T* __restrict const x3;
  T* __restrict const y3;
  T* __restrict const z3;

  [[gnu::always_inline]] OutputPlanes(T* const* planes, std::size_t first)
      : x(planes[0] + first), y(planes[1] + first), z(planes[2] + first), x2(planes[3] + first),
        y2(planes[4] + first), z2(planes[5] + first), x3(planes[6] + first), y3(planes[7] + first),
        z3(planes[8] + first) {}

  /// Stores the normal of sample k, or its tangents, as kGroups says.
  template <OutputGroups kGroups>
  [[gnu::always_inline]] void store_tangents(std::size_t k, T ux, T uy, T uz, T vx, T vy,
                                             T vz) const {
    if constexpr (kGroups == OutputGroups::position_normal) {
      const Normal<T> normal = unit_normal(ux, uy, uz, vx, vy, vz);
      x2[k] = normal.x;
      y2[k] = normal.y;
      z2[k] = normal.z;
    } else {
      x2[k] = ux;
      y2[k] = uy;
      z2[k] = uz;
      x3[k] = vx;
      y3[k] = vy;
      z3[k] = vz;
    }
  }
};

} // namespace
} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
