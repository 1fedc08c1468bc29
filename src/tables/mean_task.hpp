// The contract between the base code and the kernels that make Bézier control points of a spline's.
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

/// One Bézier control point: (sum_j factors[j] d[first + j]) / divisor, j < terms.
struct SplineMean {
  std::size_t first;  ///< of the spline's points, which begin again after a period
  std::size_t factor; ///< where its factors begin
  std::size_t terms;  ///< 1 to degree + 1; a single factor is 1
  double divisor;     ///< 1, or what makes factors whole numbers
};

/// A point's number where points begin again after `period`, without a division for most.
constexpr std::size_t wrapped(std::size_t number, std::size_t period) noexcept {
  return number < period ? number : number % period;
}

/// A line of means, one behind the other, of the points of one row; each is one of MeanTask.
struct PointMeansTask {
  const SplineMean* means;
  std::size_t count;
  const double* factors; ///< of all of them
  const double* points;  ///< [point][channel], and kMeanSlack more readable values
  std::size_t period;
  std::size_t channels;
  double* out; ///< [mean][channel], and kMeanSlack more values, which are overwritten
};
/// A register of doubles, of which one value is wanted.
inline constexpr std::size_t kMeanSlack = 7;

struct MeanKernels {
  void (*lines)(const MeanTask& task);
  void (*points)(const PointMeansTask& task);
};

} // namespace simdbezier::detail
