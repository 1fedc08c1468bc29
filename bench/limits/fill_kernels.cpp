// Fills memory with whole registers, past the caches and through them.
#include "bench/limits/limit_kernels.hpp"

#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "bench/limits/registers.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

// The pattern must not be one byte repeated, because such a loop becomes a call of memset(), which
// takes its own decisions about the caches.
constexpr double kPattern = 1.5;

void fill_plain(unsigned char* out, std::size_t bytes) {
  using V = RegisterOf<double>;
  using Anywhere [[gnu::aligned(sizeof(double))]] = V;
  V value = V{} + kPattern;
  hide(value);
  for (unsigned char* const end = out + bytes; out != end; out += 4 * sizeof(V)) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < 4; ++k) {
      *reinterpret_cast<Anywhere*>(out + k * sizeof(V)) = value;
    }
  }
}

#if defined(__x86_64__) && !defined(SIMDBEZIER_BENCH_SCALAR)
[[gnu::always_inline]] inline void stream_one(unsigned char* out) {
#if defined(__AVX512F__)
  _mm512_stream_pd(reinterpret_cast<double*>(out), _mm512_set1_pd(kPattern));
#elif defined(__AVX2__)
  _mm256_stream_pd(reinterpret_cast<double*>(out), _mm256_set1_pd(kPattern));
#else
  _mm_stream_pd(reinterpret_cast<double*>(out), _mm_set1_pd(kPattern));
#endif
}

// A line is always completed at once, because half lines are streamed at a third of the speed. Each
// page but the first is asked for before the first store to it: otherwise all stores wait until the
// processor has found where it lies, by which a virtual machine loses up to two fifths of the rate.
void fill_stream(unsigned char* out, std::size_t bytes) {
  constexpr std::size_t kStep = sizeof(RegisterOf<double>);
  constexpr std::size_t kPage = 4096;
  for (unsigned char* const end = out + bytes; out != end; out += 64) {
    if (reinterpret_cast<std::uintptr_t>(out) % kPage == 0) {
      asm volatile("prefetcht0 %0" : : "m"(out[kPage])); // a builtin might be dropped
    }
#pragma GCC unroll 4
    for (std::size_t k = 0; k < 64; k += kStep) {
      stream_one(out + k);
    }
  }
  _mm_sfence();
}
#elif defined(__aarch64__) && !defined(SIMDBEZIER_BENCH_SCALAR)
void fill_stream(unsigned char* out, std::size_t bytes) {
  const RegisterOf<double> value = RegisterOf<double>{} + kPattern;
  for (unsigned char* const end = out + bytes; out != end; out += 64) {
    asm volatile("stnp %q0, %q0, [%1]\n\tstnp %q0, %q0, [%1, #32]"
                 :
                 : "w"(value), "r"(out)
                 : "memory");
  }
}
#else
constexpr auto fill_stream = fill_plain; // there is no such store here
#endif

} // namespace

FillKernels fills();
FillKernels fills() { return {fill_stream, fill_plain}; }

} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
