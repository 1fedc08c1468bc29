// Parameters of scattered samples as the formulas take them: half-centred, X = u - 1/2.
#pragma once

#include "kernels/simd/vector.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::ScatteredTask;

/// The half-centred form of a parameter as it was given. It is exact where the parameter is
/// centred, and rounded once where it is not: one of shift and scale leaves values as they are, so
/// that one operation does.
template <typename V>
SIMDBEZIER_PART V half_centred(const ScatteredTask<ScalarOf<V>>& task, V given) {
  return madd(given, broadcast<V>(task.scale), broadcast<V>(-task.shift));
}

/// This is half_centred(), but nan where the parameter is not finite.
template <typename T>
SIMDBEZIER_PART T finite_half_centred(const ScatteredTask<T>& task, T given) {
  return given - given == T(0) ? half_centred(task, given) : static_cast<T>(__builtin_nan(""));
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
