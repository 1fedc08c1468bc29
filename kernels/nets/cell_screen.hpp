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

  /// The lanes of `mask` get the vectors of `by`.
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

/// The second derivatives that make each quarter's largest vectors along the two diagonals. They
/// are kept because for cells of about the same shape they most often make the largest ones again.
template <typename V>
struct LeadingVectors {
  SecondVectors<V> rising[4];
  SecondVectors<V> falling[4];
};

/// This is zone_terms(), and it finds the parts of the largest vectors.
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
  const SortedTerms<V> terms(a, c, d);
  const V divisor = terms.divisor();
  const MaskOf<V> side = terms.largest * broadcast<V>(ScalarOf<V>(0.125)) <= t;
  const MaskOf<V> circle = terms.least * terms.middle * terms.largest <= t * (divisor + divisor);
  return side & (circle | terms.obtuse());
}

/// The square of a vector along a diagonal, as a quadratic form of the steps.
template <typename V>
class SquareForm {
public:
  SIMDBEZIER_INLINE SquareForm(const SecondVectors<V>& of, bool rising)
      : squares_{of.uu.square(), of.uv.square(), of.vv.square()}, same_(dot(of.uu, of.vv)) {
    const V zero = broadcast<V>(ScalarOf<V>(0));
    mixed_u_ = rising ? dot(of.uu, of.uv) : zero - dot(of.uu, of.uv);
    mixed_v_ = rising ? dot(of.vv, of.uv) : zero - dot(of.vv, of.uv);
  }

  /// Returns a lower bound on it: less by the roundings, which are small beside the sum of the
  /// squares.
  [[nodiscard]] SIMDBEZIER_INLINE V at_least(const CellSteps<V>& step) const {
    using T = ScalarOf<V>;
    const V two_uv = step.uv + step.uv;
    const V squares = madd(step.uu * step.uu, squares_.uu,
                           madd(step.vv * step.vv, squares_.vv, step.uv * step.uv * squares_.uv));
    const V cross = madd((step.uu + step.uu) * step.vv, same_,
                         madd(two_uv * step.uu, mixed_u_, two_uv * step.vv * mixed_v_));
    return larger_of<V>(madd(squares, broadcast<V>(T(1) - T(1e-5)), cross), broadcast<V>(T(0)));
  }

private:
  static SIMDBEZIER_INLINE V dot(const SpaceVector<V>& a, const SpaceVector<V>& b) {
    return madd(a.x, b.x, madd(a.y, b.y, a.z * b.z));
  }

  SecondTerms<V> squares_;
  V same_;
  V mixed_u_;
  V mixed_v_;
};

/// Whether the bound of cells can be at most t at all, judged by what it would be, without
/// rounding, if each quarter had its leading vectors only. Zones across the middle combine the
/// terms of both halves, so their bound is no smaller than that of either half.
template <typename V>
class CellScreen {
public:
  SIMDBEZIER_INLINE CellScreen(const QuarterNets<V>& nets, const LeadingVectors<V>& leading,
                               const SecondTerms<V>& doubt, V t)
      : quarter_{{nets.largest[0], leading, 0, doubt},
                 {nets.largest[1], leading, 1, doubt},
                 {nets.largest[2], leading, 2, doubt},
                 {nets.largest[3], leading, 3, doubt}},
        doubt_(doubt), above_(t * broadcast<V>(ScalarOf<V>(1) + ScalarOf<V>(1e-3))) {}

  [[nodiscard]] SIMDBEZIER_INLINE MaskOf<V> may_hold(const LaneCells<V>& cells) const {
    const CellSteps<V> step(cells, doubt_);
    ZoneTerms<V> terms;
    for (std::size_t k = 0; k < 4; ++k) {
      terms.uu[k] = step.uu * quarter_[k].uu;
      terms.vv[k] = step.vv * quarter_[k].vv;
      terms.rising[k] = quarter_[k].rising.at_least(step);
      terms.falling[k] = quarter_[k].falling.at_least(step);
    }
    const MaskOf<V> odd[2] = {is_odd<V>(cells.nu), is_odd<V>(cells.nv)};
    for (V* const term : {terms.uu, terms.vv, terms.rising, terms.falling}) {
      const auto join = [&](std::size_t a, std::size_t b, MaskOf<V> in) SIMDBEZIER_INLINE_LAMBDA {
        const V both = larger_of<V>(term[a], term[b]);
        term[a] = select_where<V>(in, both, term[a]);
        term[b] = select_where<V>(in, both, term[b]);
      };
      join(0, 1, odd[0]);
      join(2, 3, odd[0]);
      join(0, 2, odd[1]);
      join(1, 3, odd[1]);
    }
    MaskOf<V> possible = above_ > broadcast<V>(ScalarOf<V>(0));
    for (std::size_t k = 0; k < 4; ++k) {
      const V across = square_root(smaller_of<V>(terms.rising[k], terms.falling[k])) + step.doubt;
      possible = possible & is_triangle_within<V>(terms.uu[k], terms.vv[k], across, above_);
    }
    return possible;
  }

private:
  struct Quarter {
    SquareForm<V> rising;
    SquareForm<V> falling;
    V uu;
    V vv;

    SIMDBEZIER_INLINE Quarter(const SecondTerms<V>& largest, const LeadingVectors<V>& leading,
                              std::size_t k, const SecondTerms<V>& doubt)
        : rising(leading.rising[k], true), falling(leading.falling[k], false),
          uu(largest.uu + doubt.uu), vv(largest.vv + doubt.vv) {}
  };

  Quarter quarter_[4];
  const SecondTerms<V>& doubt_;
  V above_; ///< t, and more than triangle_bound() may err by
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
