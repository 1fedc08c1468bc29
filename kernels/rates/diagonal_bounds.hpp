// What bounds on cells are formed of: vectors along diagonals, their largest sizes, and the bounds
// of zones. Lanes are patches.
#pragma once

#include "kernels/rates/lane_hulls.hpp"
#include "kernels/rates/triangle_terms.hpp"
#include "src/tables/bound_task.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using BoundLanes = vec<double>;

SIMDBEZIER_INLINE void store_lanes(detail::LaneValues& to, BoundLanes value) {
  store_vector<BoundLanes>(to.at, value);
}
SIMDBEZIER_INLINE BoundLanes load_lanes(const detail::LaneValues& from) {
  return load_vector<BoundLanes>(from.at);
}

/// The steps of cells, rounded up: of samples whose parameters are rounded.
template <typename V>
struct LongestSteps {
  V u;
  V v;

  explicit SIMDBEZIER_INLINE LongestSteps(const detail::LaneSegments& cells)
      : u(longest(load_lanes(cells.nu))), v(longest(load_lanes(cells.nv))) {}

private:
  static SIMDBEZIER_INLINE V longest(V n) {
    return divide(broadcast<V>(1) + broadcast<V>(detail::kStepRounding) * n, n);
  }
};

/// Factors of second derivatives in vectors along a cell's diagonal, and what rounding may have
/// taken from them.
template <typename V>
struct DiagonalSteps {
  V uu;
  V uv;
  V vv;
  V doubt_uu;
  V doubt_uv;
  V doubt_vv;

  SIMDBEZIER_INLINE DiagonalSteps(const LongestSteps<V>& steps, const detail::SecondValues& doubts)
      : uu(steps.u * steps.u), uv(broadcast<V>(2) * steps.u * steps.v), vv(steps.v * steps.v),
        doubt_uu(load_lanes(doubts.uu)), doubt_uv(load_lanes(doubts.uv)),
        doubt_vv(load_lanes(doubts.vv)) {}
};

/// Vectors of the second derivatives, as many of each.
template <typename V, std::size_t kComponents>
struct SecondPointers {
  const LaneVector<V, kComponents>* uu;
  const LaneVector<V, kComponents>* uv;
  const LaneVector<V, kComponents>* vv;
};

/// The vectors along both diagonals in one place.
template <typename V, std::size_t kComponents>
struct DiagonalVectors {
  V rising[kComponents];
  V falling[kComponents];

  SIMDBEZIER_INLINE DiagonalVectors(const DiagonalSteps<V>& steps,
                                    const SecondPointers<V, kComponents>& at, std::size_t k) {
    for (std::size_t c = 0; c < kComponents; ++c) {
      const V first = steps.uu * at.uu[k].x[c];
      const V mixed = steps.uv * at.uv[k].x[c];
      const V last = steps.vv * at.vv[k].x[c];
      rising[c] = (first + mixed) + last;
      falling[c] = (first - mixed) + last;
    }
  }
};

/// One number for either diagonal, in registers.
template <typename V>
struct LaneDiagonals {
  V rising;
  V falling;

  SIMDBEZIER_INLINE void include(const LaneDiagonals& other) {
    rising = larger_bound<V>(rising, other.rising);
    falling = larger_bound<V>(falling, other.falling);
  }
};

/// Collects the bounds of zones that cells have.
template <typename V>
class ZoneBounds {
public:
  explicit SIMDBEZIER_INLINE ZoneBounds(const detail::LaneSegments& cells) {
    const V nu = load_lanes(cells.nu);
    const V nv = load_lanes(cells.nv);
    const V one = broadcast<V>(1);
    has_[0] = nu > one;
    has_[1] = is_odd<V>(nu);
    has_[2] = nv > one;
    has_[3] = is_odd<V>(nv);
  }

  /// Whether cells of any lane have the zone.
  [[nodiscard]] SIMDBEZIER_INLINE bool occurs(std::size_t zone) const {
    return any_of<V>(cells_with(zone));
  }
  SIMDBEZIER_INLINE void include(std::size_t zone, const LaneDiagonals<V>& bounds) {
    const MaskOf<V> has = cells_with(zone);
    const V none = broadcast<V>(0);
    const V better = smaller_of<V>(bounds.falling, bounds.rising);
    bound_ = larger_bound<V>(bound_, select_where<V>(has, better, none));
    rising_ = larger_bound<V>(rising_, select_where<V>(has, bounds.rising, none));
    const V bit = broadcast<V>(static_cast<double>(1U << zone));
    falling_ = falling_ + select_where<V>(has & !(bounds.rising < bounds.falling), bit, none);
  }
  SIMDBEZIER_INLINE void store(detail::CellBounds& to) const {
    store_lanes(to.bound, bound_);
    store_lanes(to.falling, falling_);
    store_lanes(to.rising, rising_);
  }

private:
  [[nodiscard]] SIMDBEZIER_INLINE MaskOf<V> cells_with(std::size_t zone) const {
    return has_[zone % 3 / 2] & has_[2 + zone / 6];
  }

  MaskOf<V> has_[4]; ///< the outer zones in u, and the middle one; in v
  V bound_ = broadcast<V>(0);
  V falling_ = broadcast<V>(0);
  V rising_ = broadcast<V>(0);
};

/// The largest of some sizes, and its place.
template <typename V, std::size_t kComponents>
class LeadingSize {
public:
  SIMDBEZIER_INLINE void include(V measure, V at) {
    size_.include(measure);
    place_ = select_where<V>(measure > most_, at, place_);
    most_ = larger_of<V>(measure, most_);
  }
  [[nodiscard]] SIMDBEZIER_INLINE V value() const { return size_.value(); }
  [[nodiscard]] SIMDBEZIER_INLINE V place() const { return place_; }

private:
  LargestSize<V, kComponents> size_;
  V most_ = broadcast<V>(-1);
  V place_ = broadcast<V>(0);
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
