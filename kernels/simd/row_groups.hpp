// Registers that hold samples of several rows: kRows groups of lanes, one row each, in order. With
// kRows = lanes a group is a single sample, and the register a piece of a column.
#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Moves one value through an integer register: the floating-point pipes have enough to do.
template <typename T>
SIMDBEZIER_INLINE void move_value(T* to, const T* from) {
  std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t> bits;
  __builtin_memcpy(&bits, from, sizeof(T));
  __builtin_memcpy(to, &bits, sizeof(T));
}

// These store the first n of the kWidth lanes from kLane on. Where kWidth is 1, kLane is the first
// lane or that of the upper half.
#if defined(SIMDBEZIER_KERNELS_AVX512)
/// A part of a register in a register of its own. g++ makes one instruction of taking it out and a
/// masked store, which faults on lanes that are masked out, unlike masked stores themselves: memory
/// behind an output need not exist.
template <typename Part>
SIMDBEZIER_INLINE Part own_register(Part part) {
  asm("" : "+v"(part));
  return part;
}

template <std::size_t kWidth, std::size_t kLane>
SIMDBEZIER_INLINE void store_lanes_from(float* to, vec<float> value, std::size_t n) {
  if (kWidth == 8 && __builtin_constant_p(n) && n == 8) {
    _mm256_storeu_ps(to, _mm512_extractf32x8_ps(value, kLane / 8));
  } else if constexpr (kWidth == 8) {
    const auto mask = static_cast<__mmask8>((1U << n) - 1U);
    _mm256_mask_storeu_ps(to, mask, own_register(_mm512_extractf32x8_ps(value, kLane / 8)));
  } else {
    static_assert(kWidth == 1);
    _mm_store_ss(to, _mm512_extractf32x4_ps(value, kLane / 4));
  }
}
template <std::size_t kWidth, std::size_t kLane>
SIMDBEZIER_INLINE void store_lanes_from(double* to, vec<double> value, std::size_t n) {
  if constexpr (kWidth == 4) {
    const auto mask = static_cast<__mmask8>((1U << n) - 1U);
    _mm256_mask_storeu_pd(to, mask, own_register(_mm512_extractf64x4_pd(value, kLane / 4)));
  } else {
    static_assert(kWidth == 1);
    _mm_store_sd(to, _mm512_extractf64x2_pd(value, kLane / 2));
  }
}
#elif defined(SIMDBEZIER_KERNELS_AVX2)
template <std::size_t kWidth, std::size_t kLane>
SIMDBEZIER_INLINE void store_lanes_from(float* to, vec<float> value, std::size_t n) {
  __m128 half = _mm256_extractf128_ps(value, kLane / 4);
  if constexpr (kLane % 4 != 0) {
    half = _mm_movehl_ps(half, half);
  }
  if (kWidth == 4 && n == 4) {
    _mm_storeu_ps(to, half);
  } else {
    store_first_of_128(to, half, n);
  }
}
template <std::size_t kWidth, std::size_t kLane>
SIMDBEZIER_INLINE void store_lanes_from(double* to, vec<double> value, std::size_t n) {
  const __m128d half = _mm256_extractf128_pd(value, kLane / 2);
  if (kWidth == 2 && n == 2) {
    _mm_storeu_pd(to, half);
  } else {
    _mm_store_sd(to, half);
  }
}
#else
template <std::size_t kWidth, std::size_t kLane, typename V>
SIMDBEZIER_INLINE void store_lanes_from(ScalarOf<V>* to, V value, std::size_t n) {
  alignas(64) ScalarOf<V> lanes[kLanes<V>];
  store_vector(lanes, value);
  for (std::size_t i = 0; i < n; ++i) {
    move_value(to + i, lanes + kLane + i);
  }
}
#endif

/// These row groups are for any instruction set.
template <std::size_t kRows, typename V>
struct RowGroups {
  using T = ScalarOf<V>;
  static constexpr std::size_t kColumns = kLanes<V> / kRows;

