// What a topology consists of.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/topology.hpp>

#include "src/runtime/fresh_vector.hpp"

namespace simdbezier::detail {

/// A side of a patch: its edge, and whether the edge's own direction, that of its first side, runs
/// against the side's.
class Side {
public:
  constexpr Side() noexcept = default; ///< of no value yet
  constexpr Side(std::uint32_t edge, bool reversed) noexcept
      : bits_(2 * edge + (reversed ? 1 : 0)) {}

  /// A side that is a point, and has no edge.
  static constexpr Side point() noexcept {
    Side side(0, false);
    side.bits_ = kCollapsed;
    return side;
  }

  [[nodiscard]] constexpr bool collapsed() const noexcept { return bits_ == kCollapsed; }
  [[nodiscard]] constexpr std::uint32_t edge() const noexcept { return bits_ / 2; }
  [[nodiscard]] constexpr bool reversed() const noexcept { return bits_ % 2 != 0; }
  friend constexpr bool operator==(const Side&, const Side&) noexcept = default;

private:
  static constexpr std::uint32_t kCollapsed = 0xffffffff;
  std::uint32_t bits_;
};

/// The corners of a patch are numbered 2 v + u; sides run from the first to the second.
inline constexpr std::uint32_t kSideCorners[kPatchEdges][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
inline constexpr std::size_t kPatchCorners = 4;

/// The corner of a patch, 4 * patch + corner, where a side begins (end 0) or ends (1).
constexpr std::uint32_t corner_at(std::size_t side, std::size_t end) noexcept {
  return static_cast<std::uint32_t>(side / kPatchEdges * kPatchCorners +
                                    kSideCorners[side % kPatchEdges][end]);
}

/// Two corners, or edges, in any order.
constexpr std::uint64_t pair_of(std::uint32_t a, std::uint32_t b) noexcept {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// Sides v0 and v1 run in u.
constexpr bool runs_in_u(std::size_t side) noexcept { return side % kPatchEdges < 2; }

/// Whether a patch's boundary, passed counter-clockwise, runs along the side or against it.
constexpr bool counter_clockwise_along(std::size_t side) noexcept {
  const auto edge = static_cast<PatchEdge>(side % kPatchEdges);
  return edge == PatchEdge::v0 || edge == PatchEdge::u1;
}

/// The diagonal of a corner's cell that passes through the corner.
constexpr bool falls(std::size_t corner) noexcept { return corner == 1 || corner == 2; }

/// The number of the Zone, in one direction, of cell i of n.
constexpr unsigned zone_at(std::uint32_t i, std::uint32_t n) noexcept {
  return static_cast<unsigned>(n % 2 != 0 && i == n / 2 ? Zone::middle
                               : 2 * i >= n             ? Zone::high
                                                        : Zone::low);
}

enum PatchFlag : std::uint8_t {
  kThroughCorner = 1, ///< 1 << corner: the diagonal of the corner's cell has to pass through it
  kTurned = 16,
  kRepeated = 32,
  /// Shares corners with another patch, or with itself, that no common edge explains: meshes of few
  /// cells may have edges there that coincide.
  kEntangled = 64
};

constexpr bool is_forced_through(unsigned flags, std::size_t corner) noexcept {
  return (flags >> corner & kThroughCorner) != 0;
}
constexpr bool has_forced_diagonal(unsigned flags) noexcept {
  return flags % (kThroughCorner << kPatchCorners) != 0;
}

/// Corners and sides whose normals disagree with those of the first patch there, so that one normal
/// for all cannot be formed: 1 << corner, and 16 << PatchEdge.
enum ApartFlag : std::uint8_t { kApartCorner = 1, kApartSide = 16 };

struct TopologyData {
  FreshVector<Side> sides;          ///< [4 * patch + PatchEdge]
  FreshVector<std::uint32_t> first; ///< of each edge in `members`, and the end of the last one
  FreshVector<std::uint32_t>
      members; ///< 4 * patch + PatchEdge of the sides of all edges, ascending
  FreshVector<std::uint32_t> corners; ///< [4 * patch + corner]: the lowest number of those joined
  FreshVector<std::uint32_t> next_corner; ///< [4 * patch + corner]: the next one of those joined,
                                          ///< ascending, and from the last back to the lowest
  std::vector<std::uint8_t> flags;        ///< PatchFlag, of each patch
  /// Repeated patches, ascending, and the first patch with the control points of each.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> originals;
  /// First sides of edges that are no points, and whose ends are different corners in one place.
  std::vector<std::uint32_t> loops;
  /// ApartFlag of each patch; empty where nothing is apart.
  std::vector<std::uint8_t> apart;
  /// How far a patch's vertices may lie from its own corners and edges, by snapping; or empty.
  std::vector<double> displacement;
  double snap = 0;       ///< TopologyOptions::snap
  double point_size = 0; ///< sides up to this length are points: the larger of point_size and snap
  TopologyCounts counts;

  [[nodiscard]] std::size_t patches() const noexcept { return flags.size(); }
  [[nodiscard]] std::size_t edges() const noexcept { return first.size() - 1; }
  /// The sides of an edge, ascending.
  [[nodiscard]] std::span<const std::uint32_t> sides_of(std::size_t edge) const noexcept {
    return {members.data() + first[edge], first[edge + 1] - first[edge]};
  }
  /// The first edge whose first side is this one or a later one.
  [[nodiscard]] std::size_t edge_from(std::size_t side) const noexcept {
    std::size_t low = 0;
    for (std::size_t high = edges(); low < high;) {
      const std::size_t middle = low + (high - low) / 2;
      const bool is_before = members[first[middle]] < side;
      low = is_before ? middle + 1 : low;
      high = is_before ? high : middle;
    }
    return low;
  }
  /// The corner where a side begins (end 0) or ends (1).
  [[nodiscard]] std::uint32_t corner_of(std::size_t side, std::size_t end) const noexcept {
    return corners[corner_at(side, end)];
  }
  [[nodiscard]] double displacement_of(std::size_t patch) const noexcept {
    return displacement.empty() ? 0 : displacement[patch];
  }
  /// The sides of a corner, 1 << PatchEdge, that count as points though their control points may
  /// not be one.
  [[nodiscard]] unsigned short_sides_at(std::size_t corner) const noexcept {
    unsigned found = 0;
    if (displacement.empty()) {
      return found;
    }
    const std::size_t side = corner / kPatchCorners * kPatchEdges;
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      const bool ends = corner_at(side + k, 0) == corner || corner_at(side + k, 1) == corner;
      found |= ends && sides[side + k].collapsed() ? 1U << k : 0;
    }
    return found;
  }
  /// Whether a side is the first one of its edge.
  [[nodiscard]] bool owns_edge(std::size_t side) const noexcept {
    return !sides[side].collapsed() && members[first[sides[side].edge()]] == side;
  }
  /// Calls visit(corner) for the lowest of some joined corners, and then the others, ascending.
  template <typename Visit>
  void for_joined(std::size_t lowest, const Visit& visit) const {
    std::size_t corner = lowest;
    do {
      visit(corner);
      corner = next_corner[corner];
    } while (corner != lowest);
  }
  [[nodiscard]] bool is_repeated(std::size_t patch) const noexcept {
    return (flags[patch] & kRepeated) != 0;
  }
  /// The first patch with the control points of a patch.
  [[nodiscard]] std::uint32_t original_of(std::uint32_t patch) const noexcept {
    return is_repeated(patch)
               ? std::lower_bound(originals.begin(), originals.end(), std::pair(patch, 0U))->second
               : patch;
  }
  [[nodiscard]] bool is_turned(std::size_t patch) const noexcept {
    return (flags[patch] & kTurned) != 0;
  }
  /// Whether a flag holds of a side or a corner, 4 * patch + number.
  [[nodiscard]] bool is_apart(std::size_t place, ApartFlag flag) const noexcept {
    return !apart.empty() && (apart[place / 4] >> place % 4 & unsigned{flag}) != 0;
  }
  /// Whether the normals of two sides of one edge disagree before patches are turned: they agree
  /// where the boundaries, passed counter-clockwise, run against each other.
  [[nodiscard]] bool disagree(std::size_t a, std::size_t b) const noexcept {
    const bool along = sides[a].reversed() == sides[b].reversed();
    const bool given = along == (counter_clockwise_along(a) == counter_clockwise_along(b));
    return given != (is_turned(a / kPatchEdges) != is_turned(b / kPatchEdges));
  }

  /// Calls at_corner(lowest of the joined corners) for those that a patch owns.
  template <typename AtCorner>
  void for_owned_corners(std::size_t patch, const AtCorner& at_corner) const {
    unsigned owned = 0; // 1 << corner
    for (std::size_t k = 0; k < kPatchCorners; ++k) {
      owned |= (corners[kPatchCorners * patch + k] == kPatchCorners * patch + k ? 1U : 0U) << k;
    }
    for (; owned != 0; owned &= owned - 1) {
      at_corner(static_cast<std::uint32_t>(kPatchCorners * patch) +
                static_cast<std::uint32_t>(std::countr_zero(owned)));
    }
  }
  /// Calls at_edge(edge) for those that a patch owns.
  template <typename AtEdge>
  void for_owned_edges(std::size_t patch, const AtEdge& at_edge) const {
    for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
      if (owns_edge(side)) {
        at_edge(sides[side].edge());
      }
    }
  }

  /// Calls visit(side, other side, other corner) for the corners that a corner of a patch is joined
  /// with by an edge; a side that is a point counts as its own neighbour.
  template <typename Visit>
  void for_neighbours(std::size_t corner, const Visit& visit) const {
    const std::size_t patch = corner / kPatchCorners;
    for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
      for (std::size_t end = 0; end < 2; ++end) {
        if (corner_at(side, end) != corner) {
          continue;
        }
        if (sides[side].collapsed()) {
          visit(side, side, corner_at(side, 1 - end));
          continue;
        }
        for (const std::uint32_t other : sides_of(sides[side].edge())) {
          if (other != side) {
            const bool against = sides[other].reversed() != sides[side].reversed();
            visit(side, other, corner_at(other, against ? 1 - end : end));
          }
        }
      }
    }
  }
};

} // namespace simdbezier::detail
