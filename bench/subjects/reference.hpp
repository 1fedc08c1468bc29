// The independent reference: a plain Bernstein sum in double, one sample at a time.
#pragma once

#include <cstdint>
#include <string>

#include "bench/subjects/job.hpp"

namespace simdbezier_bench {

// These are checks against wrong results, with room for the power basis' poor rounding; accuracy
// itself is measured by the tests. Nets are control points [patch][j][i][xyz], rational ones
// [xyzw]. Every check returns an empty string, or one line that names the first sample in error.

/// Compares sample `index` of `results` with the patch `net` at (u, v). `patch` and `sample` are
/// for the message.
template <typename T>
std::string check_sample(const Results<T>& results, std::size_t index, const T* net, double u,
                         double v, std::size_t patch, std::size_t sample, BatchShape shape = {});

/// Overwrites samples [first, last), so that what an earlier row left there cannot pass for a
/// result.
template <typename T>
void poison(const Results<T>& results, std::size_t first, std::size_t last);

/// How many patches of a grid are checked: all of a few, otherwise 64 that include both ends.
bool is_checked(std::size_t patch, std::size_t patches);

/// Checks all samples of these patches of a grid; the job says which shape the nets have.
template <typename T>
void poison_grid(const GridJob<T>& job);
template <typename T>
std::string check_grid(const GridJob<T>& job, const T* nets);

/// Checks some 4000 scattered samples, spread evenly; all samples are poisoned before.
template <typename T>
void poison_scattered(const ScatteredJob<T>& job);
template <typename T>
std::string check_scattered(const ScatteredJob<T>& job, const T* nets);

} // namespace simdbezier_bench
