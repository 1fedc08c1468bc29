// See entanglement.hpp.
#include "src/mesh/entanglement.hpp"

#include <algorithm>
#include <array>

namespace simdbezier::detail {
namespace {

/// Corners with more patches are left to the pairs' other corners: pairs are compared as a whole.
constexpr std::size_t kMostCompared = 64;

/// Which of the four corners, or sides, of a patch: a bit each.
using Mask = unsigned;

class Neighbours {
public:
  explicit Neighbours(const TopologyData& topology) : topology_(topology) {}

  /// Whether the patch has a corner twice that no side of it joins in a point, or an edge twice.
  [[nodiscard]] bool touches_itself(std::size_t patch) const {
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

  /// Whether two patches share more than one corner, or one edge and its ends.
  [[nodiscard]] bool entangled(std::size_t a, std::size_t b) const {
    Mask corners = 0;
    std::size_t edges = 0;
    Mask ends = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      corners |= has_corner(b, corner(a, k)) ? 1U << k : 0;
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
  [[nodiscard]] const Side& side(std::size_t patch, std::size_t k) const {
    return topology_.sides[kPatchEdges * patch + k];
  }
  [[nodiscard]] std::uint32_t corner(std::size_t patch, std::size_t k) const {
    return topology_.corners[kPatchCorners * patch + k];
  }
  [[nodiscard]] bool has_corner(std::size_t patch, std::uint32_t which) const {
    const auto* const first = &topology_.corners[kPatchCorners * patch];
    return std::find(first, first + kPatchCorners, which) != first + kPatchCorners;
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

/// The patches at every corner: those of corner c from first[c] on.
struct CornerPatches {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> patches;

  explicit CornerPatches(const std::vector<std::uint32_t>& corners)
      : first(corners.size() + 1), patches(corners.size()) {
    for (const std::uint32_t corner : corners) {
      ++first[corner + 1];
    }
    for (std::size_t k = 1; k < first.size(); ++k) {
      first[k] += first[k - 1];
    }
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      patches[next[corners[k]]++] = static_cast<std::uint32_t>(k / kPatchCorners);
    }
  }
};

} // namespace

void mark_entangled(TopologyData& topology) {
  const Neighbours neighbours(topology);
  const CornerPatches at(topology.corners);
  for (std::size_t patch = 0; patch < topology.patches(); ++patch) {
    bool marked = neighbours.touches_itself(patch);
    for (std::size_t k = 0; k < kPatchCorners && !marked; ++k) {
      const std::uint32_t corner = topology.corners[kPatchCorners * patch + k];
      const auto* const begin = at.patches.data() + at.first[corner];
      const auto* const end = at.patches.data() + at.first[corner + 1];
      if (static_cast<std::size_t>(end - begin) <= kMostCompared) {
        marked = std::any_of(begin, end, [&](std::uint32_t other) {
          return other != patch && neighbours.entangled(patch, other);
        });
      }
    }
    topology.flags[patch] |= marked ? kEntangled : 0;
  }
}

} // namespace simdbezier::detail
