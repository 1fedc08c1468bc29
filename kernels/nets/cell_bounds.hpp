// How far the triangles of cells may be from bicubic patches: lanes are patches. The bound is that
// of src/mesh/patch_bound.hpp; docs/tessellation.md has the proof.
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

/// The largest value of sum l_i l_j q_ij / 2 over a triangle, for three squared edge terms.
template <typename V>
SIMDBEZIER_INLINE V triangle_bound(V a, V c, V d) {
  using T = ScalarOf<V>;
  const V largest = larger_of<V>(larger_of<V>(a, c), d);
  const V sum = a + c + d;
  const V products = madd(a, c, madd(c, d, d * a));
  const V squares = madd(a, a, madd(c, c, d * d));
  const V divisor = (products + products) - squares;
  const V inside = divide(a * c * d, larger_of<V>(divisor + divisor, broadcast<V>(kSmallest<T>)));
  return select_where<V>(largest + largest < sum, inside, largest * broadcast<V>(T(0.125)));
}

/// What every zone of cells is bounded by.
template <typename V>
struct ZoneTerms {
  V uu[4]; ///< of the quarters: h_u^2 |S_uu|, …
  V vv[4];
  V rising[4];
  V falling[4];
};

/// Segments in u and v of every lane, whole numbers.
template <typename V>
struct LaneCells {
  V nu;
  V nv;
};

template <typename V>
SIMDBEZIER_INLINE ZoneTerms<V> zone_terms(const QuarterNets<V> (&quarters)[4],
                                          const LaneCells<V>& cells, const SecondTerms<V>& doubt) {
  using T = ScalarOf<V>;
  const V one = broadcast<V>(T(1));
  const V slack = broadcast<V>(T(4 * 0x1p-24));
  const V hu = divide(one, cells.nu) + slack;
  const V hv = divide(one, cells.nv) + slack;
  const V uu = hu * hu;
  const V uv = (hu + hu) * hv;
  const V vv = hv * hv;
  const V rest = madd(uu, doubt.uu, madd(uv, doubt.uv, vv * doubt.vv));
  ZoneTerms<V> terms;
  for (std::size_t k = 0; k < 4; ++k) {
    const QuarterNets<V>& q = quarters[k];
    V rising = broadcast<V>(T(0));
    V falling = rising;
    for (std::size_t i = 0; i < 16; ++i) {
      const SpaceVector<V> s = uu * q.uu[i] + vv * q.vv[i];
      const SpaceVector<V> t = uv * q.uv[i];
      rising = larger_of<V>((s + t).square(), rising);
      falling = larger_of<V>((s - t).square(), falling);
    }
    terms.uu[k] = uu * (square_root(q.largest.uu) + doubt.uu);
    terms.vv[k] = vv * (square_root(q.largest.vv) + doubt.vv);
    terms.rising[k] = square_root(rising) + rest;
    terms.falling[k] = square_root(falling) + rest;
  }
  return terms;
}

/// The bound of every lane's cells; diagonals: a bit for each zone (PatchRates), where wanted.
template <typename V>
SIMDBEZIER_INLINE V bound_of_cells(const QuarterNets<V> (&quarters)[4], const LaneCells<V>& cells,
                                   const SecondTerms<V>& doubt, V* diagonals) {
  using T = ScalarOf<V>;
  const V zero = broadcast<V>(T(0));
  const ZoneTerms<V> terms = zone_terms(quarters, cells, doubt);
  const V half = broadcast<V>(T(0.5));
  const auto is_odd = [&](V n)
                          SIMDBEZIER_INLINE_LAMBDA { return whole_part<V>(half * n) != half * n; };
  const V one = broadcast<V>(T(1));
  const MaskOf<V> odd[2] = {is_odd(cells.nu), is_odd(cells.nv)};
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
  // The roundings of the bound itself, a few dozen.
  return worst * broadcast<V>(T(1) + 64 * std::numeric_limits<T>::epsilon());
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
