// Patches in the power basis, row by row, lanes = u: the polynomials in u of each power of v are
// evaluated at all u at once, then the rows are swept. Two rows at a time share the loads of the
// column polynomials where there are many of them.
#pragma once

#include <cstddef>

#include "bench/baselines/power_basis.hpp"
#include "bench/subjects/job.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

constexpr std::size_t kPowers = 12; ///< 4 powers of v with 3 components each: 3 * power + c

/// Cubics in v, one per value of u: the position's and, where they are asked for, du's and duu's.
template <OutputGroups kGroups, std::size_t kMost, typename T>
struct Columns {
  alignas(64) T position[kPowers][kMost];
  alignas(64) T du[kPowers][kMost];
  alignas(64) T duu[kGroups == OutputGroups::second_derivatives ? kPowers : 1][kMost];
};

template <OutputGroups kGroups, std::size_t kMost, typename T>
[[gnu::always_inline]] inline void form_columns(const T* __restrict a,
                                                const T* __restrict parameters, std::size_t n,
                                                Columns<kGroups, kMost, T>& columns) {
  for (std::size_t power = 0; power < kPowers; power += 3, a += 12) {
    T* __restrict const x = columns.position[power];
    T* __restrict const y = columns.position[power + 1];
    T* __restrict const z = columns.position[power + 2];
    T* __restrict const x_u = columns.du[power];
    T* __restrict const y_u = columns.du[power + 1];
    T* __restrict const z_u = columns.du[power + 2];
    T* __restrict const x_uu = columns.duu[power];
    T* __restrict const y_uu = columns.duu[power + 1];
    T* __restrict const z_uu = columns.duu[power + 2];
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) {
      const T u = parameters[i];
      x[i] = cubic(u, a[0], a[1], a[2], a[3]);
      y[i] = cubic(u, a[4], a[5], a[6], a[7]);
      z[i] = cubic(u, a[8], a[9], a[10], a[11]);
      if constexpr (kGroups != OutputGroups::position) {
        x_u[i] = cubic_slope(u, a[1], a[2], a[3]);
        y_u[i] = cubic_slope(u, a[5], a[6], a[7]);
        z_u[i] = cubic_slope(u, a[9], a[10], a[11]);
      }
      if constexpr (kGroups == OutputGroups::second_derivatives) {
        x_uu[i] = cubic_curvature(u, a[2], a[3]);
        y_uu[i] = cubic_curvature(u, a[6], a[7]);
        z_uu[i] = cubic_curvature(u, a[10], a[11]);
      }
    }
  }
}

template <OutputGroups kGroups, int kRows, std::size_t kMost, typename T>
[[gnu::always_inline]] inline void sweep_rows(const Columns<kGroups, kMost, T>& columns,
                                              const T* __restrict v, std::size_t n,
                                              T* const* planes, std::size_t first) {
  const auto& p = columns.position;
  const auto& q = columns.du;
  const OutputPlanes<T> out(planes, first);
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
#pragma GCC unroll 2
    for (std::size_t row = 0; row < kRows; ++row) {
      const T t = v[row];
      const std::size_t k = row * n + i;
      out.x[k] = cubic(t, p[0][i], p[3][i], p[6][i], p[9][i]);
      out.y[k] = cubic(t, p[1][i], p[4][i], p[7][i], p[10][i]);
      out.z[k] = cubic(t, p[2][i], p[5][i], p[8][i], p[11][i]);
      if constexpr (kGroups != OutputGroups::position) {
        const T ux = cubic(t, q[0][i], q[3][i], q[6][i], q[9][i]);
        const T uy = cubic(t, q[1][i], q[4][i], q[7][i], q[10][i]);
        const T uz = cubic(t, q[2][i], q[5][i], q[8][i], q[11][i]);
        const T vx = cubic_slope(t, p[3][i], p[6][i], p[9][i]);
        const T vy = cubic_slope(t, p[4][i], p[7][i], p[10][i]);
        const T vz = cubic_slope(t, p[5][i], p[8][i], p[11][i]);
        out.template store_tangents<kGroups>(k, ux, uy, uz, vx, vy, vz);
      }
    }
  }
}

// The second derivatives are swept in a loop of their own, which leaves more registers to each.
template <OutputGroups kGroups, int kRows, std::size_t kMost, typename T>
[[gnu::always_inline]] inline void sweep_second(const Columns<kGroups, kMost, T>& columns,
                                                const T* __restrict v, std::size_t n,
                                                T* const* planes, std::size_t first) {
  for (std::size_t c = 0; c < 3; ++c) {
    const T* __restrict const p2 = columns.position[6 + c];
    const T* __restrict const p3 = columns.position[9 + c];
    const T* __restrict const q1 = columns.du[3 + c];
    const T* __restrict const q2 = columns.du[6 + c];
    const T* __restrict const q3 = columns.du[9 + c];
    const auto& r = columns.duu;
    T* __restrict const duu = planes[9 + c] + first;
    T* __restrict const duv = planes[12 + c] + first;
    T* __restrict const dvv = planes[15 + c] + first;
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) {
#pragma GCC unroll 2
      for (std::size_t row = 0; row < kRows; ++row) {
        const T t = v[row];
        const std::size_t k = row * n + i;
        duu[k] = cubic(t, r[c][i], r[3 + c][i], r[6 + c][i], r[9 + c][i]);
        duv[k] = cubic_slope(t, q1[i], q2[i], q3[i]);
        dvv[k] = cubic_curvature(t, p2[i], p3[i]);
      }
    }
  }
}

template <OutputGroups kGroups, int kRows, std::size_t kMost, typename T>
[[gnu::always_inline]] inline void sweep(const Columns<kGroups, kMost, T>& columns,
                                         const T* __restrict v, std::size_t n, T* const* planes,
                                         std::size_t first) {
  sweep_rows<kGroups, kRows>(columns, v, n, planes, first);
  if constexpr (kGroups == OutputGroups::second_derivatives) {
    sweep_second<kGroups, kRows>(columns, v, n, planes, first);
  }
}

template <OutputGroups kGroups, std::size_t kMost, typename T>
void run_rows(const GridJob<T>& job) {
  constexpr int kRows = kGroups == OutputGroups::position ? 1 : 2;
  const std::size_t n = job.nu;
  const std::size_t rows = job.nv;
  const T* const v = job.v;
  std::size_t k = 0;
  Columns<kGroups, kMost, T> columns;
  for (std::size_t patch = 0; patch < job.patches; ++patch) {
    form_columns<kGroups>(job.input + 48 * patch, job.u, n, columns);
    std::size_t iv = 0;
    for (; iv + kRows <= rows; iv += kRows, k += kRows * n) {
      sweep<kGroups, kRows>(columns, v + iv, n, job.out.component, k);
    }
    for (; iv < rows; ++iv, k += n) {
      sweep<kGroups, 1>(columns, v + iv, n, job.out.component, k);
    }
  }
}

} // namespace
} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
