// One cubic by de Casteljau's algorithm, with what its last steps say about the derivatives. It is
// in the including object's own namespace, which no two objects share.
#pragma once

// g++ 12 does not vectorise a loop over samples; clang has to be told not to.
#if defined(__clang__)
#define BENCH_PER_SAMPLE _Pragma("clang loop vectorize(disable)")
#else
#define BENCH_PER_SAMPLE
#endif

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

template <typename T>
[[gnu::always_inline]] inline T interpolate(T t, T a, T b) {
  return a + t * (b - a);
}

/// Returns the value at t; `slope` receives a third of the derivative.
template <typename T>
[[gnu::always_inline]] inline T cubic(T t, T b0, T b1, T b2, T b3, T& slope) {
  const T b01 = interpolate(t, b0, b1);
  const T b12 = interpolate(t, b1, b2);
  const T b23 = interpolate(t, b2, b3);
  const T b012 = interpolate(t, b01, b12);
  const T b123 = interpolate(t, b12, b23);
  slope = b123 - b012;
  return b012 + t * slope;
}

/// Like cubic(); `curvature` receives a sixth of the second derivative.
template <typename T>
[[gnu::always_inline]] inline T cubic2(T t, T b0, T b1, T b2, T b3, T& slope, T& curvature) {
  const T b01 = interpolate(t, b0, b1);
  const T b12 = interpolate(t, b1, b2);
  const T b23 = interpolate(t, b2, b3);
  const T first = b12 - b01;
  const T second = b23 - b12;
  const T b012 = b01 + t * first;
  const T b123 = b12 + t * second;
  curvature = second - first;
  slope = b123 - b012;
  return b012 + t * slope;
}

} // namespace
} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
