// Scalar de Casteljau on scattered samples, AoS in and out, with the arithmetic of
// de_casteljau.cpp.
#include "bench/baselines/baselines.hpp"
#include "bench/baselines/de_casteljau_sample.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

// Each kernel takes its pointers as parameters, like those of de_casteljau.cpp.
template <OutputGroups kGroups, typename T>
void run(const ScatteredJob<T>& job, const T* __restrict nets, T* __restrict position,
         T* __restrict second, T* __restrict third) {
  const std::uint32_t* __restrict const patch = job.patch;
  BENCH_PER_SAMPLE
  for (std::size_t k = 0; k < job.count; ++k) {
    const T* const net = nets + std::size_t{48} * patch[k];
    const T u = job.u[k];
    const T v = job.v[k];
    if constexpr (kGroups == OutputGroups::position) {
      write_position(net, u, v, position);
    } else {
      write_position_and_tangents<kGroups>(net, u, v, position, second, third);
      second += 3;
      third += kGroups == OutputGroups::position_derivatives ? 3 : 0;
    }
    position += 3;
  }
}

template <typename T>
void dispatch(const ScatteredJob<T>& job) {
  T* const* const p = job.out.component;
  if (job.out.groups == OutputGroups::position) {
    run<OutputGroups::position>(job, job.nets, p[0], p[3], p[6]);
  } else if (job.out.groups == OutputGroups::position_normal) {
    run<OutputGroups::position_normal>(job, job.nets, p[0], p[3], p[6]);
  } else {
    run<OutputGroups::position_derivatives>(job, job.nets, p[0], p[3], p[6]);
  }
}

} // namespace

void de_casteljau_scattered(const ScatteredJob<float>& job);
void de_casteljau_scattered(const ScatteredJob<double>& job);
void de_casteljau_scattered(const ScatteredJob<float>& job) { dispatch(job); }
void de_casteljau_scattered(const ScatteredJob<double>& job) { dispatch(job); }

} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
