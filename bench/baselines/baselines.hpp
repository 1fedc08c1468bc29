// The two competitors, compiled once per instruction set.
#pragma once

#include "bench/subjects/job.hpp"

namespace simdbezier_bench {

/// The competitors, compiled for the widest instruction set that this build and this machine share.
template <typename T>
struct Baselines {
  void (*de_casteljau)(const GridJob<T>& job) = nullptr;                ///< AoS out
  void (*de_casteljau_scattered)(const ScatteredJob<T>& job) = nullptr; ///< AoS out
  void (*autovectorised)(const GridJob<T>& job) = nullptr;              ///< SoA out
  void (*de_casteljau_curves)(const CurveJob<T>& job) = nullptr;        ///< AoS out
};

template <typename T>
Baselines<T> widest_baselines();

/// The largest nu (and nv, where nu is below 8) that autovectorised accepts, because its scratch is
/// on the stack.
constexpr std::size_t kMaxGridSize = 80;

// Definitions live in namespaces that are named after the instruction set, so that no two objects
// offer the linker the same symbol.
#define SIMDBEZIER_BENCH_DECLARE_BASELINES(isa)                                                    \
  namespace isa {                                                                                  \
  void de_casteljau(const GridJob<float>& job);                                                    \
  void de_casteljau(const GridJob<double>& job);                                                   \
  void de_casteljau_scattered(const ScatteredJob<float>& job);                                     \
  void de_casteljau_scattered(const ScatteredJob<double>& job);                                    \
  void autovectorised(const GridJob<float>& job);                                                  \
  void autovectorised(const GridJob<double>& job);                                                 \
  void de_casteljau_curves(const CurveJob<float>& job);                                            \
  void de_casteljau_curves(const CurveJob<double>& job);                                           \
  }

} // namespace simdbezier_bench
