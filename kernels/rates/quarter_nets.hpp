// Control nets of the second derivatives of bicubic patches, over each of their four quarters:
// lanes are patches.
#pragma once

#include "kernels/nets/net_boxes.hpp"
#include "kernels/simd/repeat.hpp"

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
  [[nodiscard]] friend SIMDBEZIER_INLINE V dot(const SpaceVector& a, const SpaceVector& b) {
    return madd(a.x, b.x, madd(a.y, b.y, a.z * b.z));
  }
  [[nodiscard]] SIMDBEZIER_INLINE V square() const { return dot(*this, *this); }
};

/// One number for each second derivative: S_uu, S_uv, S_vv.
template <typename V>
struct SecondTerms {
  V uu;
  V uv;
  V vv;
};

/// Second derivatives in one place, as vectors.
template <typename V>
struct SecondVectors {
  SpaceVector<V> uu;
  SpaceVector<V> uv;
  SpaceVector<V> vv;
};

/// Control vectors of the second derivatives over the four quarters, raised to degrees 3, 3:
/// [j][i] of a net of 7 x 7. Quarter 2 * (half of v) + (half of u) has 4 x 4 of them, and its
/// outermost ones in common with its neighbours.
template <typename V>
struct QuarterNets {
  static constexpr std::size_t kSide = 7;

  SecondVectors<V> at[kSide * kSide];
  V largest_uu[4]; ///< of each quarter: its largest vectors
  V largest_vv[4];
};

/// Scratch memory of a group.
template <typename V>
struct RateScratch {
  SpaceVector<V> points[16]; ///< around the first one, over a power of two of about their size
  QuarterNets<V> nets;
};
template <typename V>
struct RateGroup {
  V size;                 ///< the power of two
  SecondTerms<V> largest; ///< vectors of the whole patch
  SecondTerms<V> doubt;   ///< what rounding may have taken from vectors
};

/// Raises both halves of a line from degrees 1 and 2 to 3. Factors are 1/3 and its double, which
/// takes a sum that multiplies, and rounds no differently.
template <std::size_t kValues, typename V, typename Put>
SIMDBEZIER_INLINE void raise_halves(const V* from, std::size_t step, Put put) {
  using T = ScalarOf<V>;
  static_assert(kValues == 2 || kValues == 3);
  const V two = broadcast<V>(T(2));
  const V third = broadcast<V>(T(1) / T(3));
  put(0, from[0]);
  for (std::size_t h = 0; h < 2; ++h) {
    const V* const line = from + h * (kValues - 1) * step;
    const V first = third * line[0];
    const V next = third * line[step];
    if constexpr (kValues == 2) {
      put(3 * h + 1, madd(two, first, next));
      put(3 * h + 2, madd(two, next, first));
    } else {
      put(3 * h + 1, madd(two, next, first));
      put(3 * h + 2, madd(two, next, third * line[2 * step]));
    }
    put(3 * h + 3, line[(kValues - 1) * step]);
  }
}

/// The control vectors of a patch's second derivatives: second differences times 6, 9 and 6.
template <typename V>
struct SecondDifferences {
  SpaceVector<V> uu[4 * 2]; ///< [j][i]
  SpaceVector<V> uv[3 * 3];
  SpaceVector<V> vv[2 * 4];

  SIMDBEZIER_INLINE explicit SecondDifferences(const SpaceVector<V> (&points)[16]) {
    using T = ScalarOf<V>;
    const V six = broadcast<V>(T(6));
    const V nine = broadcast<V>(T(9));
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 2; ++i) {
        const SpaceVector<V>* const row = points + 4 * j + i;
        uu[2 * j + i] = six * ((row[2] - row[1]) - (row[1] - row[0]));
        const SpaceVector<V>* const column = points + j + 4 * i;
        vv[4 * i + j] = six * ((column[8] - column[4]) - (column[4] - column[0]));
      }
    }
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t i = 0; i < 3; ++i) {
        const SpaceVector<V>* const at = points + 4 * j + i;
        uv[3 * j + i] = nine * ((at[5] - at[4]) - (at[1] - at[0]));
      }
    }
  }
};

/// Returns the length of the largest of some vectors.
template <std::size_t kCount, typename V>
SIMDBEZIER_INLINE V largest_length(const SpaceVector<V> (&vectors)[kCount]) {
  V found = vectors[0].square();
  for (std::size_t k = 1; k < kCount; ++k) {
    found = larger_of<V>(vectors[k].square(), found);
  }
  return square_root(found);
}

