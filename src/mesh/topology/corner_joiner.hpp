// Joins the corners of patches at the ends of common edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "src/mesh/topology/topology_data.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/fresh_vector.hpp"

namespace simdbezier::detail {

/// Sets of corners that are one, each named by its lowest member.
///
/// Each share first joins what edges with all of their sides in it say; then one thread joins what
/// lies in several shares. That is little where neighbours have numbers close to each other, and
/// the sets do not depend on the order.
class CornerJoiner {
public:
  /// shares: of the patches.
  CornerJoiner(const Shares& shares, TopologyData& topology)
      : shares_(shares), topology_(topology), parent_(topology.next_corner), found_(shares.count()),
        between_(topology.sides.size()) {
    topology.corners.resize(topology.sides.size());
    topology.next_corner.resize(topology.sides.size());
  }

  void run() {
    shares_.run([this](std::size_t share) { join_inside(share); });
    if (shares_.count() > 1) {
      join_between();
      shares_.run([this](std::size_t share) { name_sets(share); });
      link_between();
    }
    shares_.run([this](std::size_t share) { link_inside(share); });
    for (const Share& share : found_) {
      topology_.counts.corners += share.corners;
    }
  }

private:
  struct Share {
    std::size_t between = 0; ///< what is left for one thread, edges or corners
    std::size_t corners = 0; ///< different ones that begin here
  };

  [[nodiscard]] std::size_t begin(std::size_t share) const {
    return kPatchCorners * shares_.begin(share);
  }
  /// Rem's algorithm: climbs from both at once, on the side that is higher, and hangs what it
  /// leaves there below the other.
  void join(std::uint32_t a, std::uint32_t b) noexcept {
    while (parent_[a] != parent_[b]) {
      if (parent_[a] < parent_[b]) {
        std::swap(a, b);
      }
      const std::uint32_t above = parent_[a];
      parent_[a] = parent_[b];
      if (above == a) {
        return;
      }
      a = above;
    }
  }
  /// Calls visit(corner, corner of the first side) for both ends of an edge's other sides.
  template <typename Visit>
  void for_ends(std::size_t edge, const Visit& visit) const {
    const auto sides = topology_.sides_of(edge);
    for (const std::uint32_t side : sides.subspan(1)) {
      const std::size_t end = topology_.sides[side].reversed() ? 1 : 0;
      visit(corner_at(side, end), corner_at(sides[0], 0));
      visit(corner_at(side, 1 - end), corner_at(sides[0], 1));
    }
  }

  void join_inside(std::size_t share) {
    const std::size_t end = begin(share + 1);
    std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(begin(share)),
              parent_.begin() + static_cast<std::ptrdiff_t>(end),
              static_cast<std::uint32_t>(begin(share)));
    std::size_t between = 0;
    const std::size_t end_edge = topology_.edge_from(end);
    for (std::size_t edge = topology_.edge_from(begin(share)); edge < end_edge; ++edge) {
      if (topology_.sides_of(edge).back() >= end) {
        between_[begin(share) + between++] = static_cast<std::uint32_t>(edge);
      } else {
        for_ends(edge, [this](std::uint32_t a, std::uint32_t b) { join(a, b); });
      }
    }
    found_[share].between = between;
    for (std::size_t side = begin(share); topology_.counts.collapsed_sides > 0 && side < end;
         ++side) {
      if (topology_.sides[side].collapsed()) {
        join(corner_at(side, 0), corner_at(side, 1));
      }
    }
    for (std::size_t corner = begin(share); corner < end; ++corner) {
      // A parent is lower, and has its name already, or is the corner itself.
      topology_.corners[corner] = static_cast<std::uint32_t>(corner);
      topology_.corners[corner] = topology_.corners[parent_[corner]];
    }
  }

  template <typename Visit>
  void for_edges_between(const Visit& visit) {
    for (std::size_t share = 0; share < shares_.count(); ++share) {
      for (std::size_t k = 0; k < found_[share].between; ++k) {
        for_ends(between_[begin(share) + k], visit);
      }
    }
  }
  /// Joins sets by their names so far, and lets these names lead to the lowest ones.
  void join_between() {
    const auto& name = topology_.corners;
    for_edges_between([&](std::uint32_t a, std::uint32_t b) { join(name[a], name[b]); });
    for_edges_between([&](std::uint32_t a, std::uint32_t b) {
      for (std::uint32_t corner : {name[a], name[b]}) {
        const std::uint32_t lowest = lowest_of(corner);
        while (corner != lowest) {
          corner = std::exchange(parent_[corner], lowest);
        }
      }
    });
  }
  [[nodiscard]] std::uint32_t lowest_of(std::uint32_t corner) const {
    while (parent_[corner] != corner) {
      corner = parent_[corner];
    }
    return corner;
  }

  void name_sets(std::size_t share) {
    std::size_t between = 0;
    for (std::size_t corner = begin(share); corner < begin(share + 1); ++corner) {
      const std::uint32_t lowest = parent_[topology_.corners[corner]];
      topology_.corners[corner] = lowest;
      between_[begin(share) + between] = static_cast<std::uint32_t>(corner);
      between += lowest < begin(share) ? 1 : 0;
    }
    found_[share].between = between;
  }

  /// Goes from the last corner to the first, so that the lowest one, whose parent it is itself,
  /// always leads to the latest.
  void link(std::size_t corner) {
    std::uint32_t& latest = topology_.next_corner[topology_.corners[corner]];
    topology_.next_corner[corner] = latest;
    latest = static_cast<std::uint32_t>(corner);
  }
  void link_between() {
    for (std::size_t share = shares_.count(); share-- > 0;) {
      for (std::size_t k = found_[share].between; k-- > 0;) {
        link(between_[begin(share) + k]);
      }
    }
  }
  void link_inside(std::size_t share) {
    const std::size_t first = begin(share);
    std::size_t corners = 0;
    for (std::size_t corner = begin(share + 1); corner-- > first;) {
      const std::uint32_t lowest = topology_.corners[corner];
      if (lowest >= first) {
        std::uint32_t& latest = topology_.next_corner[lowest];
        topology_.next_corner[corner] = latest;
        latest = lowest == corner ? latest : static_cast<std::uint32_t>(corner);
        corners += lowest == corner ? 1 : 0;
      }
    }
    found_[share].corners = corners;
  }

  const Shares& shares_;
  TopologyData& topology_;
  /// A corner's own number, or that of a lower one. The memory becomes next_corner.
  FreshVector<std::uint32_t>& parent_;
  std::vector<Share> found_;
  FreshVector<std::uint32_t> between_; ///< those of a share from its first corner's place on
};

} // namespace simdbezier::detail
