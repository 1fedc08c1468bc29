// Moves cache lines to memory, in parts that are registers where those have more than 128 bits; and
// planes into records in 128 bits.
#pragma once

#include <cstddef>

#include "kernels/simd/quad_transpose.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

inline constexpr std::size_t kPartBytes = sizeof(vec<float>) < 16 ? 16 : sizeof(vec<float>);

template <typename T, std::size_t kBytes>
struct VectorOf {
  typedef T type __attribute__((vector_size(kBytes)));
};
/// A register as the compilers' own vector type, whose shuffles are portable.
template <typename V>
using Bits = typename VectorOf<ScalarOf<V>, kLanes<V> * sizeof(ScalarOf<V>)>::type;
/// Lines are moved in parts, or in 128 bits of it.
template <typename T>
using LinePart = typename VectorOf<T, kPartBytes>::type;
template <typename T>
using Part128 = typename VectorOf<T, 16>::type;

template <typename T>
inline constexpr std::size_t kPartLanes = kPartBytes / sizeof(T);
/// There are so many values in 128 bits.
template <typename T>
inline constexpr std::size_t kGroupLanes = 16 / sizeof(T);

template <typename Vector, typename T>
SIMDBEZIER_INLINE Vector load_any(const T* from) {
  Vector value;
  __builtin_memcpy(&value, from, sizeof(value));
  return value;
}

/// Stores a vector. Where it is streamed, which takes effect on x86 only, `to` is aligned to the
/// vector.
template <bool kStreaming, typename Vector, typename T>
SIMDBEZIER_INLINE void store_any(T* to, Vector value) {
#if defined(__x86_64__) && !defined(SIMDBEZIER_KERNELS_SCALAR)
  if constexpr (kStreaming && sizeof(Vector) == 16) {
    __m128 bits;
    __builtin_memcpy(&bits, &value, sizeof(bits));
    _mm_stream_ps(reinterpret_cast<float*>(to), bits);
    return;
  }
#if defined(__AVX__)
  if constexpr (kStreaming && sizeof(Vector) == 32) {
    __m256 bits;
    __builtin_memcpy(&bits, &value, sizeof(bits));
    _mm256_stream_ps(reinterpret_cast<float*>(to), bits);
    return;
  }
#endif
#if defined(__AVX512F__)
  if constexpr (kStreaming && sizeof(Vector) == 64) {
    __m512 bits;
    __builtin_memcpy(&bits, &value, sizeof(bits));
    _mm512_stream_ps(reinterpret_cast<float*>(to), bits);
    return;
  }
#endif
#endif
  __builtin_memcpy(to, &value, sizeof(value));
}

/// Makes streaming stores of this thread visible before whatever it does next.
inline void streaming_fence() {
#if defined(__x86_64__)
  __builtin_ia32_sfence();
#endif
}

template <bool kStreaming, typename T>
SIMDBEZIER_INLINE void copy_line(const T* from, T* to) {
  constexpr std::size_t kParts = 64 / kPartBytes;
  LinePart<T> part[kParts];
  for (std::size_t k = 0; k < kParts; ++k) {
    part[k] = load_any<LinePart<T>>(from + k * kPartLanes<T>);
  }
  for (std::size_t k = 0; k < kParts; ++k) {
    store_any<kStreaming>(to + k * kPartLanes<T>, part[k]);
  }
}

// Groups of members ------------------------------------------------------------------------------

/// Members [0, kCount) of kDrainStep records, kCount <= kGroupLanes: transposed in 128 bits.
template <std::size_t kCount, typename T>
SIMDBEZIER_INLINE void interleave_group(const T* const* plane, std::size_t at, T* to,
                                        std::ptrdiff_t stride) {
  constexpr std::size_t kN = kGroupLanes<T>;
  for (std::size_t k = 0; k < 64 / sizeof(T); k += kN) {
    Part128<T> record[kN] = {};
    for (std::size_t m = 0; m < kCount; ++m) {
      record[m] = load_any<Part128<T>>(plane[m] + at + k);
    }
    transpose_quads<T>(record);
    for (std::size_t r = 0; r < kN; ++r, to += stride) {
      // Nothing behind the last member: it may be the caller's.
      __builtin_memcpy(to, &record[r], kCount * sizeof(T));
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
