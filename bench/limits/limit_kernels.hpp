// What the machine can do at best: one loop for each question, compiled once per instruction set.
#pragma once

#include <cstddef>

namespace simdbezier_bench {

constexpr int kLeastHornerDegree = 2;
constexpr int kMostHornerDegree = 4;
constexpr int kHornerForms = 2;
constexpr std::size_t kHornerBlockBytes = 512;

/// Arithmetic limits of one type on one instruction set.
template <typename T>
struct LimitKernels {
  /// Runs `rounds` rounds of independent multiply-add chains in registers; returns how many
  /// multiply-adds a round holds, lanes counted.
  std::size_t (*multiply_add)(std::size_t rounds, T* sink) = nullptr;
  /// Horner's rule from registers, with one step a degree and one store a result: out[k] for k <
  /// count, which makes a multiple of kHornerBlockBytes. out is 64-byte aligned; inputs are x, then
  /// c0, c1, …. The index is [degree - kLeastHornerDegree][form], since the processor decides which
  /// form is the fastest.
  void (*horner_store[3][kHornerForms])(T* out, std::size_t count, const T* inputs) = {};
  /// Evaluates cubics at x and -x, which share their even and odd parts: p(x) goes to the first
  /// half of out, p(-x) to the second one.
  void (*pairs_store)(T* out, std::size_t count, const T* inputs) = nullptr;
};

/// Rates at which memory can be filled; `bytes` is a multiple of 256.
struct FillKernels {
  void (*stream)(unsigned char* out, std::size_t bytes) = nullptr; ///< past the caches, whole lines
  void (*plain)(unsigned char* out, std::size_t bytes) = nullptr;  ///< out: 8-byte aligned
};

/// `fused` objects may contract a multiplication and an addition, `separate` ones may not.
#define SIMDBEZIER_BENCH_DECLARE_LIMITS(isa)                                                       \
  namespace isa {                                                                                  \
  namespace fused {                                                                                \
  LimitKernels<float> limits(float);                                                               \
  LimitKernels<double> limits(double);                                                             \
  }                                                                                                \
  namespace separate {                                                                             \
  LimitKernels<float> limits(float);                                                               \
  LimitKernels<double> limits(double);                                                             \
  }                                                                                                \
  FillKernels fills();                                                                             \
  }

} // namespace simdbezier_bench
