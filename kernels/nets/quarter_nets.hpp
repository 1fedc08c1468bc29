// Control nets of the second derivatives of bicubic patches, over each of their four quarters:
// lanes are patches.
#pragma once

#include <type_traits>

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

/// Control vectors of the second derivatives over the four quarters, raised to degrees 3, 3:
/// [j][i] of a net of 7 x 7. Quarter 2 * (half of v) + (half of u) has 4 x 4 of them, and its
/// outermost ones in common with its neighbours.
template <typename V>
struct QuarterNets {
  static constexpr std::size_t kSide = 7;

  SpaceVector<V> uu[kSide * kSide];
  SpaceVector<V> uv[kSide * kSide];
  SpaceVector<V> vv[kSide * kSide];
  SecondTerms<V> largest[4]; ///< of each quarter: its largest vectors

  static constexpr std::size_t first_of(std::size_t quarter) {
    return 3 * (quarter / 2) * kSide + 3 * (quarter % 2);
  }
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

/// Finds the control values of both halves of a line, which have one in common.
template <std::size_t kValues, typename V>
SIMDBEZIER_INLINE void halve(const V* line, std::size_t step, V* to, std::size_t to_step) {
  const V half = broadcast<V>(ScalarOf<V>(0.5));
  V part[kValues];
  for (std::size_t k = 0; k < kValues; ++k) {
    part[k] = line[k * step];
  }
  for (std::size_t level = 0; level < kValues; ++level) {
    to[level * to_step] = part[0];
    to[(2 * kValues - 2 - level) * to_step] = part[kValues - 1 - level];
    for (std::size_t k = 0; k + 1 + level < kValues; ++k) {
      part[k] = half * (part[k] + part[k + 1]);
    }
  }
}

/// Cuts a net of kColumns x kRows into quarters, side by side.
template <std::size_t kColumns, std::size_t kRows, typename V>
SIMDBEZIER_INLINE void quarter_net(const V (&net)[kColumns * kRows],
                                   V (&to)[(2 * kColumns - 1) * (2 * kRows - 1)]) {
  constexpr std::size_t kWide = 2 * kColumns - 1;
  V halves[kWide * kRows];
  for (std::size_t j = 0; j < kRows; ++j) {
    halve<kColumns>(net + j * kColumns, 1, halves + j * kWide, 1);
  }
  for (std::size_t i = 0; i < kWide; ++i) {
    halve<kRows>(halves + i, kWide, to + i, kWide);
  }
}

/// Raises both halves of a line from degrees 1 and 2 to 3.
template <std::size_t kValues, typename V, typename Put>
SIMDBEZIER_INLINE void raise_halves(const V* from, std::size_t step, Put put) {
  using T = ScalarOf<V>;
  static_assert(kValues == 2 || kValues == 3);
  const V third = broadcast<V>(T(1) / T(3));
  const V rest = broadcast<V>(T(2) / T(3));
  put(0, from[0]);
  for (std::size_t h = 0; h < 2; ++h) {
    const V* const line = from + h * (kValues - 1) * step;
    if constexpr (kValues == 2) {
      put(3 * h + 1, rest * line[0] + third * line[step]);
      put(3 * h + 2, third * line[0] + rest * line[step]);
    } else {
      put(3 * h + 1, third * line[0] + rest * line[step]);
      put(3 * h + 2, rest * line[step] + third * line[2 * step]);
    }
    put(3 * h + 3, line[(kValues - 1) * step]);
  }
}

/// Squares of vectors, summed up component by component: z, y, x.
template <typename V>
struct SecondSquares {
  V whole_uu[8];
  V whole_uv[9];
  V whole_vv[8];
  V uu[3 * 7]; ///< of quarters side by side, as in quarter_net()
  V uv[5 * 5];
  V vv[7 * 3];

  template <bool kFirst, std::size_t kCount>
  static SIMDBEZIER_INLINE void add(const V (&values)[kCount], V (&to)[kCount]) {
    for (std::size_t k = 0; k < kCount; ++k) {
      to[k] = kFirst ? values[k] * values[k] : madd(values[k], values[k], to[k]);
    }
  }
  /// Returns the largest vector among some rows of a net of kColumns.
  template <std::size_t kColumns>
  static SIMDBEZIER_INLINE V largest(const V* net, std::size_t columns, std::size_t rows) {
    V found = net[0];
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        found = larger_of<V>(net[j * kColumns + i], found);
      }
    }
    return square_root(found);
  }
  [[nodiscard]] SIMDBEZIER_INLINE SecondTerms<V> whole() const {
    return {largest<2>(whole_uu, 2, 4), largest<3>(whole_uv, 3, 3), largest<4>(whole_vv, 4, 2)};
  }
  [[nodiscard]] SIMDBEZIER_INLINE SecondTerms<V> of(std::size_t u, std::size_t v) const {
    return {largest<3>(uu + 3 * 3 * v + u, 2, 4), largest<5>(uv + 5 * 2 * v + 2 * u, 3, 3),
            largest<7>(vv + 7 * v + 3 * u, 4, 2)};
  }
};

