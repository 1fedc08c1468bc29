// How far the triangles of cells may be from bicubic patches: lanes are patches. The bound is that
// of src/mesh/rates/patch_bound.hpp; docs/tessellation.md has the proof.
#pragma once

#include "kernels/nets/quarter_nets.hpp"
#include "kernels/simd/lanes.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The largest whole number that is not above x, for 0 <= x below 2^22.
template <typename V>
SIMDBEZIER_INLINE V whole_part(V x) {
  using T = ScalarOf<V>;
  const V magic = broadcast<V>(static_cast<T>(T(1) / std::numeric_limits<T>::epsilon()));
  const V nearest = (x + magic) - magic;
  return select_where<V>(nearest > x, nearest - broadcast<V>(T(1)), nearest);
}
/// The smallest whole number that is not below x.
template <typename V>
SIMDBEZIER_INLINE V whole_above(V x) {
  const V below = whole_part<V>(x);
  return select_where<V>(below < x, below + broadcast<V>(ScalarOf<V>(1)), below);
}

/// Three edge terms of a triangle in order, and how far the largest one is above the sum of the
/// others. Where one of them is far smaller than the rest, differences of their products would have
/// few correct digits; differences of neighbours keep theirs.
template <typename V>
struct SortedTerms {
  V least;
  V middle;
  V largest;
  V excess;

  SIMDBEZIER_INLINE SortedTerms(V a, V c, V d) {
    const V low = smaller_of<V>(a, c);
    const V high = larger_of<V>(a, c);
    least = smaller_of<V>(low, d);
    middle = larger_of<V>(low, smaller_of<V>(high, d));
    largest = larger_of<V>(high, d);
    excess = (largest - middle) - least;
  }
  [[nodiscard]] SIMDBEZIER_INLINE MaskOf<V> obtuse() const {
    return excess >= broadcast<V>(ScalarOf<V>(0));
  }
  /// Returns twice the products of two terms, less the squares.
  [[nodiscard]] SIMDBEZIER_INLINE V divisor() const {
    const V product = (least + least) * (middle + middle);
    return product - excess * excess;
  }
};

/// Returns the largest value of sum l_i l_j q_ij / 2 over a triangle, for three squared edge terms.
template <typename V>
SIMDBEZIER_INLINE V triangle_bound(V a, V c, V d) {
  using T = ScalarOf<V>;
  const SortedTerms<V> terms(a, c, d);
  const V divisor = terms.divisor();
  const V inside = divide(terms.least * terms.middle * terms.largest,
                          larger_of<V>(divisor + divisor, broadcast<V>(kSmallest<T>)));
  return select_where<V>(terms.obtuse(), terms.largest * broadcast<V>(T(0.125)), inside);
}

/// The terms that every zone of cells is bounded by.
template <typename V>
struct ZoneTerms {
  V uu[4]; ///< of the quarters: h_u^2 |S_uu|, …
  V vv[4];
  V rising[4];
  V falling[4];
};

/// The segments in u and v of every lane, whole numbers.
template <typename V>
struct LaneCells {
  V nu;
  V nv;
};

/// The squares of steps, and what rounding may have taken from vectors that they are multiplied
/// with.
template <typename V>
struct CellSteps {
  V uu;
  V uv;
  V vv;
  V doubt;

  SIMDBEZIER_INLINE CellSteps(const LaneCells<V>& cells, const SecondTerms<V>& doubts) {
    using T = ScalarOf<V>;
    const V one = broadcast<V>(T(1));
    const V slack = broadcast<V>(T(4 * 0x1p-24));
    const V hu = divide(one, cells.nu) + slack;
    const V hv = divide(one, cells.nv) + slack;
    uu = hu * hu;
    uv = (hu + hu) * hv;
    vv = hv * hv;
    doubt = madd(uu, doubts.uu, madd(uv, doubts.uv, vv * doubts.vv));
  }
};

/// Squares of a vector along both diagonals of cells.
template <typename V>
struct DiagonalSquares {
  V rising;
  V falling;

  SIMDBEZIER_INLINE DiagonalSquares(const CellSteps<V>& step, const SpaceVector<V>& vector_uu,
                                    const SpaceVector<V>& vector_uv,
                                    const SpaceVector<V>& vector_vv) {
    const SpaceVector<V> s = step.uu * vector_uu + step.vv * vector_vv;
    const SpaceVector<V> t = step.uv * vector_uv;
    rising = (s + t).square();
    falling = (s - t).square();
  }
};

/// Finds the terms of edges along u and v, and takes the roots of the diagonals' terms, so far
/// squares.
template <typename V>
SIMDBEZIER_INLINE void finish_terms(const QuarterNets<V>& nets, const CellSteps<V>& step,
                                    const SecondTerms<V>& doubt, ZoneTerms<V>& terms) {
  for (std::size_t k = 0; k < 4; ++k) {
    terms.uu[k] = step.uu * (nets.largest[k].uu + doubt.uu);
    terms.vv[k] = step.vv * (nets.largest[k].vv + doubt.vv);
    terms.rising[k] = square_root(terms.rising[k]) + step.doubt;
    terms.falling[k] = square_root(terms.falling[k]) + step.doubt;
  }
}

