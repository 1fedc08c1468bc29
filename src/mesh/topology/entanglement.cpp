#include "src/mesh/topology/marks.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <vector>

#include "src/runtime/batch.hpp"
#include "src/runtime/fresh_vector.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier::detail {
namespace {

/// How many of some patches have the same two corners, or the same two edges.
class CommonPairs {
public:
  CommonPairs(const TopologyData& topology, std::span<const std::uint32_t> patches)
      : topology_(topology) {
    for (const std::uint32_t patch : patches) {
      find_pairs(patch);
      corners_.insert(corners_.end(), own_corners_.begin(), own_corners_.end());
      edges_.insert(edges_.end(), own_edges_.begin(), own_edges_.end());
    }
    sort_range(corners_.begin(), corners_.end());
    sort_range(edges_.begin(), edges_.end());
  }

  /// Whether a patch has an edge twice, or a corner twice that no side joins by being a point; or
  /// shares two edges with another patch, or two corners that no common edge joins: those that
  /// share one edge have both of its ends.
  [[nodiscard]] bool entangled(std::size_t patch) {
    find_pairs(patch);
    return touches_itself(patch) ||
           std::any_of(own_edges_.begin(), own_edges_.end(),
                       [&](Pair pair) {
                         return pair != edge_itself(static_cast<std::uint32_t>(pair)) &&
                                count(edges_, pair) > 1;
                       }) ||
           std::any_of(own_corners_.begin(), own_corners_.end(), [&](Pair pair) {
             return count(corners_, pair) > 1 + neighbours_across(patch, pair);
           });
  }

private:
  using Pair = std::uint64_t;

  static Pair edge_itself(std::uint32_t edge) { return pair_of(edge, edge); }
  static std::size_t count(const std::vector<Pair>& pairs, Pair pair) {
    const auto [begin, end] = std::equal_range(pairs.begin(), pairs.end(), pair);
    return static_cast<std::size_t>(end - begin);
  }
  static void insert(std::vector<Pair>& pairs, Pair pair) {
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) {
      pairs.push_back(pair);
    }
  }
  [[nodiscard]] const Side& side(std::size_t patch, std::size_t k) const {
    return topology_.sides[kPatchEdges * patch + k];
  }
  [[nodiscard]] std::uint32_t corner(std::size_t patch, std::size_t k) const {
    return topology_.corners[kPatchCorners * patch + k];
  }

  /// A patch's different corners, and its edges, two by two and each with itself.
  void find_pairs(std::size_t patch) {
    own_corners_.clear();
    own_edges_.clear();
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a; b < 4; ++b) {
        if (corner(patch, a) != corner(patch, b)) {
          insert(own_corners_, pair_of(corner(patch, a), corner(patch, b)));
        }
        if (!side(patch, a).collapsed() && !side(patch, b).collapsed()) {
          insert(own_edges_, pair_of(side(patch, a).edge(), side(patch, b).edge()));
        }
      }
    }
  }
  /// The patches behind the edges that join a patch's two corners.
  [[nodiscard]] std::size_t neighbours_across(std::size_t patch, Pair corners) const {
    std::size_t neighbours = 0;
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      const Side& own = side(patch, k);
      if (!own.collapsed() && pair_of(corner(patch, kSideCorners[k][0]),
                                      corner(patch, kSideCorners[k][1])) == corners) {
        neighbours += count(edges_, edge_itself(own.edge())) - 1;
      }
    }
    return neighbours;
  }

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
  [[nodiscard]] bool joined_in_a_point(std::size_t patch, std::size_t a, std::size_t b) const {
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      if (side(patch, k).collapsed() && kSideCorners[k][0] == a && kSideCorners[k][1] == b) {
        return true;
      }
    }
    return false;
  }

  const TopologyData& topology_;
  std::vector<Pair> corners_;
  std::vector<Pair> edges_;       ///< those with themselves tell how many patches have an edge
  std::vector<Pair> own_corners_; ///< of one patch
  std::vector<Pair> own_edges_;
};

/// Looks for corners whose patches are candidates. From each corner, its patches reach others along
/// edges and diagonals. Patches that share two corners, and not just the edge between them, reach
/// the one from the other in two ways; and a patch that has a corner twice reaches it from itself,
/// or another one in two ways.
class ReachedCorners {
public:
  /// For corners where at most so many patches meet, one or more.
  ReachedCorners(const TopologyData& topology, std::size_t patches)
      : topology_(&topology), patches_(patches), slots_(2 * std::bit_ceil(3 * patches + 1)) {}

  [[nodiscard]] std::size_t most_patches() const noexcept { return patches_; }

