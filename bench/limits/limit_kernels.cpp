// Arithmetic limits. Compiled twice per instruction set, with and without contraction; a*b + c
// below is one instruction in the first and two in the second.
#include "bench/limits/limit_kernels.hpp"

#include "bench/limits/registers.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace SIMDBEZIER_BENCH_CONTRACTION {
namespace {

// Enough to cover 5 cycles of latency on two pipes.
constexpr int kChains = 12;

template <typename T>
std::size_t multiply_add(std::size_t rounds, T* sink) {
  using V = RegisterOf<T>;
  V factor = V{} + T(0.5); // towards 2, never to infinity or denormal numbers
  V term = V{} + T(1);
  hide(factor);
  hide(term);
  V a0{}, a1{}, a2{}, a3{}, a4{}, a5{}, a6{}, a7{}, a8{}, a9{}, a10{}, a11{};
  for (std::size_t k = 0; k < rounds; ++k) {
    a0 = a0 * factor + term;
    a1 = a1 * factor + term;
    a2 = a2 * factor + term;
    a3 = a3 * factor + term;
    a4 = a4 * factor + term;
    a5 = a5 * factor + term;
    a6 = a6 * factor + term;
    a7 = a7 * factor + term;
    a8 = a8 * factor + term;
    a9 = a9 * factor + term;
    a10 = a10 * factor + term;
    a11 = a11 * factor + term;
    // Otherwise equal chains are found out and one is kept.
    hide(a0), hide(a1), hide(a2), hide(a3), hide(a4), hide(a5);
    hide(a6), hide(a7), hide(a8), hide(a9), hide(a10), hide(a11);
  }
  const V sum = ((a0 + a1) + (a2 + a3)) + ((a4 + a5) + (a6 + a7)) + ((a8 + a9) + (a10 + a11));
  *reinterpret_cast<V*>(sink) = sum;
  return kChains * kLanes<T>;
}

template <typename V, typename T>
[[gnu::always_inline]] inline V broadcast(T value) {
  return V{} + value;
}

// Rows of a grid in the library have the same shape: four coefficients stay, the parameter changes,
// one store a result. Groups of eight leave the rest to out-of-order execution, which is the best
// in the median of the orders tried; all of them, on Zen 4 and Zen 5, switch between a fast and a
// slow mode (3.0 and 4.2 cycles a 512-bit result) for whole runs, in a way that looks like chance.
template <typename T>
void horner_store(T* out, std::size_t count, const T* inputs) {
  using V = RegisterOf<T>;
  constexpr int kGroup = 8;
  constexpr int kStride = static_cast<int>(kLanes<T>);
  static_assert(kHornerBlockBytes % (kGroup * sizeof(V)) == 0);
  const V c0 = broadcast<V>(inputs[0]);
  const V c1 = broadcast<V>(inputs[1]);
  const V c2 = broadcast<V>(inputs[2]);
  const V c3 = broadcast<V>(inputs[3]);
  V x = broadcast<V>(inputs[4]);
  for (T* const end = out + count; out != end; out += kGroup * kStride) {
#pragma GCC unroll 8
    for (int k = 0; k < kGroup; ++k) {
      hide(x); // a new parameter, for all that the compiler knows
      *reinterpret_cast<V*>(out + k * kStride) = ((c3 * x + c2) * x + c1) * x + c0;
    }
  }
}

} // namespace

LimitKernels<float> limits(float);
LimitKernels<double> limits(double);
LimitKernels<float> limits(float) { return {multiply_add<float>, horner_store<float>}; }
LimitKernels<double> limits(double) { return {multiply_add<double>, horner_store<double>}; }

} // namespace SIMDBEZIER_BENCH_CONTRACTION
} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
