// The names of the instruction sets; isa.hpp says what can be asked about them.
#pragma once

#include <cstdint>

namespace simdbezier {

/// The instruction sets that kernels are compiled for. Results are bit-equal inside a class:
/// avx2, avx512 and neon64 fuse multiply and add; scalar, sse2, simd128 round after each one.
enum class Isa : std::uint8_t {
  automatic, ///< SIMDBEZIER_ISA if it is set, otherwise the widest that the machine can run, or for
             ///< some grids the next one: see resolve_isa()
  scalar,
  sse2,
  avx2,   ///< AVX2 and FMA
  avx512, ///< AVX-512 F, CD, DQ, BW, VL
  neon64, ///< the aarch64 baseline
  simd128 ///< WebAssembly's vectors of 128 bits
};

} // namespace simdbezier
