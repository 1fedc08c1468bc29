// Patch data of the benchmarks: random smooth nets, the same on every machine and run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/subjects/job.hpp"

namespace simdbezier_bench {

constexpr std::size_t kValuesPerPatch = values_per_patch(BatchShape{}); ///< of a bicubic one

/// Makes nets [patch][j][i][xyz], or [xyzw]. A net is a unit parallelogram somewhere in a cube,
/// whose points are displaced by up to 0.3 of the distance between them, so that normals are
/// regular everywhere. Weights are from 1/2 to 2. A net depends on its index only, not on count.
template <typename T>
std::vector<T> random_nets(std::size_t count, BatchShape shape = {});

/// Power-basis coefficients of bicubic nets, [patch][power of v][xyz][power of u], formed in double
/// and rounded once.
template <typename T>
std::vector<T> power_basis(const std::vector<T>& nets);

/// Returns `count` values in [0, 1), another series for every seed.
std::vector<double> random_units(std::size_t count, std::uint64_t seed);

/// Returns the n values i / (n-1).
template <typename T>
std::vector<T> uniform_parameters(std::size_t n);

} // namespace simdbezier_bench
