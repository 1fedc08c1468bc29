// The independent reference: a plain Bernstein sum in double, one sample at a time.
#pragma once

#include <string>

#include "bench/grid_job.hpp"

namespace simdbezier_bench {

/// Overwrites the samples that check_grid() will look at, so that what an earlier row left behind
/// cannot pass for a result. `interleaved`: groups are x y z triples instead of planes.
template <typename T>
void poison_grid(const GridJob<T>& job, bool interleaved);

/// Compares a job's output with the reference at all samples of up to 64 patches, spread evenly.
/// `nets`: control points [patch][j][i][xyz] of the job's patches.
/// Returns an empty string, or one line that names the first sample in error. This is a check
/// against wrong results, with room for the power basis' poor rounding; accuracy itself is measured
/// by the tests.
template <typename T>
std::string check_grid(const GridJob<T>& job, const T* nets, bool interleaved);

} // namespace simdbezier_bench
