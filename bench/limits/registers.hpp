// The register type of the instruction set that the including object is compiled for, in the
// compilers' own vector extension, because limits must not depend on the library that they judge.
#pragma once

#include <cstddef>

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

#if defined(SIMDBEZIER_BENCH_SCALAR)
template <typename T>
struct Register {
  using Type = T;
};
#else
#if defined(__AVX512F__)
constexpr std::size_t kRegisterBytes = 64;
#elif defined(__AVX2__)
constexpr std::size_t kRegisterBytes = 32;
#else
constexpr std::size_t kRegisterBytes = 16;
#endif
template <typename T>
struct Register {
  typedef T Type __attribute__((vector_size(kRegisterBytes), may_alias));
};
#endif

template <typename T>
using RegisterOf = typename Register<T>::Type;

template <typename T>
constexpr std::size_t kLanes = sizeof(RegisterOf<T>) / sizeof(T);

// Makes a value unknown to the optimiser without costing an instruction, so that a loop over
// registers alone is neither hoisted nor folded.
template <typename V>
[[gnu::always_inline]] inline void hide(V& value) {
#if defined(__AVX512F__)
  asm volatile("" : "+v"(value));
#elif defined(__x86_64__)
  asm volatile("" : "+x"(value));
#elif defined(__aarch64__)
  asm volatile("" : "+w"(value));
#else
  asm volatile("" : "+m"(value));
#endif
}

} // namespace
} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
