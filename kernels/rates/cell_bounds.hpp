// How far the triangles of cells may be from bicubic patches: lanes are patches. The bound is that
// of group_bounds.hpp; docs/tessellation.md has the proof.
#pragma once

#include <cstddef>
#include <limits>

#include "kernels/rates/quarter_nets.hpp"
#include "kernels/rates/triangle_terms.hpp"
#include "kernels/simd/lanes.hpp"
#include "kernels/simd/repeat.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

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

/// The longest step of n segments: parameters of samples are rounded.
template <typename V>
SIMDBEZIER_INLINE V cell_step(V n) {
  using T = ScalarOf<V>;
  return divide(broadcast<V>(T(1)), n) + broadcast<V>(T(detail::kStepRounding));
}

/// The squares of steps, and what rounding may have taken from vectors that they are multiplied
/// with.
template <typename V>
struct CellSteps {
  V uu;
  V uv;
  V vv;
  V doubt;

  SIMDBEZIER_INLINE CellSteps(const LaneCells<V>& cells, const SecondTerms<V>& doubts) {
    const V hu = cell_step<V>(cells.nu);
    const V hv = cell_step<V>(cells.nv);
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

  SIMDBEZIER_INLINE DiagonalSquares(const CellSteps<V>& step, const SecondVectors<V>& vectors) {
    const SpaceVector<V> s = step.uu * vectors.uu + step.vv * vectors.vv;
    const SpaceVector<V> t = step.uv * vectors.uv;
    rising = (s + t).square();
    falling = (s - t).square();
  }
};

/// The largest of some squares.
template <typename V>
struct LargestSquare {
  V square;

  /// place: of the vector that it is the square of
  SIMDBEZIER_INLINE void include(V other, V /*place*/) { square = larger_of<V>(other, square); }
  SIMDBEZIER_INLINE void include(const LargestSquare& other) { include(other.square, square); }
};

/// The largest squares of each quarter. Largest is LargestSquare, or also knows which vectors make
/// them.
template <typename Largest>
struct QuarterSquares {
  Largest rising[4];
  Largest falling[4];
};

/// Quarters have vectors in common, so that the nets have nine parts, [row][column]: low lines, the
/// common one and high lines in both directions. Returns the largest of those that a quarter has.
template <typename Largest>
SIMDBEZIER_INLINE Largest largest_in_quarter(const Largest (&parts)[3][3], std::size_t quarter) {
  const std::size_t u = quarter % 2 * 2;
  const std::size_t v = quarter / 2 * 2;
  Largest largest = parts[1][1];
  largest.include(parts[1][u]);
  largest.include(parts[v][1]);
  largest.include(parts[v][u]);
  return largest;
}

/// Finds them, part by part: each vector is looked at only once.
template <typename Largest, typename V>
SIMDBEZIER_INLINE QuarterSquares<Largest> largest_squares(const QuarterNets<V>& nets,
                                                          const CellSteps<V>& step) {
  using T = ScalarOf<V>;
  constexpr std::size_t kFirst[] = {0, 3, 4, 7};
  Largest rising[3][3];
  Largest falling[3][3];
  for (std::size_t v = 0; v < 3; ++v) {
    repeat<3>([&](std::size_t u) SIMDBEZIER_INLINE_LAMBDA {
      constexpr std::size_t kColumns[] = {3, 1, 3};
      const std::size_t first = 7 * kFirst[v] + kFirst[u];
      const SecondVectors<V>* at = nets.at + first;
      V place = broadcast<V>(static_cast<T>(first));
      Largest in_rising{};
      Largest in_falling{};
      for (std::size_t j = kFirst[v]; j < kFirst[v + 1]; ++j) {
        // This stays a loop: of code that is written out, g++ 12 does all products first, and moves
        // them to memory and back.
#pragma GCC unroll 1
        for (std::size_t i = 0; i < kColumns[u]; ++i) {
          const DiagonalSquares<V> squares(step, *at);
          in_rising.include(squares.rising, place);
          in_falling.include(squares.falling, place);
          place = place + broadcast<V>(T(1));
          ++at;
        }
        at += 7 - kColumns[u];
        place = place + broadcast<V>(static_cast<T>(7 - kColumns[u]));
      }
      rising[v][u] = in_rising;
      falling[v][u] = in_falling;
    });
  }
  QuarterSquares<Largest> found;
  for (std::size_t k = 0; k < 4; ++k) {
    found.rising[k] = largest_in_quarter(rising, k);
    found.falling[k] = largest_in_quarter(falling, k);
  }
  return found;
}

/// Finds the terms of all quarters.
template <typename Largest, typename V>
SIMDBEZIER_INLINE ZoneTerms<V> zone_terms(const QuarterNets<V>& nets, const CellSteps<V>& step,
                                          const SecondTerms<V>& doubt,
                                          const QuarterSquares<Largest>& squares) {
  ZoneTerms<V> terms;
  for (std::size_t k = 0; k < 4; ++k) {
    terms.uu[k] = step.uu * (nets.largest_uu[k] + doubt.uu);
    terms.vv[k] = step.vv * (nets.largest_vv[k] + doubt.vv);
    terms.rising[k] = square_root(squares.rising[k].square) + step.doubt;
    terms.falling[k] = square_root(squares.falling[k].square) + step.doubt;
  }
  return terms;
}

/// This is for the roundings of a bound itself, a few dozen.
template <typename T>
inline constexpr T kBoundSlack = T(1) + 64 * std::numeric_limits<T>::epsilon();

/// Returns the largest of a term's values in a zone: 0 and 1 are the halves in a direction, 2 goes
/// across the middle.
template <typename V>
SIMDBEZIER_INLINE V term_in_zone(const V (&quarters)[4], std::size_t zone_u, std::size_t zone_v) {
  const auto in_half = [&](std::size_t v) SIMDBEZIER_INLINE_LAMBDA {
    const V* const half = quarters + 2 * v;
    return zone_u == 2 ? larger_of<V>(half[0], half[1]) : half[zone_u];
  };
  return zone_v == 2 ? larger_of<V>(in_half(0), in_half(1)) : in_half(zone_v);
}

/// The bound of triangles in one zone.
template <typename V>
struct ZoneBound {
  V bound;
  MaskOf<V> falls; ///< whether the falling diagonal is the better one

