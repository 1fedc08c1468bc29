// Run-time probes of instruction sets and cache sizes. The compiler's built-in honours what the
// operating system saves (XCR0), which xsimd 8.1's own probe does not.
#include "src/runtime/dispatch.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace simdbezier::detail {

bool cpu_supports(Isa isa) noexcept {
  switch (isa) {
  case Isa::scalar:
    return true;
#if defined(__x86_64__)
  case Isa::sse2:
    return true; // the baseline of x86-64
  case Isa::avx2:
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  case Isa::avx512:
    return cpu_supports(Isa::avx2) && __builtin_cpu_supports("avx512f") != 0 &&
           __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512vl") != 0;
#elif defined(__aarch64__)
  case Isa::neon64:
    return true; // the baseline of aarch64
#endif
  default:
    return false;
  }
}

namespace {

struct CacheSizes {
  std::size_t first = std::size_t{32} << 10;
  std::size_t second = std::size_t{512} << 10;
  std::size_t last = std::size_t{8} << 20;

  CacheSizes() noexcept {
#if defined(__x86_64__)
    // The C library adds up all caches of a machine; these leaves describe one (Intel, AMD).
    for (const unsigned leaf : {0x4U, 0x8000001dU}) {
      read(leaf);
    }
#endif
  }

#if defined(__x86_64__)
  void read(unsigned leaf) noexcept {
    for (unsigned index = 0; index < 8; ++index) {
      unsigned a = 0;
      unsigned b = 0;
      unsigned c = 0;
      unsigned d = 0;
      if (__get_cpuid_count(leaf, index, &a, &b, &c, &d) == 0 || (a & 0x1fU) == 0) {
        return;
      }
      const std::size_t bytes =
          ((b >> 22U) + 1UL) * (((b >> 12U) & 0x3ffU) + 1UL) * ((b & 0xfffU) + 1UL) * (c + 1UL);
      const unsigned level = (a >> 5U) & 7U;
      constexpr unsigned kData = 1;
      if (level == 1 && (a & 0x1fU) == kData) {
        first = bytes;
      }
      if (level == 2) {
        second = bytes;
      }
      if (level >= 2) {
        last = bytes;
      }
    }
  }
#endif
};

const CacheSizes& cache_sizes() noexcept {
  static const CacheSizes sizes;
  return sizes;
}

} // namespace

std::size_t last_level_cache() noexcept { return cache_sizes().last; }
std::size_t first_level_cache() noexcept { return cache_sizes().first; }
std::size_t second_level_cache() noexcept { return cache_sizes().second; }

} // namespace simdbezier::detail
