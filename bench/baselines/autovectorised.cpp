// What a good engineer writes in a day: power-basis coefficients computed beforehand, plain loops
// over a run-time n, restrict pointers, `omp simd`, the best flags, SoA planes. No error bound, no
// exact corners, no equal bits.
//
// Order of loops, the fastest of those tried: per patch, the polynomials in u of each power of v
// are evaluated at all u at once; then the rows are swept with lanes = u. Two rows at a time share
// the loads of the column polynomials where there are many of them. Grids narrower than a short
// vector run over all samples of a patch instead, lanes = samples.
#include "bench/baselines/baselines.hpp"

#include <cmath>

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

constexpr std::size_t kPowers = 12; ///< 4 powers of v, 3 components each: index 3 * power + c
constexpr std::size_t kNarrow = 8;
/// Columns that g++ 12 takes the row loop's bound from: it keeps what it can of them in registers
/// from row to row, and with room for more columns it keeps less.
constexpr std::size_t kUsual = 64;

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

template <OutputGroups kGroups, int kRows, std::size_t kMost, typename T>
[[gnu::always_inline]] inline void sweep_rows(const Columns<kGroups, kMost, T>& columns,
                                              const T* __restrict v, std::size_t n,
                                              T* const* planes, std::size_t first) {
  const auto& p = columns.position;
  const auto& q = columns.du;
  T* __restrict const x = planes[0] + first;
  T* __restrict const y = planes[1] + first;
  T* __restrict const z = planes[2] + first;
  T* __restrict const x2 = planes[3] + first;
  T* __restrict const y2 = planes[4] + first;
  T* __restrict const z2 = planes[5] + first;
  T* __restrict const x3 = planes[6] + first;
  T* __restrict const y3 = planes[7] + first;
  T* __restrict const z3 = planes[8] + first;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
#pragma GCC unroll 2
    for (std::size_t row = 0; row < kRows; ++row) {
      const T t = v[row];
      const std::size_t k = row * n + i;
      x[k] = cubic(t, p[0][i], p[3][i], p[6][i], p[9][i]);
      y[k] = cubic(t, p[1][i], p[4][i], p[7][i], p[10][i]);
      z[k] = cubic(t, p[2][i], p[5][i], p[8][i], p[11][i]);
      if constexpr (kGroups != OutputGroups::position) {
        const T ux = cubic(t, q[0][i], q[3][i], q[6][i], q[9][i]);
        const T uy = cubic(t, q[1][i], q[4][i], q[7][i], q[10][i]);
        const T uz = cubic(t, q[2][i], q[5][i], q[8][i], q[11][i]);
        const T vx = cubic_slope(t, p[3][i], p[6][i], p[9][i]);
        const T vy = cubic_slope(t, p[4][i], p[7][i], p[10][i]);
        const T vz = cubic_slope(t, p[5][i], p[8][i], p[11][i]);
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
    }
  }
}

// The second derivatives in a loop of their own, which leaves more registers to each.
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

template <typename T>
struct Component {
  T position, du, dv;
};

/// One component at one sample; a points to the component's 4 values at power 0 of v.
template <typename T>
[[gnu::always_inline]] inline Component<T> component(const T* __restrict a, T u, T v) {
  const T q0 = cubic(u, a[0], a[1], a[2], a[3]);
  const T q1 = cubic(u, a[12], a[13], a[14], a[15]);
  const T q2 = cubic(u, a[24], a[25], a[26], a[27]);
  const T q3 = cubic(u, a[36], a[37], a[38], a[39]);
  return {cubic(v, q0, q1, q2, q3),
          cubic(v, cubic_slope(u, a[1], a[2], a[3]), cubic_slope(u, a[13], a[14], a[15]),
                cubic_slope(u, a[25], a[26], a[27]), cubic_slope(u, a[37], a[38], a[39])),
          cubic_slope(v, q1, q2, q3)};
}

