// Cells that are looked at in the search for the fewest that hold: lanes are patches, and each has
// candidates of its own.
#pragma once

#include <cstddef>

#include "kernels/rates/cell_screen.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Numbers of segments around a centre c: c - 1, c, c + 1 and c + 2, at least 1. Each pair of them
/// has an even number and an odd one. They are sorted by that, because parity decides which zones
/// cells have: so all lanes have the same ones, and no zone is looked at in vain.
template <typename V>
struct SegmentWindow {
  V number[2][2]; ///< [pair][odd]
  V step[2][2];
  V inverse[2][2];     ///< of the steps
  MaskOf<V> is_odd[4]; ///< whether c - 1, … is the odd one of its pair

  SIMDBEZIER_INLINE explicit SegmentWindow(V centre) {
    using T = ScalarOf<V>;
    const V one = broadcast<V>(T(1));
    const V two = broadcast<V>(T(2));
    const V even = two * whole_part<V>(broadcast<V>(T(0.5)) * centre);
    const V odd = (centre + centre) - one - even;
    for (std::size_t pair = 0; pair < 2; ++pair) {
      number[pair][0] = larger_of<V>(pair == 0 ? even : even + two, one);
      number[pair][1] = larger_of<V>(pair == 0 ? odd : odd + two, one);
      for (std::size_t k = 0; k < 2; ++k) {
        step[pair][k] = cell_step<V>(number[pair][k]);
        inverse[pair][k] = divide(one, step[pair][k]);
      }
    }
    const MaskOf<V> odd_centre = odd == centre;
    const MaskOf<V> even_centre = even == centre;
    const MaskOf<V> no_even = even < one; // 0, for which the odd number, 1, stands as well
    is_odd[0] = even_centre | no_even;
    is_odd[1] = odd_centre | no_even;
    is_odd[2] = even_centre;
    is_odd[3] = odd_centre;
  }
};

/// Candidates for the fewest cells that hold, in about the order of their number.
template <typename V>
class CellCandidates {
public:
  /// centre: cells that a bound's proportion to the tolerance gives; candidates are neighbours.
  SIMDBEZIER_INLINE CellCandidates(const CellScreen<V>& screen, const LaneCells<V>& centre,
                                   V most) {
    using T = ScalarOf<V>;
    const V one = broadcast<V>(T(1));
    for (std::size_t k = 0; k < 4; ++k) {
      const V by = broadcast<V>(static_cast<T>(k) - T(1));
      nu_[k] = smaller_of<V>(larger_of<V>(centre.nu + by, one), most);
      nv_[k] = smaller_of<V>(larger_of<V>(centre.nv + by, one), most);
    }
    // The screen judges cells beyond `most` as well. A candidate that has `most` instead of them is
    // one that a smaller step leads to, where it is judged itself, so it may be open or not, as the
    // one of more cells that it is judged for.
    V open[4][4];
    screen_all(screen, SegmentWindow<V>(smaller_of<V>(centre.nu, most)),
               SegmentWindow<V>(smaller_of<V>(centre.nv, most)), open);
    for (std::size_t k = 0; k < kCount; ++k) {
      product_[k] = open[kSteps[k][0]][kSteps[k][1]];
    }
  }

  /// Returns the fewest cells that are still open and fewer than `best`, the first of equally many,
  /// or `best` where there are none.
  [[nodiscard]] SIMDBEZIER_INLINE LaneCells<V> fewest(const LaneCells<V>& best) const {
    LaneCells<V> found = best;
    V product = best.nu * best.nv;
    for (std::size_t k = 0; k < kCount; ++k) {
      const MaskOf<V> fewer = product_[k] < product;
      product = smaller_of<V>(product_[k], product);
      found.nu = select_where<V>(fewer, at(k).nu, found.nu);
      found.nv = select_where<V>(fewer, at(k).nv, found.nv);
    }
    return found;
  }
  /// Lanes with `mask` do without these cells.
  SIMDBEZIER_INLINE void close(const LaneCells<V>& cells, MaskOf<V> mask) {
    for (std::size_t k = 0; k < kCount; ++k) {
      const LaneCells<V> own = at(k);
      const MaskOf<V> same = (own.nu == cells.nu) & (own.nv == cells.nv);
      product_[k] = select_where<V>(same & mask, closed(), product_[k]);
    }
  }

private:
  /// Which of nu_ and nv_ the candidates have: 1 is the centre's.
  static constexpr std::size_t kCount = 13;
  static constexpr unsigned char kSteps[kCount][2] = {{0, 1}, {1, 0}, {1, 1}, {0, 2}, {2, 0},
                                                      {1, 2}, {2, 1}, {2, 2}, {1, 3}, {3, 1},
                                                      {2, 3}, {3, 2}, {3, 3}};

  static SIMDBEZIER_INLINE V closed() {
    return broadcast<V>(std::numeric_limits<ScalarOf<V>>::max());
  }
  [[nodiscard]] SIMDBEZIER_INLINE LaneCells<V> at(std::size_t k) const {
    return {nu_[kSteps[k][0]], nv_[kSteps[k][1]]};
  }

  /// Finds how many cells the candidates that may hold have, [step in u][step in v].
  static SIMDBEZIER_INLINE void screen_all(const CellScreen<V>& screen, const SegmentWindow<V>& u,
                                           const SegmentWindow<V>& v, V (&open)[4][4]) {
    V sorted[4][4]; // [2 * pair in u + odd][likewise in v]
    for (std::size_t pair_u = 0; pair_u < 2; ++pair_u) {
      for (std::size_t pair_v = 0; pair_v < 2; ++pair_v) {
        const auto look = [&](std::size_t odd_u, std::size_t odd_v) SIMDBEZIER_INLINE_LAMBDA {
          const MaskOf<V> may_hold = screen.may_hold(u.inverse[pair_u][odd_u],
                                                     v.step[pair_v][odd_v], odd_u == 1, odd_v == 1);
          const V cells = u.number[pair_u][odd_u] * v.number[pair_v][odd_v];
          sorted[2 * pair_u + odd_u][2 * pair_v + odd_v] =
              select_where<V>(may_hold, cells, closed());
        };
        look(0, 0);
        look(0, 1);
        look(1, 0);
        look(1, 1);
      }
    }
    for (std::size_t k = 0; k < 4; ++k) {
      V row[4];
      for (std::size_t m = 0; m < 4; ++m) {
        row[m] = select_where<V>(u.is_odd[k], sorted[k / 2 * 2 + 1][m], sorted[k / 2 * 2][m]);
      }
      for (std::size_t m = 0; m < 4; ++m) {
        open[k][m] = select_where<V>(v.is_odd[m], row[m / 2 * 2 + 1], row[m / 2 * 2]);
      }
    }
  }

  V nu_[4];
  V nv_[4];
  V product_[kCount]; ///< of those that are open
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
