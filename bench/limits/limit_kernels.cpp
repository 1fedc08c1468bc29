// Arithmetic limits. This file is compiled twice per instruction set, with and without contraction:
// a*b + c below is one instruction in the first object and two in the second.
#include "bench/limits/limit_kernels.hpp"

#include <utility>

#include "bench/limits/registers.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace SIMDBEZIER_BENCH_CONTRACTION {
namespace {

// So many chains are enough to cover 5 cycles of latency on two pipes.
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
    // The chains are hidden, because the compiler would see that they are equal, and keep one.
    hide(a0), hide(a1), hide(a2), hide(a3), hide(a4), hide(a5);
    hide(a6), hide(a7), hide(a8), hide(a9), hide(a10), hide(a11);
  }
  const V sum = ((a0 + a1) + (a2 + a3)) + ((a4 + a5) + (a6 + a7)) + ((a8 + a9) + (a10 + a11));
  *reinterpret_cast<V*>(sink) = sum;
  return kChains * kLanes<T>;
}

template <typename V, typename T, std::size_t... lane>
[[gnu::always_inline]] inline V broadcast_lanes(T value, std::index_sequence<lane...>) {
  return V{(static_cast<void>(lane), value)...};
}

/// Sets every lane to the value; V{} + value would be an addition to zero.
template <typename V, typename T>
[[gnu::always_inline]] inline V broadcast(T value) {
  return broadcast_lanes<V>(value, std::make_index_sequence<sizeof(V) / sizeof(T)>());
}

#if defined(SIMDBEZIER_BENCH_FUSED)
constexpr bool kFused = true;
#else
constexpr bool kFused = false;
#endif

/// Makes the compiler load `value` again where it is used next.
template <typename V>
[[gnu::always_inline]] inline void reload(V& value) {
  asm volatile("" : "+m"(value));
}

// Rows of a grid in the library have the same shape: four coefficients stay, the parameter changes,
// and each result takes one store. These are the best of about 150 orders and forms that were tried
// on Zen 5. They make use of the fact that operands fresh from a load or from the instruction
// before cost less than old registers: 256-bit registers want a parameter from memory for every
// result (7.1 against 5.5 thousand million positions/s, which is the rate of the multiply-adds),
// and 512-bit ones addends from memory as well, and four results in flight (9.6 against 8.9). Where
// instructions are scarcer than loads, as on Cascade Lake, a parameter from memory for every step
// is better by a tenth to a fifth, because it saves copies.
enum class Operand { in_registers, result, addend, step };

template <typename T, int kDegree, Operand kFromMemory>
void horner_store(T* out, std::size_t count, const T* inputs) {
  using V = RegisterOf<T>;
  constexpr bool kOrdered = kFromMemory == Operand::addend;
  constexpr int kFlight = kOrdered || kFromMemory == Operand::step ? 4 : 1;
  constexpr int kGroup = 8;
  constexpr int kStride = static_cast<int>(kLanes<T>);
  static_assert(kHornerBlockBytes % (kGroup * sizeof(V)) == 0);
  V addend[kDegree];
  for (int k = 0; k < kDegree; ++k) {
    addend[k] = broadcast<V>(inputs[1 + k]);
    hide(addend[k]); // otherwise one lane would be computed and repeated
  }
  V highest = broadcast<V>(inputs[1 + kDegree]);
  hide(highest);
  T parameter = inputs[0];
  V x[kFlight];
  V r[kFlight];
  x[0] = broadcast<V>(parameter);
  for (T* const end = out + count; out != end; out += kGroup * kStride) {
#pragma GCC unroll 8
    for (int first = 0; first < kGroup; first += kFlight) {
#pragma GCC unroll 4
      for (int k = 0; k < kFlight; ++k) { // the compiler has to take it for a new parameter
        if constexpr (kFromMemory != Operand::in_registers) {
          reload(parameter);
          x[k] = broadcast<V>(parameter);
        }
        if constexpr (kFromMemory != Operand::step) {
          hide(x[k]);
        }
        r[k] = highest;
      }
#pragma GCC unroll 4
      for (int step = kDegree - 1; step >= 0; --step) {
#pragma GCC unroll 4
        for (int k = 0; k < kFlight; ++k) {
          if constexpr (kOrdered) {
            reload(addend[step]);
          }
          if constexpr (kFromMemory == Operand::step) {
            reload(parameter);
            x[k] = broadcast<V>(parameter);
          }
          r[k] = r[k] * x[k] + addend[step];
          if constexpr (kOrdered) {
            hide(r[k]); // keeps this order
          }
        }
      }
#pragma GCC unroll 4
      for (int k = 0; k < kFlight; ++k) {
        *reinterpret_cast<V*>(out + (first + k) * kStride) = r[k];
      }
    }
  }
}

/// Pairs of rows as the library computes them: two multiply-adds, a product, a sum and a
/// difference. The parameter and its square come from memory, since they change from row to row.
template <typename T>
void pairs_store(T* out, std::size_t count, const T* inputs) {
  using V = RegisterOf<T>;
  constexpr std::size_t kStride = kLanes<T>;
  V c[4];
  for (int k = 0; k < 4; ++k) {
    c[k] = broadcast<V>(inputs[1 + k]);
    hide(c[k]);
  }
  constexpr std::size_t kGroup = 4; // counting one by one would be a fifth of all instructions
  static_assert(kHornerBlockBytes % (2 * kGroup * sizeof(V)) == 0);
  T parameter = inputs[0];
  T square = parameter * parameter;
  T* mirrored = out + count / 2;
  for (T* const end = mirrored; out != end; out += kGroup * kStride, mirrored += kGroup * kStride) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < kGroup; ++k) {
      reload(parameter);
      reload(square);
      const V z = broadcast<V>(square);
      const V even = c[2] * z + c[0];
      V odd = broadcast<V>(parameter) * (c[3] * z + c[1]);
      hide(odd); // rounded before the sum
      *reinterpret_cast<V*>(out + k * kStride) = even + odd;
      *reinterpret_cast<V*>(mirrored + k * kStride) = even - odd;
    }
  }
}

} // namespace

LimitKernels<float> limits(float);
LimitKernels<double> limits(double);
template <typename T>
LimitKernels<T> limits_of() {
  constexpr std::size_t kBytes = kFused ? sizeof(RegisterOf<T>) : 0;
  constexpr Operand kFirst = kBytes == 64   ? Operand::addend
                             : kBytes == 32 ? Operand::result
                                            : Operand::in_registers;
  constexpr Operand kSecond = kBytes == 64 ? Operand::step : kFirst;
  return {multiply_add<T>,
          {{horner_store<T, 2, kFirst>, horner_store<T, 2, kSecond>},
           {horner_store<T, 3, kFirst>, horner_store<T, 3, kSecond>},
           {horner_store<T, 4, kFirst>, horner_store<T, 4, kSecond>}},
          pairs_store<T>};
}
LimitKernels<float> limits(float) { return limits_of<float>(); }
LimitKernels<double> limits(double) { return limits_of<double>(); }

} // namespace SIMDBEZIER_BENCH_CONTRACTION
} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