  SIMDBEZIER_INLINE ZoneBound(const ZoneTerms<V>& terms, std::size_t u, std::size_t v) {
    const V rising = term_in_zone<V>(terms.rising, u, v);
    const V falling = term_in_zone<V>(terms.falling, u, v);
    bound = triangle_bound<V>(term_in_zone<V>(terms.uu, u, v), term_in_zone<V>(terms.vv, u, v),
                              smaller_of<V>(rising, falling));
    falls = !(rising < falling);
  }
};

/// Returns the bound of even numbers of cells: no zone is across the middle.
template <typename V>
SIMDBEZIER_INLINE V bound_of_even(const ZoneTerms<V>& terms) {
  V worst = broadcast<V>(ScalarOf<V>(0));
  repeat<4>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    worst = larger_of<V>(ZoneBound<V>(terms, k % 2, k / 2).bound, worst);
  });
  return worst * broadcast<V>(kBoundSlack<ScalarOf<V>>);
}

/// Returns the bound of every lane's cells. diagonals gets a bit for each zone (PatchRates).
template <typename V>
SIMDBEZIER_KERNEL V bound_of_cells(const QuarterNets<V>& nets, const LaneCells<V>& cells,
                                   const SecondTerms<V>& doubt, V& diagonals) {
  using T = ScalarOf<V>;
  const V zero = broadcast<V>(T(0));
  const V one = broadcast<V>(T(1));
  const CellSteps<V> step(cells, doubt);
  const ZoneTerms<V> terms =
      zone_terms(nets, step, doubt, largest_squares<LargestSquare<V>>(nets, step));
  const MaskOf<V> odd[2] = {is_odd<V>(cells.nu), is_odd<V>(cells.nv)};
  const MaskOf<V> several[2] = {cells.nu > one, cells.nv > one};
  V worst = zero;
  diagonals = zero;
  repeat<9>([&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA {
    const std::size_t u = k % 3;
    const std::size_t v = k / 3;
    const MaskOf<V> occurs = (u == 2 ? odd[0] : several[0]) & (v == 2 ? odd[1] : several[1]);
    if (!any_of<V>(occurs)) {
      return;
    }
    const ZoneBound<V> zone(terms, u, v);
    worst = larger_of<V>(select_where<V>(occurs, zone.bound, zero), worst);
    const V bit = broadcast<V>(static_cast<T>(1U << k));
    diagonals = diagonals + select_where<V>(occurs & zone.falls, bit, zero);
  });
  return worst * broadcast<V>(kBoundSlack<T>);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
