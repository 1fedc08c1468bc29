// This is what a good engineer writes in a day: power-basis coefficients computed beforehand, plain
// loops over a run-time n, restrict pointers, `omp simd`, the best flags, SoA planes. It has no
// error bound, no exact corners and no equal bits.
//
// The order of loops is the fastest of those that were tried: rows with lanes = u, or all samples
// of a patch where rows are short.
#include "bench/baselines/baselines.hpp"
#include "bench/baselines/power_basis_rows.hpp"
#include "bench/baselines/power_basis_samples.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

/// The number of columns from which g++ 12 takes the row loop's bound: it keeps what it can of them
/// in registers from row to row, and with room for more columns it keeps less.
constexpr std::size_t kUsual = 64;

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
