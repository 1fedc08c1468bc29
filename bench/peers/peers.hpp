// Other libraries on the library's own grids: each prepares its objects outside of the clock and
// returns the call that is timed, which fills job.out. Only those that were found are linked.
#pragma once

#include <functional>

#include "bench/job.hpp"

namespace simdbezier_bench {

/// `nets`: control points [patch][j][i][xyz]. Outputs: position, or position, du and dv.
template <typename T>
using PreparePeer = std::function<void()> (*)(const GridJob<T>& job, const T* nets);

std::function<void()> prepare_opensubdiv(const GridJob<float>& job, const float* nets); // triples
std::function<void()> prepare_opencascade(const GridJob<double>& job,
                                          const double* nets);                      // triples
std::function<void()> prepare_sisl(const GridJob<double>& job, const double* nets); // triples

// Eigen is compiled once per instruction set, as the baselines are; planes.
#define SIMDBEZIER_BENCH_DECLARE_EIGEN(isa)                                                        \
  namespace isa {                                                                                  \
  void eigen(const GridJob<float>& job);                                                           \
  void eigen(const GridJob<double>& job);                                                          \
  }

} // namespace simdbezier_bench