  enum class Answer : std::uint8_t { no, yes, crowded };
  /// Whether patches reach a corner in two ways from this one, where not too many meet.
  [[nodiscard]] Answer twice_from(std::uint32_t corner) noexcept {
    constexpr std::uint64_t kItself = ~std::uint64_t{0};
    constexpr std::uint64_t kDiagonal = std::uint64_t{1} << 32;
    Slot* const slots = slots_.data();
    const std::size_t mask = slots_.size() - 1;
    const std::uint64_t from = (std::uint64_t{corner} + 1) << 32;
    bool twice = false;
    const auto reach = [&](std::size_t to, std::uint64_t way) {
      if (topology_->corners[to] < corner) {
        return; // from there, the same ways lead here
      }
      const std::uint64_t key = from | topology_->corners[to];
      std::size_t at = key & mask;
      while ((slots[at].key ^ key) - 1 < 0xffffffff) { // another corner, from the same one
        at = (at + 1) & mask;
      }
      twice |= (slots[at].key == key) & (slots[at].way != way);
      slots[at] = {key, way};
    };
    const auto along = [&](std::size_t side) { return topology_->sides[side].edge(); };
    reach(corner, kItself);
    std::size_t k = corner;
    std::size_t left = patches_;
    do {
      const std::size_t patch = k / kPatchCorners;
      reach(k ^ 1, along(kPatchEdges * patch + k % kPatchCorners / 2));
      reach(k ^ 2, along(kPatchEdges * patch + 2 + k % 2));
      reach(k ^ 3, kDiagonal | patch);
      k = topology_->next_corner[k];
    } while (k != corner && --left > 0);
    return k != corner ? Answer::crowded : twice ? Answer::yes : Answer::no;
  }

private:
  struct Slot {
    std::uint64_t key = 0; ///< where ways began, plus 1, and the corner that they led to
    std::uint64_t way = 0;
  };

  const TopologyData* topology_;
  std::size_t patches_;
  std::vector<Slot> slots_; ///< what was reached from earlier corners counts as free
};

/// All patches at corners with the answer yes. Corners of patches with another answer than no are
/// asked again, with room for all that meet there.
std::vector<std::uint32_t> patches_at(const TopologyData& topology, ReachedCorners& reached,
                                      std::span<const ReachedCorners::Answer> of_patches) {
  std::vector<std::uint32_t> found;
  for (std::size_t corner = 0; corner < topology.corners.size(); ++corner) {
    if (of_patches[corner / kPatchCorners] == ReachedCorners::Answer::no ||
        topology.corners[corner] != corner) {
      continue;
    }
    std::size_t meeting = 0;
    topology.for_joined(corner, [&](auto) { ++meeting; });
    if (meeting > reached.most_patches()) {
      reached = ReachedCorners(topology, 2 * meeting);
    }
    if (reached.twice_from(static_cast<std::uint32_t>(corner)) == ReachedCorners::Answer::yes) {
      topology.for_joined(corner, [&](std::size_t joined) {
        found.push_back(static_cast<std::uint32_t>(joined / kPatchCorners));
      });
    }
  }
  sort_range(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

} // namespace

std::vector<std::uint32_t> entanglement_candidates(const TopologyData& topology, int threads) {
  using Answer = ReachedCorners::Answer;
  constexpr std::size_t kUsualPatches = 170; // for a table that fits the fastest cache
  const Shares shares(topology.patches(), 15, threads);
  std::vector<ReachedCorners> reached(shares.count(), ReachedCorners(topology, kUsualPatches));
  FreshVector<Answer> answers(topology.patches()); // the largest of those of a patch's corners
  std::atomic<bool> is_usual = true;
  shares.run([&](std::size_t share) {
    Answer most = Answer::no;
    for (std::size_t patch = shares.begin(share); patch < shares.end(share); ++patch) {
      Answer answer = Answer::no;
      for (std::size_t k = kPatchCorners * patch; k < kPatchCorners * (patch + 1); ++k) {
        if (topology.corners[k] == k) {
          answer = std::max(answer, reached[share].twice_from(static_cast<std::uint32_t>(k)));
        }
      }
      answers[patch] = answer;
      most = std::max(most, answer);
    }
    if (most != Answer::no) {
      is_usual = false;
    }
  });
  return is_usual ? std::vector<std::uint32_t>() : patches_at(topology, reached[0], answers);
}

void mark_entangled(std::span<const std::uint32_t> candidates, TopologyData& topology) {
  CommonPairs pairs(topology, candidates); // with which alone they can be entangled
  for (const std::uint32_t patch : candidates) {
    if (pairs.entangled(patch)) {
      topology.flags[patch] |= kEntangled;
    }
  }
}

} // namespace simdbezier::detail
