// Scalar de Casteljau, sample by sample, AoS in and out: u on the four rows, then v.
//
// Nothing is held back: one branch-free expression a sample, restrict pointers, each linear
// interpolation one subtraction and one fused multiply-add, so that all four floating-point pipes
// of a modern core are busy (90 of each for a position). What makes it scalar is its shape, and
// two flags that keep the compiler from turning it into something else (CMakeLists.txt).
#include "bench/baselines/baselines.hpp"

#include <cmath>

// g++ 12 leaves the loop over samples alone; clang must be told.
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

/// The value at t; `slope` receives a third of the derivative.
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

// The loops below hold the whole of a sample's arithmetic and take their pointers as parameters:
// split into further functions, the same code is a quarter slower with g++ 12.
template <typename T>
void positions(const GridJob<T>& job, const T* __restrict nets, const T* __restrict parameters,
               T* __restrict position) {
  const std::size_t n = job.n;
  for (std::size_t patch = 0; patch < job.patches; ++patch) {
    const T* const net = nets + 48 * patch;
    for (std::size_t iv = 0; iv < n; ++iv) {
      const T v = parameters[iv];
      BENCH_PER_SAMPLE
      for (std::size_t iu = 0; iu < n; ++iu) {
        const T u = parameters[iu];
        for (int c = 0; c < 3; ++c) {
          const T* const b = net + c;
          T row[4];
          T unused;
          for (int j = 0; j < 4; ++j) {
            row[j] = cubic(u, b[12 * j], b[12 * j + 3], b[12 * j + 6], b[12 * j + 9], unused);
          }
          position[c] = cubic(v, row[0], row[1], row[2], row[3], unused);
        }
        position += 3;
      }
    }
  }
}

// Both tangents take a second pass in v: one over the points on the rows, which gives the position
// and dv, and one over the rows' own last differences, which gives du.
template <OutputGroups kGroups, typename T>
void positions_and_tangents(const GridJob<T>& job, const T* __restrict nets,
                            const T* __restrict parameters, T* __restrict position,
                            T* __restrict second, T* __restrict third) {
  const std::size_t n = job.n;
  for (std::size_t patch = 0; patch < job.patches; ++patch) {
    const T* const net = nets + 48 * patch;
    for (std::size_t iv = 0; iv < n; ++iv) {
      const T v = parameters[iv];
      BENCH_PER_SAMPLE
      for (std::size_t iu = 0; iu < n; ++iu) {
        const T u = parameters[iu];
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
        position += 3;
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
          third += 3;
        }
        second += 3;
      }
    }
  }
}

template <typename T>
void dispatch(const GridJob<T>& job) {
  T* const* const p = job.planes;
  switch (job.groups) {
  case OutputGroups::position:
    return positions(job, job.input, job.parameters, p[0]);
  case OutputGroups::position_normal:
    return positions_and_tangents<OutputGroups::position_normal>(job, job.input, job.parameters,
                                                                 p[0], p[3], p[6]);
  case OutputGroups::position_derivatives:
    return positions_and_tangents<OutputGroups::position_derivatives>(
        job, job.input, job.parameters, p[0], p[3], p[6]);
  }
}

} // namespace

void de_casteljau(const GridJob<float>& job);
void de_casteljau(const GridJob<double>& job);
void de_casteljau(const GridJob<float>& job) { dispatch(job); }
void de_casteljau(const GridJob<double>& job) { dispatch(job); }

} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
