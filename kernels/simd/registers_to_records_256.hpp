// Planes into packed records, for registers of 256 bits.
#pragma once

#include <utility>

#include "kernels/simd/interleave.hpp"
#include "kernels/simd/quad_transpose.hpp"
#include "kernels/simd/repeat.hpp"

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

/// Turns planes whose members are joined to pairs into pieces of 128 bits, three for two records.
SIMDBEZIER_INLINE void form_pieces(LinePart<float> (&pair)[3]) {
  const auto as_doubles = [&](std::size_t m) SIMDBEZIER_INLINE_LAMBDA {
    return __builtin_bit_cast(__m256d, pair[m]);
  };
  const __m256d middle = _mm256_shuffle_pd(as_doubles(2), as_doubles(0), 0b1010);
  pair[0] = zip<float, 2, false>(pair[0], pair[1]);
  pair[2] = zip<float, 2, true>(pair[1], pair[2]);
  pair[1] = __builtin_bit_cast(LinePart<float>, middle);
}

/// Puts six planes into records: in each half first, where a has the samples 0 1 (of doubles 0),
/// and b has 2 3 (1).
template <typename T>
SIMDBEZIER_INLINE void form_records(const LinePart<T> (&p)[6], LinePart<T> (&line)[6]) {
  LinePart<T> a[3];
  LinePart<T> b[3];
  repeat<3>([&](std::size_t m) SIMDBEZIER_INLINE_LAMBDA {
    a[m] = zip<T, 1, false>(p[2 * m], p[2 * m + 1]);
    b[m] = zip<T, 1, true>(p[2 * m], p[2 * m + 1]);
  });
  if constexpr (kGroupLanes<T> == 4) {
    form_pieces(a);
    form_pieces(b);
  }
  const LinePart<T> piece[6] = {a[0], a[1], a[2], b[0], b[1], b[2]};
  constexpr std::size_t kAll = kPartLanes<T>;
  repeat<3>([&](std::size_t m) SIMDBEZIER_INLINE_LAMBDA {
    line[m] = zip<T, kAll / 2, false, kAll>(piece[2 * m], piece[2 * m + 1]);
    line[3 + m] = zip<T, kAll / 2, true, kAll>(piece[2 * m], piece[2 * m + 1]);
  });
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
