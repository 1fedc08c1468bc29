// See entanglement.hpp.
#include "src/mesh/topology/entanglement.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace simdbezier::detail {
namespace {

/// Patches at corners with at most so many of them are compared one by one.
constexpr std::size_t kMostAtCorner = 64;

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

/// Corners with so many patches that they are not compared one by one.
class CrowdedPlaces {
public:
  explicit CrowdedPlaces(const std::vector<std::uint32_t>& corners) : patches_(corners.size()) {
    for (const std::uint32_t corner : corners) {
      if (!is_more(patches_[corner])) {
        ++patches_[corner];
      }
    }
    any_ = std::any_of(patches_.begin(), patches_.end(), is_more);
  }
  [[nodiscard]] bool any() const { return any_; }
  [[nodiscard]] bool has(std::uint32_t corner) const { return is_more(patches_[corner]); }

private:
  static bool is_more(std::uint8_t patches) { return patches > kMostAtCorner; }
  std::vector<std::uint8_t> patches_; ///< at every corner, kMostAtCorner + 1 standing for more
  bool any_ = false;
};

/// Finds the patches that are entangled with those with which they share crowded corners only:
/// neighbours are counted instead of compared.
class CrowdedCorners {
public:
  CrowdedCorners(const TopologyData& topology, const CrowdedPlaces& places)
      : topology_(topology), places_(places) {
    if (places.any()) {
      count_all();
    }
  }

  /// Whether a patch, which has no edge twice, shares two edges with another patch, or two corners
  /// that no common edge joins: those that share one edge have both of its ends.
  [[nodiscard]] bool entangled(std::size_t patch) {
    if (!places_.any()) {
      return false;
    }
    find_pairs(patch);
    return std::any_of(edge_pairs_.begin(), edge_pairs_.end(),
                       [&](Pair pair) { return count(edges_, pair) > 1; }) ||
           std::any_of(corner_pairs_.begin(), corner_pairs_.end(), [&](Pair pair) {
             return count(corners_, pair) > 1 + neighbours_across(patch, pair);
           });
  }

private:
  using Pair = std::uint64_t;

  void count_all() {
    for (std::size_t patch = 0; patch < topology_.patches(); ++patch) {
      find_pairs(patch);
      corners_.insert(corners_.end(), corner_pairs_.begin(), corner_pairs_.end());
      edges_.insert(edges_.end(), edge_pairs_.begin(), edge_pairs_.end());
    }
    std::sort(corners_.begin(), corners_.end());
    std::sort(edges_.begin(), edges_.end());
    edge_patches_.resize(topology_.edges());
    for (std::size_t edge = 0; edge < topology_.edges(); ++edge) {
      std::size_t last = topology_.patches();
      for (const std::uint32_t side : topology_.sides_of(edge)) { // ascending
        edge_patches_[edge] += side / kPatchEdges != last ? 1 : 0;
        last = side / kPatchEdges;
      }
    }
  }

  static std::size_t count(const std::vector<Pair>& pairs, Pair pair) {
    const auto [begin, end] = std::equal_range(pairs.begin(), pairs.end(), pair);
    return static_cast<std::size_t>(end - begin);
  }
  static void insert(std::vector<Pair>& pairs, Pair pair) {
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) {
      pairs.push_back(pair);
    }
  }

  /// A patch's different crowded corners, and its edges between such, two by two.
  void find_pairs(std::size_t patch) {
    corner_pairs_.clear();
    edge_pairs_.clear();
    const auto edge_of = [&](std::size_t k) -> const Side* {
      const std::size_t side = kPatchEdges * patch + k;
      const bool crowded = !topology_.sides[side].collapsed() &&
                           places_.has(topology_.corner_of(side, 0)) &&
                           places_.has(topology_.corner_of(side, 1));
      return crowded ? &topology_.sides[side] : nullptr;
    };
    for (std::size_t a = 0; a < 4; ++a) {
      const std::uint32_t corner = topology_.corners[kPatchCorners * patch + a];
      for (std::size_t b = a + 1; b < 4; ++b) {
        const std::uint32_t other = topology_.corners[kPatchCorners * patch + b];
        if (corner != other && places_.has(corner) && places_.has(other)) {
          insert(corner_pairs_, pair_of(corner, other));
        }
        if (edge_of(a) != nullptr && edge_of(b) != nullptr) {
          insert(edge_pairs_, pair_of(edge_of(a)->edge(), edge_of(b)->edge()));
        }
      }
    }
  }
  /// The patches behind the edges that join a patch's two corners.
  [[nodiscard]] std::size_t neighbours_across(std::size_t patch, Pair corners) const {
    std::size_t neighbours = 0;
    for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
      if (!topology_.sides[side].collapsed() &&
          pair_of(topology_.corner_of(side, 0), topology_.corner_of(side, 1)) == corners) {
        neighbours += edge_patches_[topology_.sides[side].edge()] - 1;
      }
    }
    return neighbours;
  }

  const TopologyData& topology_;
  const CrowdedPlaces& places_;
  std::vector<std::uint32_t> edge_patches_; ///< how many there are at every edge
  std::vector<Pair> corners_;               ///< of all patches
  std::vector<Pair> edges_;
  std::vector<Pair> corner_pairs_; ///< of one patch
  std::vector<Pair> edge_pairs_;
};

} // namespace

void mark_entangled(TopologyData& topology) {
  const Neighbours neighbours(topology);
  const CrowdedPlaces places(topology.corners);
  CrowdedCorners crowded(topology, places);
  for (std::size_t patch = 0; patch < topology.patches(); ++patch) {
    bool marked = neighbours.touches_itself(patch);
    Mask compared = 0; // corners whose patches have been
    for (std::size_t k = 0; k < kPatchCorners && !marked; ++k) {
      const std::size_t own = kPatchCorners * patch + k;
      if (places.has(topology.corners[own])) {
        continue;
      }
      for (std::size_t at = topology.next_corner[own]; at != own && !marked;
           at = topology.next_corner[at]) {
        const std::size_t other = at / kPatchCorners;
        if (other != patch) {
          const Mask common = neighbours.common_corners(patch, other);
          marked = (common & compared) == 0 && neighbours.entangled(patch, other, common);
        }
      }
      compared |= 1U << k;
    }
    marked = marked || crowded.entangled(patch);
    topology.flags[patch] |= marked ? kEntangled : 0;
  }
}

} // namespace simdbezier::detail
