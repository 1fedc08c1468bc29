// The memory of a group of patches, and the nets and hulls that bounds on their cells are formed
// of: lanes are patches.
#pragma once

#include "kernels/rates/diagonal_bounds.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The quarters of a patch that a zone's cells lie in, one bit each; quarters have the numbers
/// 2 * (half of v) + (half of u).
inline constexpr unsigned kZoneQuarters[detail::kZoneCount] = {1, 2, 3, 4, 8, 12, 5, 10, 15};
/// The zones of quarters, their own one first: those of halves, and of all.
inline constexpr std::size_t kZonesOfQuarter[4][4] = {
    {0, 2, 6, 8}, {1, 2, 7, 8}, {3, 5, 6, 8}, {4, 5, 7, 8}};

/// One group, and what has been formed of it.
template <typename V, std::size_t kComponents>
class GroupNets {
public:
  using Net = LaneNet<V, kComponents>;
  using Vector = LaneVector<V, kComponents>;
  using Pointers = SecondPointers<V, kComponents>;

  static constexpr bool kRational = kComponents == 4;
  static constexpr std::size_t kSeconds = 3; ///< uu, uv, vv
  static constexpr std::size_t kUu = 0;
  static constexpr std::size_t kUv = 1;
  static constexpr std::size_t kVv = 2;

  struct Zone {
    LaneHull<V> hull;
    V largest_uu; ///< of the vectors over the zone's quarters
    V largest_vv;
  };
  /// Of a quarter, the vectors that are the largest along either diagonal.
  struct Leading {
    Vector rising[kSeconds];
    Vector falling[kSeconds];
  };
  explicit SIMDBEZIER_INLINE GroupNets(const detail::BoundGroup& group)
      : group_(group), vectors_(group.columns * group.rows),
        nets_(reinterpret_cast<Vector*>(group.memory)),
        zones_(reinterpret_cast<Zone*>(nets_ + detail::kBoundNets * vectors_)),
        leading_(reinterpret_cast<Leading*>(zones_ + detail::kZoneCount)) {
    static_assert(detail::kZoneCount * sizeof(Zone) + 4 * sizeof(Leading) <=
                  detail::kBoundValues * sizeof(V));
  }

  [[nodiscard]] SIMDBEZIER_INLINE const detail::BoundGroup& group() const { return group_; }
  /// Vectors of a net of the patch's degrees.
  [[nodiscard]] SIMDBEZIER_INLINE std::size_t vectors() const { return vectors_; }
  [[nodiscard]] SIMDBEZIER_INLINE const Zone& zone(std::size_t z) const { return zones_[z]; }
  [[nodiscard]] SIMDBEZIER_INLINE Leading& leading(std::size_t quarter) const {
    return leading_[quarter];
  }
  /// Second derivative d of the whole patch.
  [[nodiscard]] SIMDBEZIER_INLINE Net second(std::size_t d) const {
    const std::size_t in_u = kSeconds - 1 - d; // how often it is differentiated in u
    const bool vanishes = group_.columns <= in_u || group_.rows <= d;
    return {vanishes ? 1 : group_.columns - in_u, vanishes ? 1 : group_.rows - d, group_.columns,
            memory(kSecond + d)};
  }
  /// Second derivatives of a quarter, raised to the patch's degrees.
  [[nodiscard]] SIMDBEZIER_INLINE Pointers vectors_in(std::size_t quarter) const {
    return {memory(kQuarters + quarter), memory(kQuarters + 4 + quarter),
            memory(kQuarters + 8 + quarter)};
  }

  /// Room for net d of three, which forming uses as well.
  [[nodiscard]] SIMDBEZIER_INLINE Vector* scratch(std::size_t d) const {
    return memory(kScratch + d);
  }

  SIMDBEZIER_INLINE void form(detail::WholePatches& out) const {
    form_seconds();
    form_hulls();
    Net parts[4];
    for (std::size_t d = 0; d < kSeconds; ++d) {
      cut_quarters(second(d), parts, kQuarters + 4 * d);
      if (d != kUv) {
        find_largest(parts, d);
      }
      for (Net& part : parts) {
        raise_net(part, group_.columns, group_.rows);
      }
    }
    const LaneHull<V>& hull = zones_[detail::kEverywhere].hull;
    store_lanes(out.largest.uu, size_in(second(kUu), hull));
    store_lanes(out.largest.uv, size_in(second(kUv), hull));
    store_lanes(out.largest.vv, size_in(second(kVv), hull));
    for (std::size_t c = 0; c < 3; ++c) {
      store_lanes(out.hull.middle[c], hull.middle[c]);
    }
    store_lanes(out.hull.radius, hull.radius);
    store_lanes(out.hull.smallest_weight, hull.smallest_weight);
  }

