// Which cells cannot hold, found without looking at all control vectors: by those that set the
// bound of cells of about the same shape.
#pragma once

#include "kernels/nets/cell_bounds.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Second derivatives in one place, as vectors.
template <typename V>
struct SecondVectors {
  SpaceVector<V> uu;
  SpaceVector<V> uv;
  SpaceVector<V> vv;

  /// Those with `mask` become others.
  SIMDBEZIER_INLINE void replace(MaskOf<V> mask, const SecondVectors& by) {
    const auto choose = [&](SpaceVector<V>& old,
                            const SpaceVector<V>& other) SIMDBEZIER_INLINE_LAMBDA {
      old = {select_where<V>(mask, other.x, old.x), select_where<V>(mask, other.y, old.y),
             select_where<V>(mask, other.z, old.z)};
    };
    choose(uu, by.uu);
    choose(uv, by.uv);
    choose(vv, by.vv);
  }
};

/// Of each quarter, what its largest vectors along the two diagonals were made of. For cells of
/// about the same shape these are most often the largest ones again.
template <typename V>
struct LeadingVectors {
  SecondVectors<V> rising[4];
  SecondVectors<V> falling[4];
};

/// zone_terms(), and the largest vectors' parts.
template <typename V>
SIMDBEZIER_INLINE ZoneTerms<V> leading_terms(const QuarterNets<V>& nets, const LaneCells<V>& cells,
                                             const SecondTerms<V>& doubt,
                                             LeadingVectors<V>& leading) {
  const V none = broadcast<V>(ScalarOf<V>(-1));
  const CellSteps<V> step(cells, doubt);
  ZoneTerms<V> terms;
  for (std::size_t k = 0; k < 4; ++k) {
    V rising = none;
    V falling = none;
    SecondVectors<V> up{};
    SecondVectors<V> down{};
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t at = QuarterNets<V>::first_of(k) + 7 * j + i;
        const SecondVectors<V> parts{nets.uu[at], nets.uv[at], nets.vv[at]};
        const DiagonalSquares<V> squares(step, parts.uu, parts.uv, parts.vv);
        up.replace(squares.rising > rising, parts);
        down.replace(squares.falling > falling, parts);
        rising = larger_of<V>(squares.rising, rising);
        falling = larger_of<V>(squares.falling, falling);
      }
    }
    leading.rising[k] = up;
    leading.falling[k] = down;
    terms.rising[k] = rising;
    terms.falling[k] = falling;
  }
  finish_terms(nets, step, doubt, terms);
  return terms;
}

/// Whether triangle_bound() may be at most t, by products instead of a quotient.
template <typename V>
SIMDBEZIER_INLINE MaskOf<V> is_triangle_within(V a, V c, V d, V t) {
  using T = ScalarOf<V>;
  const V largest = larger_of<V>(larger_of<V>(a, c), d);
  const V products = madd(a, c, madd(c, d, d * a));
  const V squares = madd(a, a, madd(c, c, d * d));
  const V divisor = (products + products) - squares;
  const MaskOf<V> obtuse = largest + largest >= a + c + d;
  return (largest * broadcast<V>(T(0.125)) <= t) &
         (obtuse | (a * c * d <= t * (divisor + divisor)));
}

/// Whether a bound can at all be at most t: what it would be, but for rounding, if each quarter had
/// its leading vectors only. In zones across the middle, terms of both halves come together, which
/// have no smaller bound than each of them.
template <typename V>
SIMDBEZIER_INLINE MaskOf<V> may_hold(const QuarterNets<V>& nets, const LeadingVectors<V>& leading,
                                     const LaneCells<V>& cells, const SecondTerms<V>& doubt, V t) {
  using T = ScalarOf<V>;
  const CellSteps<V> step(cells, doubt);
  ZoneTerms<V> terms;
  const auto square = [&](const SecondVectors<V>& v, bool rises) SIMDBEZIER_INLINE_LAMBDA {
    const SpaceVector<V> s = step.uu * v.uu + step.vv * v.vv;
    const SpaceVector<V> m = step.uv * v.uv;
    return (rises ? s + m : s - m).square();
  };
  for (std::size_t k = 0; k < 4; ++k) {
    terms.uu[k] = step.uu * (nets.largest[k].uu + doubt.uu);
    terms.vv[k] = step.vv * (nets.largest[k].vv + doubt.vv);
    terms.rising[k] = square(leading.rising[k], true);
    terms.falling[k] = square(leading.falling[k], false);
  }
  const MaskOf<V> odd[2] = {is_odd<V>(cells.nu), is_odd<V>(cells.nv)};
  for (V* const term : {terms.uu, terms.vv, terms.rising, terms.falling}) {
    const auto join = [&](std::size_t a, std::size_t b, MaskOf<V> where) SIMDBEZIER_INLINE_LAMBDA {
      const V both = larger_of<V>(term[a], term[b]);
      term[a] = select_where<V>(where, both, term[a]);
      term[b] = select_where<V>(where, both, term[b]);
    };
    join(0, 1, odd[0]);
    join(2, 3, odd[0]);
    join(0, 2, odd[1]);
    join(1, 3, odd[1]);
  }
  // More than triangle_bound() may err by.
  const V above = t * broadcast<V>(T(1) + T(1e-3));
  MaskOf<V> possible = above > broadcast<V>(T(0));
  for (std::size_t k = 0; k < 4; ++k) {
    const V across = square_root(smaller_of<V>(terms.rising[k], terms.falling[k])) + step.doubt;
    possible = possible & is_triangle_within<V>(terms.uu[k], terms.vv[k], across, above);
  }
  return possible;
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
