// Bounds on the cells of patches of any degrees and weights: lanes are patches. The proof is in
// docs/tessellation.md. Bicubic polynomial patches have kernels of their own (net_rates.hpp).
#pragma once

#include "kernels/rates/group_nets.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The bounds of one group.
template <typename V, std::size_t kComponents>
class GroupBounds {
  using Nets = GroupNets<V, kComponents>;
  using Net = typename Nets::Net;
  using Vector = typename Nets::Vector;
  using Pointers = typename Nets::Pointers;
  using Zone = typename Nets::Zone;
  static constexpr std::size_t kSeconds = Nets::kSeconds;

public:
  explicit SIMDBEZIER_INLINE GroupBounds(const detail::BoundGroup& group) : nets_(group) {}

  SIMDBEZIER_INLINE void form(detail::WholePatches& out) const { nets_.form(out); }

  /// By all vectors, or by the leading ones.
  template <bool kLeading>
  SIMDBEZIER_INLINE void bound(const detail::LaneSegments& cells, unsigned zones,
                               detail::CellBounds& out) const {
    const DiagonalSteps<V> steps(LongestSteps<V>(cells), nets_.group().doubt);
    const auto sizes = [&](std::size_t quarter, const LaneHull<V>& hull) SIMDBEZIER_INLINE_LAMBDA {
      return kLeading ? leading_sizes(quarter, steps, hull)
                      : sizes_along(nets_.vectors_in(quarter), steps, hull);
    };
    LaneDiagonals<V> of_quarter[4];
    for (std::size_t k = 0; !Nets::kRational && k < 4; ++k) {
      of_quarter[k] = sizes(k, nets_.zone(0).hull);
    }
    ZoneBounds<V> found(cells);
    for (std::size_t z = 0; z < detail::kZoneCount; ++z) {
      if ((zones >> z & 1) == 0 || !found.occurs(z)) {
        continue;
      }
      const Zone& zone = nets_.zone(z);
      LaneDiagonals<V> largest{broadcast<V>(0), broadcast<V>(0)};
      for (std::size_t k = 0; k < 4; ++k) {
        if ((kZoneQuarters[z] >> k & 1) != 0) {
          largest.include(Nets::kRational ? sizes(k, zone.hull) : of_quarter[k]);
        }
      }
      if constexpr (kLeading) { // the better diagonal is the shorter one
        const V better = smaller_of<V>(largest.falling, largest.rising);
        const V bound = bound_of(zone.largest_uu, zone.largest_vv, better, steps, zone.hull);
        found.include(z, {bound, bound});
      } else {
        found.include(z, bounds_of(zone, largest, steps));
      }
    }
    found.store(out);
  }

  SIMDBEZIER_INLINE void lead(const detail::LaneSegments& cells, detail::CellBounds& out) const {
    const DiagonalSteps<V> steps(LongestSteps<V>(cells), nets_.group().doubt);
    ZoneBounds<V> found(cells);
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      const Zone& zone = nets_.zone(kZonesOfQuarter[quarter][0]);
      const Pointers vectors = nets_.vectors_in(quarter);
      LeadingSize<V, kComponents> rising;
      LeadingSize<V, kComponents> falling;
      V place = broadcast<V>(0);
      for (std::size_t k = 0; k < nets_.vectors(); ++k) {
        const DiagonalVectors<V, kComponents> along(steps, vectors, k);
        rising.include(measure_of(along.rising, zone.hull), place);
        falling.include(measure_of(along.falling, zone.hull), place);
        place = place + broadcast<V>(1);
      }
      found.include(kZonesOfQuarter[quarter][0],
                    bounds_of(zone, {rising.value(), falling.value()}, steps));
      take_vectors(vectors, rising.place(), nets_.leading(quarter).rising);
      take_vectors(vectors, falling.place(), nets_.leading(quarter).falling);
    }
    found.store(out);
  }

  [[nodiscard]] SIMDBEZIER_INLINE V bound_corner(const detail::LaneSegments& cells,
                                                 std::size_t corner, bool falling) const {
    const LongestSteps<V> longest(cells);
    const DiagonalSteps<V> steps(longest, nets_.group().doubt);
    const LaneHull<V>& hull = nets_.zone(detail::kEverywhere).hull;
    const V one = broadcast<V>(1);
    const bool high_u = corner % 2 != 0;
    const bool high_v = corner >= 2;
    const V hu = smaller_of<V>(longest.u, one);
    const V hv = smaller_of<V>(longest.v, one);
    const V u = high_u ? one - hu : hu;
    const V v = high_v ? one - hv : hv;
    V largest[kSeconds];
    for (std::size_t d = 0; d < kSeconds; ++d) {
      const Net whole = nets_.second(d);
      Net part = whole.shaped_at(nets_.scratch(d));
      for (std::size_t k = 0; k < nets_.vectors(); ++k) {
        part.at[k] = whole.at[k];
      }
      cut_net(part, true, one - u, u, high_u);
      cut_net(part, false, one - v, v, high_v);
      largest[d] = nets_.size_in(part, hull);
      raise_net(part, nets_.group().columns, nets_.group().rows);
    }
    const LaneDiagonals<V> sizes =
        sizes_along({nets_.scratch(0), nets_.scratch(1), nets_.scratch(2)}, steps, hull);
    return bound_of(largest[0], largest[2], falling ? sizes.falling : sizes.rising, steps, hull);
  }