  [[nodiscard]] SIMDBEZIER_INLINE V size_in(const Net& net, const LaneHull<V>& hull) const {
    LargestSize<V, kComponents> largest;
    for (std::size_t j = 0; j < net.rows; ++j) {
      for (std::size_t i = 0; i < net.columns; ++i) {
        largest.include(measure_of(net.at[j * net.stride + i].x, hull));
      }
    }
    return largest.value();
  }

private:
  // Numbers of nets in the group's memory, of which net 0 has the control points.
  static constexpr std::size_t kSecond = 1;
  static constexpr std::size_t kScratch = kSecond + kSeconds;
  static constexpr std::size_t kQuarters = kScratch + 3; ///< [second][quarter]
  static_assert(kQuarters + 4 * kSeconds == detail::kBoundNets);

  [[nodiscard]] SIMDBEZIER_INLINE Vector* memory(std::size_t net) const {
    return nets_ + net * vectors_;
  }
  [[nodiscard]] SIMDBEZIER_INLINE Net patch() const {
    return {group_.columns, group_.rows, group_.columns, nets_};
  }
  SIMDBEZIER_INLINE void form_seconds() const {
    const Net in_u = differentiate(patch(), true, memory(kScratch));
    differentiate(in_u, true, memory(kSecond));
    differentiate(in_u, false, memory(kSecond + 1));
    const Net in_v = differentiate(patch(), false, memory(kScratch));
    differentiate(in_v, false, memory(kSecond + 2));
  }

  /// Cuts a net into quarters, which become nets `to` and the three behind it.
  SIMDBEZIER_INLINE void cut_quarters(const Net& net, Net (&parts)[4], std::size_t to) const {
    const Net halves[2] = {net.shaped_at(memory(kScratch)), net.shaped_at(memory(kScratch + 1))};
    halve_net(net, true, halves[0].at, halves[1].at);
    for (std::size_t k = 0; k < 4; ++k) {
      parts[k] = net.shaped_at(memory(to + k));
    }
    for (std::size_t u = 0; u < 2; ++u) {
      halve_net(halves[u], false, parts[u].at, parts[u + 2].at);
    }
  }

  /// Polynomial patches have no weights to be bounded, and no vector depends on their hull.
  SIMDBEZIER_INLINE void form_hulls() const {
    if constexpr (kRational) {
      Net parts[4];
      cut_quarters(patch(), parts, kQuarters);
      LaneBox<V> boxes[4];
      for (std::size_t k = 0; k < 4; ++k) {
        boxes[k].include(parts[k]);
      }
      for (std::size_t z = 0; z < detail::kZoneCount; ++z) {
        LaneBox<V> box;
        for (std::size_t k = 0; k < 4; ++k) {
          if ((kZoneQuarters[z] >> k & 1) != 0) {
            box.include(boxes[k]);
          }
        }
        zones_[z].hull = box.hull();
      }
    } else {
      const V zero = broadcast<V>(0);
      for (std::size_t z = 0; z < detail::kZoneCount; ++z) {
        zones_[z].hull = {{zero, zero, zero}, zero, broadcast<V>(1)};
      }
    }
  }

  SIMDBEZIER_INLINE void find_largest(const Net (&parts)[4], std::size_t d) const {
    const auto largest = [&](std::size_t z) SIMDBEZIER_INLINE_LAMBDA -> V& {
      return d == kUu ? zones_[z].largest_uu : zones_[z].largest_vv;
    };
    for (std::size_t z = 0; z < detail::kZoneCount; ++z) {
      largest(z) = broadcast<V>(0);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      constexpr std::size_t kHulls = kRational ? 4 : 1; // sizes of polynomials depend on none
      const std::size_t(&zones)[4] = kZonesOfQuarter[k];
      LargestSize<V, kComponents> sizes[kHulls];
      for (std::size_t j = 0; j < parts[k].rows; ++j) {
        for (std::size_t i = 0; i < parts[k].columns; ++i) {
          const Vector& vector = parts[k].at[j * parts[k].stride + i];
          for (std::size_t h = 0; h < kHulls; ++h) {
            sizes[h].include(measure_of(vector.x, zones_[zones[h]].hull));
          }
        }
      }
      for (std::size_t h = 0; h < 4; ++h) {
        V& all = largest(zones[h]);
        all = larger_bound<V>(all, sizes[kRational ? h : 0].value());
      }
    }
  }

  const detail::BoundGroup& group_;
  std::size_t vectors_;
  Vector* nets_;
  Zone* zones_;
  Leading* leading_; ///< of the quarters
};

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
