// Cache lines to memory, and planes into records by shuffles.
//
// Written with the compilers' portable shuffles, over 512-bit vectors where the instruction set has
// them and over 128-bit ones elsewhere: wider vectors without 512-bit permutes gain nothing on
// stores that memory limits.
#pragma once

#include <cstddef>
#include <utility>

#include "kernels/isa/arch.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

#if defined(SIMDBEZIER_KERNELS_AVX512)
inline constexpr std::size_t kPartBytes = 64;
#else
inline constexpr std::size_t kPartBytes = 16;
#endif

template <typename T, std::size_t kBytes>
struct VectorOf {
  typedef T type __attribute__((vector_size(kBytes)));
};
/// What lines are moved in, and 128 bits of it.
template <typename T>
using LinePart = typename VectorOf<T, kPartBytes>::type;
template <typename T>
using Part128 = typename VectorOf<T, 16>::type;

template <typename T>
inline constexpr std::size_t kPartLanes = kPartBytes / sizeof(T);
/// Values in 128 bits.
template <typename T>
inline constexpr std::size_t kGroupLanes = 16 / sizeof(T);

template <typename Vector, typename T>
SIMDBEZIER_INLINE Vector load_any(const T* from) {
  Vector value;
  __builtin_memcpy(&value, from, sizeof(value));
  return value;
}

