// Operands that instructions take from memory by themselves.
//
// Sweeps are short of issue slots before they are short of multiply-adds: four a cycle on many
// processors, two where the core is shared with another thread. An operand in memory costs none,
// as long as its address is one register and a constant.
#pragma once

#include "kernels/simd/vector.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns the same address in a register of its own, so that what is read behind it needs no
/// index.
template <typename T>
SIMDBEZIER_INLINE T* own_address(T* address) {
  asm("" : "+r"(address));
  return address;
}

/// The same for a plane that is written row by row, in WebAssembly alone: V8 would add up base,
/// patch and tile for each row.
template <typename T>
SIMDBEZIER_INLINE T* own_plane(T* address) {
  return kSimd128 ? own_address(address) : address;
}

/// Asks for the cache line at an address. Without the empty statement, whose effects are unknown,
/// g++ takes functions that do nothing else for ones without an effect, and drops their calls.
/// WebAssembly cannot ask.
SIMDBEZIER_INLINE void prefetch_line(const void* address) {
  if constexpr (!kSimd128) {
    asm volatile("" : "+r"(address));
    __builtin_prefetch(address);
  }
}
/// The same, but the address stays base, index and constant in the instruction instead of taking a
/// register.
SIMDBEZIER_INLINE void prefetch_operand(const void* address) {
#if defined(SIMDBEZIER_KERNELS_AVX512) || defined(SIMDBEZIER_KERNELS_AVX2)
  asm volatile("prefetcht0 %0" : : "m"(*static_cast<const char*>(address)));
#else
  prefetch_line(address);
#endif
}
/// Asks for `count` values that are needed soon.
template <typename T>
SIMDBEZIER_INLINE void prefetch_values(const T* values, std::size_t count) {
  constexpr std::size_t kLine = 64 / sizeof(T);
  for (std::size_t i = 0; i < count; i += kLine) {
    prefetch_line(values + i);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