template <OutputGroups kGroups, typename T>
[[gnu::always_inline]] inline void evaluate_samples(const T* __restrict a, const T* __restrict u,
                                                    const T* __restrict v, std::size_t samples,
                                                    T* const* planes, std::size_t first) {
  T* __restrict const x = planes[0] + first;
  T* __restrict const y = planes[1] + first;
  T* __restrict const z = planes[2] + first;
  T* __restrict const x2 = planes[3] + first;
  T* __restrict const y2 = planes[4] + first;
  T* __restrict const z2 = planes[5] + first;
  T* __restrict const x3 = planes[6] + first;
  T* __restrict const y3 = planes[7] + first;
  T* __restrict const z3 = planes[8] + first;
#pragma omp simd
  for (std::size_t k = 0; k < samples; ++k) {
    const auto [px, ux, vx] = component(a, u[k], v[k]);
    const auto [py, uy, vy] = component(a + 4, u[k], v[k]);
    const auto [pz, uz, vz] = component(a + 8, u[k], v[k]);
    x[k] = px;
    y[k] = py;
    z[k] = pz;
    if constexpr (kGroups != OutputGroups::position) {
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
  }
}

template <typename T>
[[gnu::always_inline]] inline void second_samples(const T* __restrict a, const T* __restrict u,
                                                  const T* __restrict v, std::size_t samples,
                                                  T* const* planes, std::size_t first) {
  for (std::size_t c = 0; c < 3; ++c, a += 4) {
    T* __restrict const duu = planes[9 + c] + first;
    T* __restrict const duv = planes[12 + c] + first;
    T* __restrict const dvv = planes[15 + c] + first;
#pragma omp simd
    for (std::size_t k = 0; k < samples; ++k) {
      const T t = u[k];
      duu[k] = cubic(v[k], cubic_curvature(t, a[2], a[3]), cubic_curvature(t, a[14], a[15]),
                     cubic_curvature(t, a[26], a[27]), cubic_curvature(t, a[38], a[39]));
      duv[k] =
          cubic_slope(v[k], cubic_slope(t, a[13], a[14], a[15]),
                      cubic_slope(t, a[25], a[26], a[27]), cubic_slope(t, a[37], a[38], a[39]));
      dvv[k] = cubic_curvature(v[k], cubic(t, a[24], a[25], a[26], a[27]),
                               cubic(t, a[36], a[37], a[38], a[39]));
    }
  }
}

template <OutputGroups kGroups, typename T>
void run_narrow(const GridJob<T>& job) {
  const std::size_t samples = job.nu * job.nv;
  alignas(64) T u[kNarrow * kMaxGridSize];
  alignas(64) T v[kNarrow * kMaxGridSize];
  for (std::size_t k = 0; k < samples; ++k) {
    u[k] = job.u[k % job.nu];
    v[k] = job.v[k / job.nu];
  }
  for (std::size_t patch = 0; patch < job.patches; ++patch) {
    const T* const a = job.input + 48 * patch;
    evaluate_samples<kGroups>(a, u, v, samples, job.out.component, patch * samples);
    if constexpr (kGroups == OutputGroups::second_derivatives) {
      second_samples(a, u, v, samples, job.out.component, patch * samples);
    }
  }
}

template <OutputGroups kGroups, typename T>
void run(const GridJob<T>& job) {
  if (job.nu < kNarrow) {
    run_narrow<kGroups>(job);
  } else if (job.nu <= kUsual) {
    run_rows<kGroups, kUsual>(job);
  } else {
    run_rows<kGroups, kMaxGridSize>(job);
  }
}

template <typename T>
void dispatch(const GridJob<T>& job) {
  switch (job.out.groups) {
  case OutputGroups::position:
    return run<OutputGroups::position>(job);
  case OutputGroups::position_normal:
    return run<OutputGroups::position_normal>(job);
  case OutputGroups::position_derivatives:
    return run<OutputGroups::position_derivatives>(job);
  case OutputGroups::second_derivatives:
    return run<OutputGroups::second_derivatives>(job);
  case OutputGroups::curvature:
    return; // has no baseline: a row of that name fails its check
  }
}

} // namespace

void autovectorised(const GridJob<float>& job);
void autovectorised(const GridJob<double>& job);
void autovectorised(const GridJob<float>& job) { dispatch(job); }
void autovectorised(const GridJob<double>& job) { dispatch(job); }

} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
