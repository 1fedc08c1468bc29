// Means of lines: the sums behind Bézier extraction, in double whatever the points are.
#pragma once

#include "kernels/simd/transpose.hpp"
#include "src/tables/mean_task.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns the mean of values [at, at + lanes of V). Nothing is fused; see MeanTask. `kTerms` is
/// their number where that is known, and 0 otherwise.
template <typename V, std::size_t kTerms>
SIMDBEZIER_INLINE V mean_at(const detail::MeanTask& task, std::size_t at) {
  const std::size_t terms = kTerms == 0 ? task.terms : kTerms;
  const V first = load_vector<V>(task.lines[0] + at);
  // Comparisons are false for nan on every instruction set.
  MaskOf<V> same = V(0.0) <= V(0.0);
  V sum(0.0);
  for (std::size_t k = 0; 2 * k < terms; ++k) {
    const std::size_t other = terms - 1 - k;
    const V a = load_vector<V>(task.lines[k] + at);
    V pair = V(task.factors[k]) * a;
    same = same & (a == first);
    if (other != k) {
      const V b = load_vector<V>(task.lines[other] + at);
      pair = pair + V(task.factors[other]) * b;
      same = same & (b == first);
    }
    sum = k == 0 ? pair : sum + pair;
  }
  if (task.divisor != 1) {
    sum = divide(sum, V(task.divisor));
  }
  return select_where<V>(same, first, sum) + V(0.0);
}

template <std::size_t kTerms>
void mean_line(const detail::MeanTask& task) {
  std::size_t at = 0;
  for (; at + kWideLanes <= task.values; at += kWideLanes) {
    store_vector<Wide>(task.out + at, mean_at<Wide, kTerms>(task, at));
  }
  for (; at < task.values; ++at) {
    task.out[at] = mean_at<double, kTerms>(task, at);
  }
}

/// Degrees up to 3 have up to 4 terms, and then the loop over them is unrolled.
inline void mean_kernel(const detail::MeanTask& task) {
  switch (task.terms) {
  case 1:
    return mean_line<1>(task);
  case 2:
    return mean_line<2>(task);
  case 3:
    return mean_line<3>(task);
  case 4:
    return mean_line<4>(task);
  default:
    return mean_line<0>(task);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