  /// Returns values[r] in all lanes of group r.
  static SIMDBEZIER_INLINE V spread(const T* values) {
    if constexpr (kRows == 1) {
      return broadcast<V>(*values);
    } else if constexpr (kRows == kLanes<V>) {
      return load_vector<V>(values);
    } else {
      return from_lanes<V>([values](std::size_t i)
                               SIMDBEZIER_INLINE_LAMBDA { return values[i / kColumns]; });
    }
  }

  /// Returns values[i] in lane i of every group.
  static SIMDBEZIER_INLINE V repeat(const T* values) {
    if constexpr (kRows == 1) {
      return load_vector<V>(values);
    } else if constexpr (kRows == kLanes<V>) {
      return broadcast<V>(*values);
    } else {
      return from_lanes<V>([values](std::size_t i)
                               SIMDBEZIER_INLINE_LAMBDA { return values[i % kColumns]; });
    }
  }
};

#if defined(SIMDBEZIER_KERNELS_AVX512)
// Values come as a 64 or 128 bit broadcast and an in-lane permute, which leaves the pipes of the
// multiply-adds alone.
template <>
struct RowGroups<2, vec<float>> {
  static SIMDBEZIER_INLINE vec<float> repeat(const float* values) {
    return vec<float>(_mm512_broadcast_f32x8(_mm256_loadu_ps(values)));
  }
  static SIMDBEZIER_INLINE vec<float> spread(const float* values) {
    double both;
    __builtin_memcpy(&both, values, sizeof(both));
    const __m512i index = _mm512_maskz_set1_epi32(0xff00, 1);
    return vec<float>(_mm512_permutevar_ps(_mm512_castpd_ps(_mm512_set1_pd(both)), index));
  }
};

/// These two return the first rows and the second rows of two registers of two rows each.
SIMDBEZIER_INLINE vec<float> first_rows(vec<float> a, vec<float> b) {
  return vec<float>(_mm512_shuffle_f32x4(a, b, 0x44));
}
SIMDBEZIER_INLINE vec<float> second_rows(vec<float> a, vec<float> b) {
  return vec<float>(_mm512_shuffle_f32x4(a, b, 0xee));
}

template <>
struct RowGroups<4, vec<float>> {
  static SIMDBEZIER_INLINE vec<float> repeat(const float* values) {
    return vec<float>(_mm512_broadcast_f32x4(_mm_loadu_ps(values)));
  }
  static SIMDBEZIER_INLINE vec<float> spread(const float* values) {
    const __m512i index = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
    return vec<float>(_mm512_permutevar_ps(_mm512_broadcast_f32x4(_mm_loadu_ps(values)), index));
  }
};

template <>
struct RowGroups<2, vec<double>> {
  static SIMDBEZIER_INLINE vec<double> repeat(const double* values) {
    return vec<double>(_mm512_broadcast_f64x4(_mm256_loadu_pd(values)));
  }
  static SIMDBEZIER_INLINE vec<double> spread(const double* values) {
    const __m512i index = _mm512_maskz_set1_epi64(0xf0, 2);
    return vec<double>(_mm512_permutevar_pd(_mm512_broadcast_f64x2(_mm_loadu_pd(values)), index));
  }
};
#elif defined(SIMDBEZIER_KERNELS_AVX2)
template <>
struct RowGroups<2, vec<float>> {
  static SIMDBEZIER_INLINE vec<float> repeat(const float* values) {
    return vec<float>(_mm256_broadcast_ps(reinterpret_cast<const __m128*>(values)));
  }
  static SIMDBEZIER_INLINE vec<float> spread(const float* values) {
    double both;
    __builtin_memcpy(&both, values, sizeof(both));
    const __m256i index = _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1);
    return vec<float>(_mm256_permutevar_ps(_mm256_castpd_ps(_mm256_set1_pd(both)), index));
  }
};

template <>
struct RowGroups<2, vec<double>> {
  static SIMDBEZIER_INLINE vec<double> repeat(const double* values) {
    return vec<double>(_mm256_broadcast_pd(reinterpret_cast<const __m128d*>(values)));
  }
  static SIMDBEZIER_INLINE vec<double> spread(const double* values) {
    const __m256d both = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(values));
    return vec<double>(_mm256_permute_pd(both, 0b1100));
  }
};
#endif

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