/// Forms the nets of S_uu over quarters (or S_vv: kAlongV), raised in the direction that has lost
/// two degrees. One component is formed at a time: what de Casteljau's algorithm works on stays in
/// registers, and each line across its direction is raised as soon as it is found.
template <bool kAlongV, typename V>
SIMDBEZIER_KERNEL void form_straight(const SecondDifferences<V>& second, V SpaceVector<V>::*c,
                                     QuarterNets<V>& nets) {
  const V half = broadcast<V>(ScalarOf<V>(0.5));
  // Lines of degree 3. Roundings depend on the order in which the directions are halved, which is
  // u, v: the line in the middle is halved itself, or found between the others when they are.
  V first[4];
  V middle[4];
  V last[4];
  repeat<4>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    first[k] = kAlongV ? second.vv[k].*c : second.uu[2 * k].*c;
    last[k] = kAlongV ? second.vv[4 + k].*c : second.uu[2 * k + 1].*c;
    middle[k] = half * (first[k] + last[k]);
  });
  const auto put_across = [&](std::size_t at, std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    const V across[3] = {first[k], kAlongV ? half * (first[k] + last[k]) : middle[k], last[k]};
    raise_halves<2>(across, 1, [&](std::size_t m, V value) SIMDBEZIER_INLINE_LAMBDA {
      (kAlongV ? nets.at[7 * m + at].vv : nets.at[7 * at + m].uu).*c = value;
    });
  };
  repeat<4>([&](std::size_t level) SIMDBEZIER_INLINE_LAMBDA {
    put_across(level, 0);
    if (level < 3) {
      put_across(6 - level, 3 - level);
    }
    for (std::size_t k = 0; k + level < 3; ++k) {
      first[k] = half * (first[k] + first[k + 1]);
      middle[k] = half * (middle[k] + middle[k + 1]);
      last[k] = half * (last[k] + last[k + 1]);
    }
  });
}

/// Forms the net of S_uv likewise.
template <typename V>
SIMDBEZIER_KERNEL void form_mixed(const SecondDifferences<V>& second, V SpaceVector<V>::*c,
                                  QuarterNets<V>& nets) {
  const V half = broadcast<V>(ScalarOf<V>(0.5));
  V rows[3][5];
  for (std::size_t j = 0; j < 3; ++j) {
    const SpaceVector<V>* const row = second.uv + 3 * j;
    rows[j][0] = row[0].*c;
    rows[j][4] = row[2].*c;
    rows[j][1] = half * (row[0].*c + row[1].*c);
    rows[j][3] = half * (row[1].*c + row[2].*c);
    rows[j][2] = half * (rows[j][1] + rows[j][3]);
  }
  V raised[5 * 7];
  const auto put_row = [&](std::size_t at, const V(&row)[5]) SIMDBEZIER_INLINE_LAMBDA {
    raise_halves<3>(row, 1, [&](std::size_t i, V value) SIMDBEZIER_INLINE_LAMBDA {
      raised[7 * at + i] = value;
    });
  };
  repeat<3>([&](std::size_t level) SIMDBEZIER_INLINE_LAMBDA {
    put_row(level, rows[0]);
    if (level < 2) {
      put_row(4 - level, rows[2 - level]);
    }
    for (std::size_t j = 0; j + level < 2; ++j) {
      for (std::size_t i = 0; i < 5; ++i) {
        rows[j][i] = half * (rows[j][i] + rows[j + 1][i]);
      }
    }
  });
  for (std::size_t i = 0; i < 7; ++i) {
    raise_halves<3>(raised + i, 7, [&](std::size_t j, V value) SIMDBEZIER_INLINE_LAMBDA {
      nets.at[7 * j + i].uv.*c = value;
    });
  }
}

/// Finds the largest vectors of the quarters, of degrees that have not been raised: raising keeps
/// the vectors of S_uu in columns 0, 3 and 6, and those of S_vv in such rows.
template <typename V>
SIMDBEZIER_INLINE void find_largest(QuarterNets<V>& nets) {
  V uu[2][3]; // of halves of columns
  V vv[2][3]; // of halves of rows
  repeat<6>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    const std::size_t half = k / 3;
    const std::size_t line = k % 3;
    const auto largest_of = [&](const SecondVectors<V>* at, std::size_t step, auto which)
                                SIMDBEZIER_INLINE_LAMBDA {
                                  V found = (at->*which).square();
                                  for (std::size_t m = 1; m < 4; ++m) {
                                    found = larger_of<V>((at[m * step].*which).square(), found);
                                  }
                                  return found;
                                };
    uu[half][line] = largest_of(nets.at + 21 * half + 3 * line, 7, &SecondVectors<V>::uu);
    vv[half][line] = largest_of(nets.at + 21 * line + 3 * half, 1, &SecondVectors<V>::vv);
  });
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t u = k % 2;
    const std::size_t v = k / 2;
    nets.largest_uu[k] = square_root(larger_of<V>(uu[v][u], uu[v][u + 1]));
    nets.largest_vv[k] = square_root(larger_of<V>(vv[u][v], vv[u][v + 1]));
  }
}

/// Forms the nets of the quarters, and finds the largest vectors of the whole patch.
template <typename V>
SIMDBEZIER_INLINE void form_quarters(RateScratch<V>& scratch, SecondTerms<V>& whole) {
  const SecondDifferences<V> second(scratch.points);
  whole = {largest_length(second.uu), largest_length(second.uv), largest_length(second.vv)};
  for (V SpaceVector<V>::*const c : {&SpaceVector<V>::x, &SpaceVector<V>::y, &SpaceVector<V>::z}) {
    form_straight<false>(second, c, scratch.nets);
    form_mixed(second, c, scratch.nets);
    form_straight<true>(second, c, scratch.nets);
  }
  find_largest(scratch.nets);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
