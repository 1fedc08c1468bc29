// Comparisons of patches by the corners and edges that they have in common.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {

/// A bit for each of the four corners, or sides, of a patch.
using Mask = unsigned;

class Neighbours {
public:
  explicit Neighbours(const TopologyData& topology) : topology_(topology) {}

  /// Whether the patch has an edge twice, or a corner twice that no side joins by being a point.
  [[nodiscard]] bool touches_itself(std::size_t patch) const {
    if (has_four_corners(patch)) {
      return false; // different sides have different ends then
    }
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) {
        const Side& p = side(patch, a);
        const Side& q = side(patch, b);
        if ((!p.collapsed() && !q.collapsed() && p.edge() == q.edge()) ||
            (corner(patch, a) == corner(patch, b) && !joined_in_a_point(patch, a, b))) {
          return true;
        }
      }
    }
    return false;
  }

  /// The corners of a patch that another one has as well.
  [[nodiscard]] Mask common_corners(std::size_t a, std::size_t b) const {
    // Each of one against each of the other, four at once: these are most of all comparisons.
    typedef std::uint32_t Four __attribute__((vector_size(16)));
    Four own;
    Four others;
    std::memcpy(&own, &topology_.corners[kPatchCorners * a], sizeof own);
    std::memcpy(&others, &topology_.corners[kPatchCorners * b], sizeof others);
    const auto is_one = (own == others) |
                        (own == __builtin_shufflevector(others, others, 1, 2, 3, 0)) |
                        (own == __builtin_shufflevector(others, others, 2, 3, 0, 1)) |
                        (own == __builtin_shufflevector(others, others, 3, 0, 1, 2));
    const auto bits = is_one & Four{1, 2, 4, 8};
    return static_cast<Mask>(bits[0] | bits[1] | bits[2] | bits[3]);
  }
  /// Whether two patches share more than one corner, or than one edge with its ends.
  [[nodiscard]] bool entangled(std::size_t a, std::size_t b, Mask corners) const {
    if ((corners & (corners - 1)) == 0) {
      return false; // an edge would have two of them
    }
    if (has_edge_between(a, b, corners)) {
      return false;
    }
    std::size_t edges = 0;
    Mask ends = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Side& own = side(a, k);
      if (!own.collapsed() && has_edge(b, own.edge())) {
        ++edges;
        ends |= corners_like(a, kSideCorners[k][0]) | corners_like(a, kSideCorners[k][1]);
      }
    }
    if (edges > 1) {
      return true;
    }
    if (edges == 1) {
      return corners != ends;
    }
    // Corners that are one count once.
    for (std::size_t k = 0; k < 4; ++k) {
      if ((corners >> k & 1) != 0) {
        return corners != corners_like(a, k);
      }
    }
    return false;
  }

private:
  [[nodiscard]] bool has_four_corners(std::size_t patch) const {
    const auto* const own = &topology_.corners[kPatchCorners * patch];
    return (own[0] != own[1]) & (own[0] != own[2]) & (own[0] != own[3]) & (own[1] != own[2]) &
           (own[1] != own[3]) & (own[2] != own[3]);
  }
  /// Whether two patches share two corners, and the edge between them, which is what patches side
  /// by side do: no second edge has the same ends if the four corners of the one differ.
  [[nodiscard]] bool has_edge_between(std::size_t a, std::size_t b, Mask corners) const {
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      if (corners == (1U << kSideCorners[k][0] | 1U << kSideCorners[k][1])) {
        const Side& own = side(a, k);
        return !own.collapsed() && has_edge(b, own.edge()) && has_four_corners(a);
      }
    }
    return false;
  }
  [[nodiscard]] const Side& side(std::size_t patch, std::size_t k) const {
    return topology_.sides[kPatchEdges * patch + k];
  }
  [[nodiscard]] std::uint32_t corner(std::size_t patch, std::size_t k) const {
    return topology_.corners[kPatchCorners * patch + k];
  }
  [[nodiscard]] bool has_edge(std::size_t patch, std::uint32_t edge) const {
    const auto* const first = &topology_.sides[kPatchEdges * patch];
    return std::any_of(first, first + kPatchEdges, [&](const Side& other) {
      return !other.collapsed() && other.edge() == edge;
    });
  }
  /// The corners of a patch that are the same as corner k.
  [[nodiscard]] Mask corners_like(std::size_t patch, std::size_t k) const {
    Mask mask = 0;
    for (std::size_t other = 0; other < 4; ++other) {
      mask |= corner(patch, other) == corner(patch, k) ? 1U << other : 0;
    }
    return mask;
  }
  [[nodiscard]] bool joined_in_a_point(std::size_t patch, std::size_t a, std::size_t b) const {
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      if (side(patch, k).collapsed() && kSideCorners[k][0] == a && kSideCorners[k][1] == b) {
        return true;
      }
    }
    return false;
  }

  const TopologyData& topology_;
};

} // namespace simdbezier::detail