/// Finds the terms of all quarters; vectors that quarters have in common are looked at only once.
template <typename V>
SIMDBEZIER_INLINE ZoneTerms<V> zone_terms(const QuarterNets<V>& nets, const LaneCells<V>& cells,
                                          const SecondTerms<V>& doubt) {
  const V zero = broadcast<V>(ScalarOf<V>(0));
  const CellSteps<V> step(cells, doubt);
  constexpr std::size_t kBegin[4] = {0, 3, 4, 7}; // low, common and high rows and columns
  V rising[3][3];
  V falling[3][3];
  for (std::size_t v = 0; v < 3; ++v) {
    for (std::size_t u = 0; u < 3; ++u) {
      V up = zero;
      V down = zero;
      for (std::size_t j = kBegin[v]; j < kBegin[v + 1]; ++j) {
        for (std::size_t i = kBegin[u]; i < kBegin[u + 1]; ++i) {
          const std::size_t k = 7 * j + i;
          const DiagonalSquares<V> squares(step, nets.uu[k], nets.uv[k], nets.vv[k]);
          up = larger_of<V>(squares.rising, up);
          down = larger_of<V>(squares.falling, down);
        }
      }
      rising[v][u] = up;
      falling[v][u] = down;
    }
  }
  ZoneTerms<V> terms;
  const auto of_quarter = [](const V(&parts)[3][3], std::size_t u,
                             std::size_t v) SIMDBEZIER_INLINE_LAMBDA {
    return larger_of<V>(larger_of<V>(parts[v][u], parts[v][u + 1]),
                        larger_of<V>(parts[v + 1][u], parts[v + 1][u + 1]));
  };
  for (std::size_t k = 0; k < 4; ++k) {
    terms.rising[k] = of_quarter(rising, k % 2, k / 2);
    terms.falling[k] = of_quarter(falling, k % 2, k / 2);
  }
  finish_terms(nets, step, doubt, terms);
  return terms;
}

template <typename V>
SIMDBEZIER_INLINE MaskOf<V> is_odd(V n) {
  const V half = broadcast<V>(ScalarOf<V>(0.5));
  return whole_part<V>(half * n) != half * n;
}

/// This is for the roundings of a bound itself, a few dozen.
template <typename T>
inline constexpr T kBoundSlack = T(1) + 64 * std::numeric_limits<T>::epsilon();

/// Returns the bound of every lane's cells. diagonals gets a bit for each zone (PatchRates), where
/// it is wanted.
template <typename V>
SIMDBEZIER_INLINE V worst_zone(const ZoneTerms<V>& terms, const LaneCells<V>& cells, V* diagonals) {
  using T = ScalarOf<V>;
  const V zero = broadcast<V>(T(0));
  const V one = broadcast<V>(T(1));
  const MaskOf<V> odd[2] = {is_odd<V>(cells.nu), is_odd<V>(cells.nv)};
  const MaskOf<V> several[2] = {cells.nu > one, cells.nv > one};
  V worst = zero;
  V bits = zero;
  for (std::size_t zone_v = 0; zone_v < 3; ++zone_v) {
    for (std::size_t zone_u = 0; zone_u < 3; ++zone_u) {
      V a = zero;
      V c = zero;
      V rising = zero;
      V falling = zero;
      for (std::size_t k = 0; k < 4; ++k) {
        if ((zone_u == 2 || k % 2 == zone_u) && (zone_v == 2 || k / 2 == zone_v)) {
          a = larger_of<V>(terms.uu[k], a);
          c = larger_of<V>(terms.vv[k], c);
          rising = larger_of<V>(terms.rising[k], rising);
          falling = larger_of<V>(terms.falling[k], falling);
        }
      }
      const MaskOf<V> occurs =
          (zone_u == 2 ? odd[0] : several[0]) & (zone_v == 2 ? odd[1] : several[1]);
      const V bound = triangle_bound<V>(a, c, smaller_of<V>(rising, falling));
      worst = larger_of<V>(select_where<V>(occurs, bound, zero), worst);
      if (diagonals != nullptr) {
        const V bit = broadcast<V>(static_cast<T>(1U << (3 * zone_v + zone_u)));
        bits = bits + select_where<V>(occurs & !(rising < falling), bit, zero);
      }
    }
  }
  if (diagonals != nullptr) {
    *diagonals = bits;
  }
  return worst * broadcast<V>(kBoundSlack<T>);
}

template <typename V>
SIMDBEZIER_INLINE V bound_of_cells(const QuarterNets<V>& nets, const LaneCells<V>& cells,
                                   const SecondTerms<V>& doubt, V* diagonals) {
  return worst_zone<V>(zone_terms(nets, cells, doubt), cells, diagonals);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