/// Streaming: `to` is aligned to the vector; takes effect on x86 only.
template <bool kStreaming, typename Vector, typename T>
SIMDBEZIER_INLINE void store_any(T* to, Vector value) {
#if defined(__x86_64__) && !defined(SIMDBEZIER_KERNELS_SCALAR)
  if constexpr (kStreaming && sizeof(Vector) == 16) {
    __m128 bits;
    __builtin_memcpy(&bits, &value, sizeof(bits));
    _mm_stream_ps(reinterpret_cast<float*>(to), bits);
    return;
  }
#if defined(SIMDBEZIER_KERNELS_AVX512)
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

// Triples ----------------------------------------------------------------------------------------

/// Element e of x y z x y z … comes from plane e % 3 at e / 3.
SIMDBEZIER_INLINE constexpr int from_xy(std::size_t e, std::size_t lanes) {
  return static_cast<int>(e % 3 == 2 ? 0 : e / 3 + (e % 3) * lanes);
}
SIMDBEZIER_INLINE constexpr int with_z(std::size_t lane, std::size_t e, std::size_t lanes) {
  return static_cast<int>(e % 3 == 2 ? e / 3 + lanes : lane);
}

template <typename T, std::size_t kOut, std::size_t... kLane>
SIMDBEZIER_INLINE LinePart<T> triple_part(LinePart<T> x, LinePart<T> y, LinePart<T> z,
                                          std::index_sequence<kLane...>) {
  constexpr std::size_t kN = kPartLanes<T>;
  const LinePart<T> xy = __builtin_shufflevector(x, y, from_xy(kOut * kN + kLane, kN)...);
  return __builtin_shufflevector(xy, z, with_z(kLane, kOut * kN + kLane, kN)...);
}

/// A part of each of three planes to packed triples.
template <bool kStreaming, typename T>
SIMDBEZIER_INLINE void store_records(const LinePart<T> (&p)[3], T* to) {
  constexpr std::size_t kN = kPartLanes<T>;
  constexpr auto kLanes = std::make_index_sequence<kN>{};
  store_any<kStreaming>(to, triple_part<T, 0>(p[0], p[1], p[2], kLanes));
  store_any<kStreaming>(to + kN, triple_part<T, 1>(p[0], p[1], p[2], kLanes));
  store_any<kStreaming>(to + 2 * kN, triple_part<T, 2>(p[0], p[1], p[2], kLanes));
}

// Nonuples ---------------------------------------------------------------------------------------

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// Where lane `lane` of result kOut of kMembers planes comes from, once the planes before `plane`
/// are in place: from the plane itself (second operand) or from what is there (first).
template <std::size_t kMembers, std::size_t kOut>
SIMDBEZIER_INLINE constexpr int merged(std::size_t lane, std::size_t plane, std::size_t lanes) {
  const std::size_t e = kOut * lanes + lane;
  return static_cast<int>(e % kMembers == plane ? lanes + e / kMembers : lane);
}

template <std::size_t kMembers, std::size_t kOut, std::size_t kPlane, typename T,
          std::size_t... kLane>
SIMDBEZIER_INLINE LinePart<T> merge_planes(LinePart<T> value, const LinePart<T> plane[kMembers],
                                           std::index_sequence<kLane...> lanes) {
  if constexpr (kPlane == kMembers) {
    return value;
  } else {
    value = __builtin_shufflevector(value, plane[kPlane],
                                    merged<kMembers, kOut>(kLane, kPlane, sizeof...(kLane))...);
    return merge_planes<kMembers, kOut, kPlane + 1, T>(value, plane, lanes);
  }
}

template <bool kStreaming, std::size_t kMembers, typename T, std::size_t... kOut>
SIMDBEZIER_INLINE void store_merged(const LinePart<T> plane[kMembers], T* to,
                                    std::index_sequence<kOut...>) {
  constexpr auto kLanes = std::make_index_sequence<kPartLanes<T>>{};
  (store_any<kStreaming>(to + kOut * kPartLanes<T>,
                         merge_planes<kMembers, kOut, 0, T>(plane[0], plane, kLanes)),
   ...);
}

/// The same for nine planes (position, du, dv): nine shuffles a line are less than the time that
/// the line takes to memory.
template <bool kStreaming, typename T>
SIMDBEZIER_INLINE void store_records(const LinePart<T> (&p)[9], T* to) {
  store_merged<kStreaming, 9>(p, to, std::make_index_sequence<9>{});
}
#endif

// Groups of members ------------------------------------------------------------------------------

/// Members [0, kCount) of kDrainStep records, kCount <= kGroupLanes: transposed in 128 bits.
template <std::size_t kCount, typename T>
SIMDBEZIER_INLINE void interleave_group(const T* const* plane, std::size_t at, T* to,
                                        std::ptrdiff_t stride) {
  constexpr std::size_t kN = kGroupLanes<T>;
  for (std::size_t k = 0; k < 64 / sizeof(T); k += kN) {
    Part128<T> record[kN];
    if constexpr (kN == 4) {
      Part128<T> p[4] = {};
      for (std::size_t m = 0; m < kCount; ++m) {
        p[m] = load_any<Part128<T>>(plane[m] + at + k);
      }
      const Part128<T> low01 = __builtin_shufflevector(p[0], p[1], 0, 4, 1, 5);
      const Part128<T> high01 = __builtin_shufflevector(p[0], p[1], 2, 6, 3, 7);
      const Part128<T> low23 = __builtin_shufflevector(p[2], p[3], 0, 4, 1, 5);
      const Part128<T> high23 = __builtin_shufflevector(p[2], p[3], 2, 6, 3, 7);
      record[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
      record[1] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
      record[2] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
      record[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
    } else {
      const Part128<T> p = load_any<Part128<T>>(plane[0] + at + k);
      const Part128<T> q = kCount == 2 ? load_any<Part128<T>>(plane[kCount - 1] + at + k) : p;
      record[0] = __builtin_shufflevector(p, q, 0, 2);
      record[1] = __builtin_shufflevector(p, q, 1, 3);
    }
    for (std::size_t r = 0; r < kN; ++r, to += stride) {
      // Nothing behind the last member: it may be the caller's.
      __builtin_memcpy(to, &record[r], kCount * sizeof(T));
    }
  }
}

// Sextuples --------------------------------------------------------------------------------------

#if defined(SIMDBEZIER_KERNELS_AVX512)
/// 128-bit parts A and B of a, then C and D of b.
template <int kA, int kB, int kC, int kD>
SIMDBEZIER_INLINE __m512d parts(__m512d a, __m512d b) {
  return _mm512_shuffle_f64x2(a, b, kA | kB << 2 | kC << 4 | kD << 6);
}

/// Part p of u[k] becomes part 6p+k of the six results: 12 shuffles across lanes.
template <bool kStreaming, typename T>
SIMDBEZIER_INLINE void store_transposed_parts(const __m512d u[6], T* to) {
  constexpr std::size_t kN = kPartLanes<T>;
  const __m512d low01 = parts<0, 1, 0, 1>(u[0], u[1]);
  const __m512d low23 = parts<0, 1, 0, 1>(u[2], u[3]);
  const __m512d low45 = parts<0, 1, 0, 1>(u[4], u[5]);
  const __m512d high01 = parts<2, 3, 2, 3>(u[0], u[1]);
  const __m512d high23 = parts<2, 3, 2, 3>(u[2], u[3]);
  const __m512d high45 = parts<2, 3, 2, 3>(u[4], u[5]);
  const __m512d out[6] = {parts<0, 2, 0, 2>(low01, low23),   parts<0, 2, 1, 3>(low45, low01),
                          parts<1, 3, 1, 3>(low23, low45),   parts<0, 2, 0, 2>(high01, high23),
                          parts<0, 2, 1, 3>(high45, high01), parts<1, 3, 1, 3>(high23, high45)};
  for (std::size_t k = 0; k < 6; ++k) {
    store_any<kStreaming>(to + k * kN, out[k]);
  }
}

/// The same for six planes. Within 128 bits first, where shuffles do not compete with
/// multiply-adds, then across.
template <bool kStreaming>
SIMDBEZIER_INLINE void store_records(const LinePart<float> (&p)[6], float* to) {
  __m512d low[3]; // samples 0 1 of every four: members 2m, 2m+1
  __m512d high[3];
  for (std::size_t m = 0; m < 3; ++m) {
    low[m] = _mm512_castps_pd(_mm512_unpacklo_ps(p[2 * m], p[2 * m + 1]));
    high[m] = _mm512_castps_pd(_mm512_unpackhi_ps(p[2 * m], p[2 * m + 1]));
  }
  const __m512d u[6] = {
      _mm512_unpacklo_pd(low[0], low[1]),        _mm512_shuffle_pd(low[2], low[0], 0xaa),
      _mm512_unpackhi_pd(low[1], low[2]),        _mm512_unpacklo_pd(high[0], high[1]),
      _mm512_shuffle_pd(high[2], high[0], 0xaa), _mm512_unpackhi_pd(high[1], high[2])};
  store_transposed_parts<kStreaming>(u, to);
}

template <bool kStreaming>
SIMDBEZIER_INLINE void store_records(const LinePart<double> (&p)[6], double* to) {
  __m512d u[6];
  for (std::size_t m = 0; m < 3; ++m) {
    u[m] = _mm512_unpacklo_pd(p[2 * m], p[2 * m + 1]);
    u[m + 3] = _mm512_unpackhi_pd(p[2 * m], p[2 * m + 1]);
  }
  store_transposed_parts<kStreaming>(u, to);
}
#else
/// The same for six planes, in pairs of members.
template <bool kStreaming, typename T>
SIMDBEZIER_INLINE void store_records(const LinePart<T> (&p)[6], T* to) {
  Part128<T> out[6];
  if constexpr (kGroupLanes<T> == 4) {
    const auto put = [&out](std::size_t first, Part128<T> a, Part128<T> b, Part128<T> c) {
      out[first] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
      out[first + 1] = __builtin_shufflevector(c, a, 0, 1, 6, 7);
      out[first + 2] = __builtin_shufflevector(b, c, 2, 3, 6, 7);
    };
    put(0, __builtin_shufflevector(p[0], p[1], 0, 4, 1, 5), // samples 0 and 1
        __builtin_shufflevector(p[2], p[3], 0, 4, 1, 5),
        __builtin_shufflevector(p[4], p[5], 0, 4, 1, 5));
    put(3, __builtin_shufflevector(p[0], p[1], 2, 6, 3, 7), // samples 2 and 3
        __builtin_shufflevector(p[2], p[3], 2, 6, 3, 7),
        __builtin_shufflevector(p[4], p[5], 2, 6, 3, 7));
  } else {
    for (std::size_t m = 0; m < 3; ++m) {
      out[m] = __builtin_shufflevector(p[2 * m], p[2 * m + 1], 0, 2);
      out[m + 3] = __builtin_shufflevector(p[2 * m], p[2 * m + 1], 1, 3);
    }
  }
  for (std::size_t m = 0; m < 6; ++m) {
    store_any<kStreaming>(to + m * kPartLanes<T>, out[m]);
  }
}
#endif

// From memory ------------------------------------------------------------------------------------

/// kDrainStep samples of kMembers planes to packed records.
template <bool kStreaming, std::size_t kMembers, typename T>
SIMDBEZIER_INLINE void interleave(const T* const plane[kMembers], std::size_t at, T* to) {
  constexpr std::size_t kN = kPartLanes<T>;
  for (std::size_t k = 0; k < 64 / sizeof(T); k += kN, to += kMembers * kN) {
    LinePart<T> p[kMembers];
    for (std::size_t m = 0; m < kMembers; ++m) {
      p[m] = load_any<LinePart<T>>(plane[m] + at + k);
    }
    store_records<kStreaming>(p, to);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
