// Scalar de Casteljau on batches of cubic curves, AoS in and out: the arithmetic of
// de_casteljau.cpp.
#include "bench/baselines/baselines.hpp"
#include "bench/baselines/cubic.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

template <typename T>
void positions(const CurveJob<T>& job, const T* __restrict points, const T* __restrict t,
               T* __restrict position) {
  for (std::size_t curve = 0; curve < job.curves; ++curve) {
    const T* const b = points + 12 * curve;
    BENCH_PER_SAMPLE
    for (std::size_t i = 0; i < job.n; ++i) {
      for (int c = 0; c < 3; ++c) {
        T unused;
        position[c] = cubic(t[i], b[c], b[3 + c], b[6 + c], b[9 + c], unused);
      }
      position += 3;
    }
  }
}

} // namespace

void de_casteljau_curves(const CurveJob<float>& job);
void de_casteljau_curves(const CurveJob<double>& job);
void de_casteljau_curves(const CurveJob<float>& job) {
  positions(job, job.points, job.t, job.out.component[0]);
}
void de_casteljau_curves(const CurveJob<double>& job) {
  positions(job, job.points, job.t, job.out.component[0]);
}

} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
