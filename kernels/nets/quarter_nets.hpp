// Control nets of the second derivatives of bicubic patches, over each of their four quarters:
// lanes are patches.
#pragma once

#include "kernels/nets/net_boxes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// A vector in space, of as many patches as a register has lanes.
template <typename V>
struct SpaceVector {
  V x;
  V y;
  V z;

  friend SIMDBEZIER_INLINE SpaceVector operator+(const SpaceVector& a, const SpaceVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend SIMDBEZIER_INLINE SpaceVector operator-(const SpaceVector& a, const SpaceVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend SIMDBEZIER_INLINE SpaceVector operator*(V s, const SpaceVector& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  [[nodiscard]] SIMDBEZIER_INLINE V square() const { return madd(x, x, madd(y, y, z * z)); }
};

/// One number for each second derivative: S_uu, S_uv, S_vv.
template <typename V>
struct SecondTerms {
  V uu;
  V uv;
  V vv;
};

/// The second derivatives of one quarter.
template <typename V>
struct QuarterNets {
  SecondTerms<V> largest; ///< squares of the largest vectors
  SpaceVector<V> uu[16];  ///< raised to degrees 3, 3: [j][i]
  SpaceVector<V> uv[16];
  SpaceVector<V> vv[16];
};

/// Scratch of a group, and what bounds need besides.
template <typename V>
struct RateScratch {
  SpaceVector<V> points[16]; ///< around the first one, over a power of two of about their size
  QuarterNets<V> quarter[4];
};
template <typename V>
struct RateGroup {
  V size;                 ///< the power of two
  SecondTerms<V> largest; ///< vectors of the whole patch
  SecondTerms<V> doubt;   ///< what rounding may have taken from vectors
};

/// Both halves of a line of control vectors of degree n.
template <std::size_t kOrder, typename V>
SIMDBEZIER_INLINE void halve(const SpaceVector<V>* line, std::size_t step, SpaceVector<V>* low,
                             SpaceVector<V>* high) {
  const V half = broadcast<V>(ScalarOf<V>(0.5));
  SpaceVector<V> part[kOrder];
  for (std::size_t k = 0; k < kOrder; ++k) {
    part[k] = line[k * step];
  }
  for (std::size_t level = 0; level < kOrder; ++level) {
    low[level * step] = part[0];
    high[(kOrder - 1 - level) * step] = part[kOrder - 1 - level];
    for (std::size_t k = 0; k + 1 + level < kOrder; ++k) {
      part[k] = half * (part[k] + part[k + 1]);
    }
  }
}

/// Four quarters of a net of kColumns x kRows, number 2 * (half of v) + (half of u).
template <std::size_t kColumns, std::size_t kRows, typename V>
SIMDBEZIER_INLINE void quarter_net(const SpaceVector<V>* net,
                                   SpaceVector<V> (&to)[4][kColumns * kRows]) {
  SpaceVector<V> halves[2][kColumns * kRows];
  for (std::size_t j = 0; j < kRows; ++j) {
    halve<kColumns>(net + j * kColumns, 1, halves[0] + j * kColumns, halves[1] + j * kColumns);
  }
  for (std::size_t h = 0; h < 2; ++h) {
    for (std::size_t i = 0; i < kColumns; ++i) {
      halve<kRows>(halves[h] + i, kColumns, to[h] + i, to[2 + h] + i);
    }
  }
}

template <std::size_t kCount, typename V>
SIMDBEZIER_INLINE V largest_square(const SpaceVector<V> (&net)[kCount]) {
  V largest = net[0].square();
  for (std::size_t k = 1; k < kCount; ++k) {
    largest = larger_of<V>(net[k].square(), largest);
  }
  return largest;
}

/// Second differences times 6 in one direction, or 9 of mixed ones.
template <typename V>
SIMDBEZIER_INLINE void second_differences(const SpaceVector<V>* p, SpaceVector<V> (&uu)[8],
                                          SpaceVector<V> (&uv)[9], SpaceVector<V> (&vv)[8]) {
  using T = ScalarOf<V>;
  const V six = broadcast<V>(T(6));
  const V nine = broadcast<V>(T(9));
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 2; ++i) {
      const SpaceVector<V>* const at = p + 4 * j + i;
      uu[2 * j + i] = six * ((at[2] - at[1]) - (at[1] - at[0]));
    }
  }
  for (std::size_t j = 0; j < 2; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const SpaceVector<V>* const at = p + 4 * j + i;
      vv[4 * j + i] = six * ((at[8] - at[4]) - (at[4] - at[0]));
    }
  }
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      const SpaceVector<V>* const at = p + 4 * j + i;
      uv[3 * j + i] = nine * ((at[5] - at[4]) - (at[1] - at[0]));
    }
  }
}

/// From degrees 1 and 2 to 3, for control vectors `step` apart.
template <typename V>
SIMDBEZIER_INLINE void raise_line(const SpaceVector<V>* from, std::size_t order, std::size_t step,
                                  SpaceVector<V>* to, std::size_t to_step) {
  using T = ScalarOf<V>;
  const V third = broadcast<V>(T(1) / T(3));
  const V rest = broadcast<V>(T(2) / T(3));
  to[0] = from[0];
  to[3 * to_step] = from[(order - 1) * step];
  if (order == 2) {
    to[to_step] = rest * from[0] + third * from[step];
    to[2 * to_step] = third * from[0] + rest * from[step];
  } else {
    to[to_step] = third * from[0] + rest * from[step];
    to[2 * to_step] = rest * from[step] + third * from[2 * step];
  }
}

template <typename V>
SIMDBEZIER_INLINE void raise_quarter(const SpaceVector<V> (&uu)[8], const SpaceVector<V> (&uv)[9],
                                     const SpaceVector<V> (&vv)[8], QuarterNets<V>& to) {
  to.largest = {largest_square(uu), largest_square(uv), largest_square(vv)};
  for (std::size_t j = 0; j < 4; ++j) {
    raise_line(uu + 2 * j, 2, 1, to.uu + 4 * j, 1);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    raise_line(vv + i, 2, 4, to.vv + i, 4);
  }
  SpaceVector<V> rows[12];
  for (std::size_t j = 0; j < 3; ++j) {
    raise_line(uv + 3 * j, 3, 1, rows + 4 * j, 1);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    raise_line(rows + i, 3, 4, to.uv + i, 4);
  }
}

/// The quarters' nets, and the largest squares of the whole patch. A function of its own, or its
/// arrays would be in the way of what follows.
template <typename V>
__attribute__((noinline)) void form_quarters(RateScratch<V>& scratch, SecondTerms<V>& whole) {
  SpaceVector<V> uu[8];
  SpaceVector<V> uv[9];
  SpaceVector<V> vv[8];
  second_differences(scratch.points, uu, uv, vv);
  whole = {largest_square(uu), largest_square(uv), largest_square(vv)};
  SpaceVector<V> uu_parts[4][8];
  SpaceVector<V> uv_parts[4][9];
  SpaceVector<V> vv_parts[4][8];
  quarter_net<2, 4>(uu, uu_parts);
  quarter_net<3, 3>(uv, uv_parts);
  quarter_net<4, 2>(vv, vv_parts);
  for (std::size_t k = 0; k < 4; ++k) {
    raise_quarter(uu_parts[k], uv_parts[k], vv_parts[k], scratch.quarter[k]);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
