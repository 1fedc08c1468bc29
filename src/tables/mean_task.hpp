// The contract between the base code and the kernel that makes Bézier control points of a spline's.
#pragma once

#include <cstddef>

namespace simdbezier::detail {

/// Values of one line as means of those at the same place in others:
///
///     out[k] = (sum_j factors[j] lines[j][k]) / divisor + 0
///
/// Products and sums are rounded one by one: terms that mirror each other are added first, from the
/// outermost ones inwards, so that reversed lines with reversed factors give the same bits. Values
/// that are equal in all lines are copied.
struct MeanTask {
  const double* const* lines; ///< as many as there are terms
  const double* factors;
  std::size_t terms; ///< 1 to kMostOrder; a single one is copied
  double divisor;
  double* out; ///< none of the lines
  std::size_t values;
};

using MeanKernel = void (*)(const MeanTask& task);

} // namespace simdbezier::detail