/// Forms S_uu (or S_vv: kAlongV): second differences times 6, over quarters, raised in the
/// direction that has lost two degrees. One component is formed at a time, since it stays in
/// registers.
template <bool kAlongV, bool kFirst, typename V>
SIMDBEZIER_KERNEL void form_straight(RateScratch<V>& scratch, V SpaceVector<V>::*c,
                                     SecondSquares<V>& squares) {
  constexpr std::size_t kStep = kAlongV ? 4 : 1;
  constexpr std::size_t kColumns = kAlongV ? 4 : 2;
  const V six = broadcast<V>(ScalarOf<V>(6));
  V second[8];
  for (std::size_t k = 0; k < 8; ++k) {
    const SpaceVector<V>* const at = scratch.points + 4 * (k / kColumns) + k % kColumns;
    second[k] = six * ((at[2 * kStep].*c - at[kStep].*c) - (at[kStep].*c - at[0].*c));
  }
  squares.template add<kFirst>(second, kAlongV ? squares.whole_vv : squares.whole_uu);
  V parts[21];
  quarter_net<kColumns, 8 / kColumns>(second, parts);
  squares.template add<kFirst>(parts, kAlongV ? squares.vv : squares.uu);
  SpaceVector<V>* const net = kAlongV ? scratch.nets.vv : scratch.nets.uu;
  for (std::size_t line = 0; line < 7; ++line) {
    raise_halves<2>(parts + (kAlongV ? 1 : 3) * line, kAlongV ? 7 : 1,
                    [&](std::size_t k, V value) SIMDBEZIER_INLINE_LAMBDA {
                      net[kAlongV ? 7 * k + line : 7 * line + k].*c = value;
                    });
  }
}
/// Forms S_uv likewise, by differences in both directions times 9.
template <bool kFirst, typename V>
SIMDBEZIER_KERNEL void form_mixed(RateScratch<V>& scratch, V SpaceVector<V>::*c,
                                  SecondSquares<V>& squares) {
  const V nine = broadcast<V>(ScalarOf<V>(9));
  V uv[9];
  for (std::size_t k = 0; k < 9; ++k) {
    const SpaceVector<V>* const at = scratch.points + 4 * (k / 3) + k % 3;
    uv[k] = nine * ((at[5].*c - at[4].*c) - (at[1].*c - at[0].*c));
  }
  squares.template add<kFirst>(uv, squares.whole_uv);
  V parts[25];
  quarter_net<3, 3>(uv, parts);
  squares.template add<kFirst>(parts, squares.uv);
  V rows[35];
  for (std::size_t j = 0; j < 5; ++j) {
    raise_halves<3>(parts + 5 * j, 1, [&](std::size_t i, V value) SIMDBEZIER_INLINE_LAMBDA {
      rows[7 * j + i] = value;
    });
  }
  for (std::size_t i = 0; i < 7; ++i) {
    raise_halves<3>(rows + i, 7, [&](std::size_t j, V value) SIMDBEZIER_INLINE_LAMBDA {
      scratch.nets.uv[7 * j + i].*c = value;
    });
  }
}
/// Forms the nets of the quarters, and finds the largest vectors of the whole patch.
template <typename V>
SIMDBEZIER_INLINE void form_quarters(RateScratch<V>& scratch, SecondTerms<V>& whole) {
  using S = SpaceVector<V>;
  SecondSquares<V> squares;
  const auto form = [&]<bool kFirst>(std::bool_constant<kFirst>, V S::*c) SIMDBEZIER_INLINE_LAMBDA {
    form_straight<false, kFirst>(scratch, c, squares);
    form_mixed<kFirst>(scratch, c, squares);
    form_straight<true, kFirst>(scratch, c, squares);
  };
  form(std::true_type(), &S::z);
  form(std::false_type(), &S::y);
  form(std::false_type(), &S::x);
  whole = squares.whole();
  for (std::size_t k = 0; k < 4; ++k) {
    scratch.nets.largest[k] = squares.of(k % 2, k / 2);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
