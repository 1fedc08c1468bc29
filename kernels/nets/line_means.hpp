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

/// Calls mean.operator()<kTerms>(): degrees up to 3 have up to 4 terms, and then the loop over them
/// is unrolled.
template <typename Mean>
SIMDBEZIER_INLINE void with_terms(std::size_t terms, const Mean& mean) {
  if (terms > 4) {
    return mean.template operator()<0>();
  }
  with_one_of<1, 2, 3, 4>(terms, mean);
}

inline void mean_lines(const detail::MeanTask& task) {
  with_terms(task.terms, [&]<std::size_t kTerms>() SIMDBEZIER_INLINE_LAMBDA {
    std::size_t at = 0;
    for (; at + kWideLanes <= task.values; at += kWideLanes) {
      store_vector<Wide>(task.out + at, mean_at<Wide, kTerms>(task, at));
    }
    for (; at < task.values; ++at) {
      task.out[at] = mean_at<double, kTerms>(task, at);
    }
  });
}

/// Points are few values, so that whole registers are written: the next point overwrites what is
/// too much.
inline void mean_points(const detail::PointMeansTask& task) {
  static_assert(kWideLanes <= detail::kMeanSlack + 1);
  double* out = task.out;
  for (std::size_t n = 0; n < task.count; ++n, out += task.channels) {
    const detail::SplineMean& mean = task.means[n];
    const double* points[detail::kMostOrder];
    for (std::size_t k = 0; k < mean.terms; ++k) {
      points[k] = task.points + detail::wrapped(mean.first + k, task.period) * task.channels;
    }
    const detail::MeanTask one{
        points, task.factors + mean.factor, mean.terms, mean.divisor, out, task.channels};
    with_terms(mean.terms, [&]<std::size_t kTerms>() SIMDBEZIER_INLINE_LAMBDA {
      for (std::size_t at = 0; at < task.channels; at += kWideLanes) {
        store_vector<Wide>(out + at, mean_at<Wide, kTerms>(one, at));
      }
    });
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
