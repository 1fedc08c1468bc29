// One sample of one patch, as the formulas say, in double.
#pragma once

#include "bench/subjects/job.hpp"

namespace simdbezier_bench {

struct Sample {
  double position[3] = {};
  double du[3] = {};
  double dv[3] = {};
  double duu[3] = {};
  double duv[3] = {};
  double dvv[3] = {};
  double normal[3] = {};
  double gaussian = 0;
  double mean = 0;
};

/// The patch `net` of this shape at (u, v): Bernstein sums of the points and their derivatives. For
/// rational patches these are sums of (w P, w), followed by the quotient rule.
template <typename T>
Sample reference_sample(const T* net, BatchShape shape, double u, double v);

} // namespace simdbezier_bench
