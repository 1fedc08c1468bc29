// Run-time probe. The compiler's built-in honours what the operating system saves (XCR0), which
// xsimd 8.1's own probe does not.
#include "kernels/dispatch.hpp"

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

} // namespace simdbezier::detail
