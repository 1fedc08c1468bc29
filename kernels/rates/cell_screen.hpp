// Which cells cannot hold, found without looking at all control vectors: by those that set the
// bound of cells of about the same shape.
#pragma once

#include "kernels/rates/cell_bounds.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The largest of some squares, and the place of the vector that it is the square of.
template <typename V>
struct LeadingSquare {
  V square;
  V place;

  SIMDBEZIER_INLINE void include(V other, V at) {
    place = select_where<V>(other > square, at, place);
    square = larger_of<V>(other, square);
  }
  SIMDBEZIER_INLINE void include(const LeadingSquare& other) { include(other.square, other.place); }
};

/// Returns the vectors in every lane's place. Keeping those of the largest squares in registers
/// would take nine selections for every vector that is looked at.
template <typename V>
SIMDBEZIER_INLINE SecondVectors<V> vectors_at(const QuarterNets<V>& nets, V place) {
  using T = ScalarOf<V>;
  constexpr std::size_t kValues = sizeof(SecondVectors<V>) / sizeof(T);
  alignas(64) T first[kLanes<V>];
  store_vector<V>(first, place * broadcast<V>(T(kValues)));
  const T* lanes[kLanes<V>];
  repeat<kLanes<V>>([&](std::size_t p) SIMDBEZIER_INLINE_LAMBDA {
    lanes[p] = reinterpret_cast<const T*>(nets.at) + static_cast<std::ptrdiff_t>(first[p]) + p;
  });
  const auto vector = [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    const auto component = [&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
      return from_lanes<V>([&](std::size_t p) SIMDBEZIER_INLINE_LAMBDA {
        return lanes[p][(3 * k + c) * kLanes<V>];
      });
    };
    return SpaceVector<V>{component(0), component(1), component(2)};
  };
  return {vector(0), vector(1), vector(2)};
}

/// Whether triangle_bound() may be at most an eighth of `limit`, by products instead of a quotient.
template <typename V>
SIMDBEZIER_INLINE MaskOf<V> is_triangle_within(V a, V c, V d, V limit) {
  using T = ScalarOf<V>;
  const V low = smaller_of<V>(a, c);
  const V high = larger_of<V>(a, c);
  const V other = smaller_of<V>(high, d);
  const V largest = larger_of<V>(high, d);
  // What obtuse triangles have too much counts as nothing: then the largest term decides.
  const V excess = smaller_of<V>((largest - other) - low, broadcast<V>(T(0)));
  const V quarter = limit * broadcast<V>(T(0.25));
  return quarter * (excess * excess) <= low * other * (limit - largest);
}

/// The square of a vector along a diagonal of cells with steps 1 and hv: a polynomial of hv.
template <typename V>
class SquareForm {
public:
  SquareForm() = default;
  SIMDBEZIER_INLINE SquareForm(const SecondVectors<V>& of, bool rising) {
    using T = ScalarOf<V>;
    // This takes off what roundings may have added: they are small beside the sum of the squares.
    const V rest = broadcast<V>(T(1) - T(1e-5));
    const V four = broadcast<V>(rising ? T(4) : T(-4));
    const V same = dot(of.uu, of.vv);
    factor_[0] = rest * of.uu.square();
    factor_[1] = four * dot(of.uu, of.uv);
    factor_[2] = madd(broadcast<V>(T(4)) * rest, of.uv.square(), same + same);
    factor_[3] = four * dot(of.vv, of.uv);
    factor_[4] = rest * of.vv.square();
  }

  /// Returns a lower bound on it, which may be below 0.
  [[nodiscard]] SIMDBEZIER_INLINE V at_least(V hv) const {
    V sum = factor_[4];
    for (std::size_t k = 4; k-- > 0;) {
      sum = madd(sum, hv, factor_[k]);
    }
    return sum;
  }

private:
  V factor_[5];
};

/// Whether the bound of cells can be at most t at all, judged by what it would be, without
/// rounding, if each quarter had its leading vectors only: those that set the bound of cells of
/// about the same shape. Zones across the middle combine the terms of both halves, so their bound
/// is no smaller than that of either half.
template <typename V>
class CellScreen {
public:
  SIMDBEZIER_INLINE CellScreen(const QuarterNets<V>& nets,
                               const QuarterSquares<LeadingSquare<V>>& leading,
                               const SecondTerms<V>& doubt, V t)
      : doubt_(doubt) {
    using T = ScalarOf<V>;
    // It is above 8 t by more than triangle_bound() may err by. No bound of scaled patches comes
    // near 1e3, and products with a larger limit might overflow.
    limit_ = smaller_of<V>(t * broadcast<V>(T(8) * (T(1) + T(1e-4))), broadcast<V>(T(1e4)));
    for (std::size_t k = 0; k < 4; ++k) {
      rising_[k] = SquareForm<V>(vectors_at(nets, leading.rising[k].place), true);
      falling_[k] = SquareForm<V>(vectors_at(nets, leading.falling[k].place), false);
      uu_[k] = nets.largest_uu[k] + doubt.uu;
      vv_[k] = nets.largest_vv[k] + doubt.vv;
    }
  }

  /// Judges cells of steps hu and hv, `inverse` being 1 / hu. odd_u says whether their number in u
  /// is odd in all lanes; where it is not said although it is so, more cells pass.
  [[nodiscard]] SIMDBEZIER_INLINE MaskOf<V> may_hold(V inverse, V hv, bool odd_u,
                                                     bool odd_v) const {
    const V zero = broadcast<V>(ScalarOf<V>(0));
    const V ratio = hv * inverse; // everything is in units of hu^2
    const V limit = limit_ * (inverse * inverse);
    const V doubt = madd(ratio, madd(ratio, doubt_.vv, doubt_.uv + doubt_.uv), doubt_.uu);
    ZoneTerms<V> terms;
    for (std::size_t k = 0; k < 4; ++k) {
      terms.uu[k] = uu_[k];
      terms.vv[k] = vv_[k];
      terms.rising[k] = rising_[k].at_least(ratio);
      terms.falling[k] = falling_[k].at_least(ratio);
    }
    const auto join = [&](std::size_t a, std::size_t b) SIMDBEZIER_INLINE_LAMBDA {
      for (V* const term : {terms.uu, terms.vv, terms.rising, terms.falling}) {
        term[a] = larger_of<V>(term[a], term[b]);
      }
    };
    if (odd_u) {
      join(0, 1);
      join(2, 3);
    }
    if (odd_v) {
      join(0, 2);
      join(1, 3);
    }
    MaskOf<V> possible = limit > zero;
    for (std::size_t k = 0; k < 4; ++k) {
      if ((odd_u && k % 2 == 1) || (odd_v && k / 2 == 1)) {
        continue; // is in the zone of its neighbour
      }
      const V square = smaller_of<V>(terms.rising[k], terms.falling[k]);
      const V across = square_root(larger_of<V>(square, zero)) + doubt;
      possible =
          possible & is_triangle_within<V>(terms.uu[k], ratio * ratio * terms.vv[k], across, limit);
    }
    return possible;
  }

private:
  SquareForm<V> rising_[4];
  SquareForm<V> falling_[4];
  V uu_[4];
  V vv_[4];
  SecondTerms<V> doubt_;
  V limit_;
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