private:
  /// The largest sizes along diagonals, of nets raised to the patch's degrees.
  [[nodiscard]] SIMDBEZIER_INLINE LaneDiagonals<V> sizes_along(const Pointers& vectors,
                                                               const DiagonalSteps<V>& steps,
                                                               const LaneHull<V>& hull) const {
    LargestSize<V, kComponents> rising;
    LargestSize<V, kComponents> falling;
    for (std::size_t k = 0; k < nets_.vectors(); ++k) {
      const DiagonalVectors<V, kComponents> along(steps, vectors, k);
      rising.include(measure_of(along.rising, hull));
      falling.include(measure_of(along.falling, hull));
    }
    return {rising.value(), falling.value()};
  }
  [[nodiscard]] SIMDBEZIER_INLINE LaneDiagonals<V>
  leading_sizes(std::size_t quarter, const DiagonalSteps<V>& steps, const LaneHull<V>& hull) const {
    const auto along = [&](const Vector(&at)[kSeconds]) SIMDBEZIER_INLINE_LAMBDA {
      return DiagonalVectors<V, kComponents>(steps, {at, at + 1, at + 2}, 0);
    };
    LargestSize<V, kComponents> rising;
    LargestSize<V, kComponents> falling;
    rising.include(measure_of(along(nets_.leading(quarter).rising).rising, hull));
    falling.include(measure_of(along(nets_.leading(quarter).falling).falling, hull));
    return {rising.value(), falling.value()};
  }
  /// Copies the vectors in every lane's place, value by value.
  SIMDBEZIER_INLINE void take_vectors(const Pointers& from, V place, Vector (&to)[kSeconds]) const {
    alignas(64) double places[kLanes<V>];
    store_vector<V>(places, place);
    const Vector* const vectors[kSeconds] = {from.uu, from.uv, from.vv};
    for (std::size_t lane = 0; lane < kLanes<V>; ++lane) {
      for (std::size_t d = 0; d < kSeconds; ++d) {
        const auto* const at =
            reinterpret_cast<const double*>(vectors[d] + static_cast<std::size_t>(places[lane]));
        auto* const lanes = reinterpret_cast<double*>(to + d);
        for (std::size_t c = 0; c < kComponents; ++c) {
          lanes[c * kLanes<V> + lane] = at[c * kLanes<V> + lane];
        }
      }
    }
  }

  [[nodiscard]] SIMDBEZIER_INLINE LaneDiagonals<V>
  bounds_of(const Zone& zone, const LaneDiagonals<V>& sizes, const DiagonalSteps<V>& steps) const {
    return {bound_of(zone.largest_uu, zone.largest_vv, sizes.rising, steps, zone.hull),
            bound_of(zone.largest_uu, zone.largest_vv, sizes.falling, steps, zone.hull)};
  }
  [[nodiscard]] SIMDBEZIER_INLINE V bound_of(V largest_uu, V largest_vv, V diagonal,
                                             const DiagonalSteps<V>& steps,
                                             const LaneHull<V>& hull) const {
    const V found = triangle_bound<V>(steps.uu * (largest_uu + steps.doubt_uu),
                                      steps.vv * (largest_vv + steps.doubt_vv),
                                      diagonal + steps.uu * steps.doubt_uu +
                                          steps.uv * steps.doubt_uv + steps.vv * steps.doubt_vv);
    return larger_bound<V>(broadcast<V>(0),
                           Nets::kRational ? divide(found, hull.smallest_weight) : found);
  }

  Nets nets_;
};

/// Calls visit(bounds of the group).
template <typename Visit>
SIMDBEZIER_INLINE void visit_group(const detail::BoundGroup& group, const Visit& visit) {
  group.rational ? visit(GroupBounds<BoundLanes, 4>(group))
                 : visit(GroupBounds<BoundLanes, 3>(group));
}

SIMDBEZIER_KERNEL inline void form_kernel(const detail::BoundGroup& group,
                                          detail::WholePatches& out) {
  visit_group(group, [&](const auto& bounds) SIMDBEZIER_INLINE_LAMBDA { bounds.form(out); });
}
template <bool kLeading>
SIMDBEZIER_KERNEL void bound_kernel(const detail::BoundGroup& group,
                                    const detail::LaneSegments& cells, unsigned zones,
                                    detail::CellBounds& out) {
  visit_group(group, [&](const auto& bounds) SIMDBEZIER_INLINE_LAMBDA {
    bounds.template bound<kLeading>(cells, zones, out);
  });
}
SIMDBEZIER_KERNEL inline void lead_kernel(const detail::BoundGroup& group,
                                          const detail::LaneSegments& cells,
                                          detail::CellBounds& out) {
  visit_group(group, [&](const auto& bounds) SIMDBEZIER_INLINE_LAMBDA { bounds.lead(cells, out); });
}
SIMDBEZIER_KERNEL inline void corner_kernel(const detail::BoundGroup& group,
                                            const detail::LaneSegments& cells, std::size_t corner,
                                            bool falling, detail::LaneValues& out) {
  visit_group(group, [&](const auto& bounds) SIMDBEZIER_INLINE_LAMBDA {
    store_lanes(out, bounds.bound_corner(cells, corner, falling));
  });
}

inline constexpr detail::BoundKernels kBoundKernels = {kLanes<BoundLanes>,  form_kernel,
                                                       bound_kernel<false>, lead_kernel,
                                                       bound_kernel<true>,  corner_kernel};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
