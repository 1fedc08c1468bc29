// Planes into packed records, for registers of 256 bits.
#pragma once

#include <utility>

#include "kernels/simd/interleave.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

// Triples: no two values of a plane that belong to different results go to the same lane, since 3
// and the number of lanes have no common divisor. So each plane is turned once, for all results,
// and these are blended, which is cheaper than a shuffle.

/// Returns the record whose member `member` belongs to lane `lane` of a line.
SIMDBEZIER_INLINE constexpr int turned(std::size_t member, std::size_t lane, std::size_t lanes) {
  std::size_t e = lane;
  while (e % 3 != member) {
    e += lanes;
  }
  return static_cast<int>(e / 3);
}

template <std::size_t kMember, typename Part, std::size_t... kLane>
SIMDBEZIER_INLINE Part turn_plane(Part plane, std::index_sequence<kLane...>) {
  return __builtin_shufflevector(plane, plane, turned(kMember, kLane, sizeof...(kLane))...);
}

template <std::size_t kLine, typename Part, std::size_t... kLane>
SIMDBEZIER_INLINE Part blend_line(Part x, Part y, Part z, std::index_sequence<kLane...>) {
  constexpr std::size_t kN = sizeof...(kLane);
  const Part xy = __builtin_shufflevector(
      x, y, static_cast<int>((kLine * kN + kLane) % 3 == 1 ? kN + kLane : kLane)...);
  return __builtin_shufflevector(
      xy, z, static_cast<int>((kLine * kN + kLane) % 3 == 2 ? kN + kLane : kLane)...);
}

/// Puts a part of each plane into packed records.
template <typename T>
SIMDBEZIER_INLINE void form_records(const LinePart<T> (&p)[3], LinePart<T> (&line)[3]) {
  constexpr auto kLanes = std::make_index_sequence<kPartLanes<T>>{};
  const LinePart<T> x = turn_plane<0>(p[0], kLanes);
  const LinePart<T> y = turn_plane<1>(p[1], kLanes);
  const LinePart<T> z = turn_plane<2>(p[2], kLanes);
  line[0] = blend_line<0>(x, y, z, kLanes);
  line[1] = blend_line<1>(x, y, z, kLanes);
  line[2] = blend_line<2>(x, y, z, kLanes);
}

/// These two return the lower and the upper halves of a and b.
template <typename Part>
SIMDBEZIER_INLINE Part lower_halves(Part a, Part b) {
  return __builtin_bit_cast(Part, _mm256_permute2f128_ps(__builtin_bit_cast(__m256, a),
                                                         __builtin_bit_cast(__m256, b), 0x20));
}
template <typename Part>
SIMDBEZIER_INLINE Part upper_halves(Part a, Part b) {
  return __builtin_bit_cast(Part, _mm256_permute2f128_ps(__builtin_bit_cast(__m256, a),
                                                         __builtin_bit_cast(__m256, b), 0x31));
}

/// The three pieces of 128 bits that two records are, of planes whose members are joined to pairs.
SIMDBEZIER_INLINE void pieces_of(const __m256d (&pair)[3], LinePart<float> (&piece)[3]) {
  piece[0] = __builtin_bit_cast(LinePart<float>, _mm256_unpacklo_pd(pair[0], pair[1]));
  piece[1] = __builtin_bit_cast(LinePart<float>, _mm256_shuffle_pd(pair[2], pair[0], 0b1010));
  piece[2] = __builtin_bit_cast(LinePart<float>, _mm256_unpackhi_pd(pair[1], pair[2]));
}

/// Puts six planes into records: in each half first, where a has the samples 0 1 (of doubles 0),
/// and b has 2 3 (1).
template <typename T>
SIMDBEZIER_INLINE void form_records(const LinePart<T> (&p)[6], LinePart<T> (&line)[6]) {
  LinePart<T> a[3];
  LinePart<T> b[3];
  if constexpr (kGroupLanes<T> == 4) {
    const auto low = [&p](std::size_t m) SIMDBEZIER_INLINE_LAMBDA {
      return _mm256_castps_pd(_mm256_unpacklo_ps(p[2 * m], p[2 * m + 1]));
    };
    const auto high = [&p](std::size_t m) SIMDBEZIER_INLINE_LAMBDA {
      return _mm256_castps_pd(_mm256_unpackhi_ps(p[2 * m], p[2 * m + 1]));
    };
    pieces_of({low(0), low(1), low(2)}, a);
    pieces_of({high(0), high(1), high(2)}, b);
  } else {
    a[0] = _mm256_unpacklo_pd(p[0], p[1]);
    a[1] = _mm256_unpacklo_pd(p[2], p[3]);
    a[2] = _mm256_unpacklo_pd(p[4], p[5]);
    b[0] = _mm256_unpackhi_pd(p[0], p[1]);
    b[1] = _mm256_unpackhi_pd(p[2], p[3]);
    b[2] = _mm256_unpackhi_pd(p[4], p[5]);
  }
  line[0] = lower_halves(a[0], a[1]);
  line[1] = lower_halves(a[2], b[0]);
  line[2] = lower_halves(b[1], b[2]);
  line[3] = upper_halves(a[0], a[1]);
  line[4] = upper_halves(a[2], b[0]);
  line[5] = upper_halves(b[1], b[2]);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
