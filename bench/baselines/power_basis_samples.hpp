// Patches in the power basis, all samples of a patch in one loop, lanes = samples: for grids that
// are narrower than a short vector.
#pragma once

#include <cstddef>

#include "bench/baselines/baselines.hpp"
#include "bench/baselines/power_basis.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

constexpr std::size_t kNarrow = 8; ///< grids of fewer columns are narrow

template <typename T>
struct Component {
  T position, du, dv;
};

/// Evaluates one component at one sample; a points to the component's 4 values at power 0 of v.
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
  const OutputPlanes<T> out(planes, first);
#pragma omp simd
  for (std::size_t k = 0; k < samples; ++k) {
    const auto [px, ux, vx] = component(a, u[k], v[k]);
    const auto [py, uy, vy] = component(a + 4, u[k], v[k]);
    const auto [pz, uz, vz] = component(a + 8, u[k], v[k]);
    out.x[k] = px;
    out.y[k] = py;
    out.z[k] = pz;
    if constexpr (kGroups != OutputGroups::position) {
      out.template store_tangents<kGroups>(k, ux, uy, uz, vx, vy, vz);
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

} // namespace
} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
