// Scalar de Casteljau on scattered samples, AoS in and out: the arithmetic of de_casteljau.cpp.
#include "bench/baselines/baselines.hpp"

#include <cmath>

#include "bench/baselines/cubic.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

template <typename T>
void positions(const ScatteredJob<T>& job, const T* __restrict nets, T* __restrict position) {
  const std::uint32_t* __restrict const patch = job.patch;
  BENCH_PER_SAMPLE
  for (std::size_t k = 0; k < job.count; ++k) {
    const T* const net = nets + std::size_t{48} * patch[k];
    const T u = job.u[k];
    const T v = job.v[k];
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

template <OutputGroups kGroups, typename T>
void positions_and_tangents(const ScatteredJob<T>& job, const T* __restrict nets,
                            T* __restrict position, T* __restrict second, T* __restrict third) {
  const std::uint32_t* __restrict const patch = job.patch;
  BENCH_PER_SAMPLE
  for (std::size_t k = 0; k < job.count; ++k) {
    const T* const net = nets + std::size_t{48} * patch[k];
    const T u = job.u[k];
    const T v = job.v[k];
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

template <typename T>
void dispatch(const ScatteredJob<T>& job) {
  T* const* const p = job.out.component;
  if (job.out.groups == OutputGroups::position) {
    positions(job, job.nets, p[0]);
  } else if (job.out.groups == OutputGroups::position_normal) {
    positions_and_tangents<OutputGroups::position_normal>(job, job.nets, p[0], p[3], p[6]);
  } else {
    positions_and_tangents<OutputGroups::position_derivatives>(job, job.nets, p[0], p[3], p[6]);
  }
}

} // namespace

void de_casteljau_scattered(const ScatteredJob<float>& job);
void de_casteljau_scattered(const ScatteredJob<double>& job);
void de_casteljau_scattered(const ScatteredJob<float>& job) { dispatch(job); }
void de_casteljau_scattered(const ScatteredJob<double>& job) { dispatch(job); }

} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
