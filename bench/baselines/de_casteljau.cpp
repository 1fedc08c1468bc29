// Scalar de Casteljau, sample by sample, AoS in and out: u on the four rows, then v.
//
// Nothing is held back: a sample is one branch-free expression, pointers are restrict, and a linear
// interpolation is one subtraction and one fused multiply-add, so that all four floating-point
// pipes of a modern core are busy (90 of each for a position). Its shape makes it scalar.
#include "bench/baselines/baselines.hpp"
#include "bench/baselines/de_casteljau_sample.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

// Each kernel has its loops and the whole of a sample's arithmetic in it, and takes its pointers as
// parameters, because the same code in more functions is a quarter slower with g++ 12.
template <OutputGroups kGroups, typename T>
void run(const GridJob<T>& job, const T* __restrict nets, const T* __restrict us,
         const T* __restrict vs, T* __restrict position, T* __restrict second,
         T* __restrict third) {
  const std::size_t nu = job.nu;
  const std::size_t nv = job.nv;
  for (std::size_t patch = 0; patch < job.patches; ++patch) {
    const T* const net = nets + 48 * patch;
    for (std::size_t iv = 0; iv < nv; ++iv) {
      const T v = vs[iv];
      BENCH_PER_SAMPLE
      for (std::size_t iu = 0; iu < nu; ++iu) {
        const T u = us[iu];
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
  }
}

// Second derivatives come from the rows' values, last differences and second differences, each by a
// pass in v that keeps as many differences as are wanted. They have loops of their own, whose six
// outputs share one index: with it, g++ 12 makes more instructions of the loops above.
template <typename T>
void second_derivatives(const GridJob<T>& job, const T* __restrict nets, const T* __restrict us,
                        const T* __restrict vs, T* __restrict position, T* __restrict out_du,
                        T* __restrict out_dv, T* __restrict duu, T* __restrict duv,
                        T* __restrict dvv) {
  const std::size_t nu = job.nu;
  const std::size_t nv = job.nv;
  std::size_t k = 0;
  for (std::size_t patch = 0; patch < job.patches; ++patch) {
    const T* const net = nets + 48 * patch;
    for (std::size_t iv = 0; iv < nv; ++iv) {
      const T v = vs[iv];
      BENCH_PER_SAMPLE
      for (std::size_t iu = 0; iu < nu; ++iu) {
        const T u = us[iu];
        for (std::size_t c = 0; c < 3; ++c) {
          const T* const b = net + c;
          T row[4];
          T row_du[4];
          T row_duu[4];
          for (int j = 0; j < 4; ++j) {
            row[j] = cubic2(u, b[12 * j], b[12 * j + 3], b[12 * j + 6], b[12 * j + 9], row_du[j],
                            row_duu[j]);
          }
          T slope;
          T mixed;
          T curvature;
          T unused;
          position[k + c] = cubic2(v, row[0], row[1], row[2], row[3], slope, curvature);
          out_du[k + c] = 3 * cubic(v, row_du[0], row_du[1], row_du[2], row_du[3], mixed);
          out_dv[k + c] = 3 * slope;
          duu[k + c] = 6 * cubic(v, row_duu[0], row_duu[1], row_duu[2], row_duu[3], unused);
          duv[k + c] = 9 * mixed;
          dvv[k + c] = 6 * curvature;
        }
        k += 3;
      }
    }
  }
}

template <typename T>
void dispatch(const GridJob<T>& job) {
  T* const* const p = job.out.component;
  switch (job.out.groups) {
  case OutputGroups::position:
    return run<OutputGroups::position>(job, job.input, job.u, job.v, p[0], p[3], p[6]);
  case OutputGroups::position_normal:
    return run<OutputGroups::position_normal>(job, job.input, job.u, job.v, p[0], p[3], p[6]);
  case OutputGroups::position_derivatives:
    return run<OutputGroups::position_derivatives>(job, job.input, job.u, job.v, p[0], p[3], p[6]);
  case OutputGroups::second_derivatives:
    return second_derivatives(job, job.input, job.u, job.v, p[0], p[3], p[6], p[9], p[12], p[15]);
  case OutputGroups::curvature:
    return; // has no baseline: a row of that name fails its check
  }
}

} // namespace

void de_casteljau(const GridJob<float>& job);
void de_casteljau(const GridJob<double>& job);
void de_casteljau(const GridJob<float>& job) { dispatch(job); }
void de_casteljau(const GridJob<double>& job) { dispatch(job); }

} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
