// One cubic in the power basis, its derivatives, and the normal of two tangents.
// They are in the including object's own namespace, which no two objects share.
#pragma once

#include <cmath>

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

} // namespace
} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
