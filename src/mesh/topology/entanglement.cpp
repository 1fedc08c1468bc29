// See entanglement.hpp.
#include "src/mesh/topology/entanglement.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <vector>

#include "src/mesh/topology/neighbours.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/fresh_vector.hpp"
#include "src/runtime/sort.hpp"

namespace simdbezier::detail {
namespace {

/// Patches at corners with at most so many of them are compared one by one.
constexpr std::size_t kMostAtCorner = 64;

/// Corners with so many patches that they are not compared one by one.
class CrowdedPlaces {
public:
  explicit CrowdedPlaces(std::span<const std::uint32_t> corners) : patches_(corners.size()) {
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
    sort_range(corners_.begin(), corners_.end());
    sort_range(edges_.begin(), edges_.end());
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
  if (candidates.empty()) {
    return;
  }
  const Neighbours neighbours(topology);
  const CrowdedPlaces places(topology.corners);
  CrowdedCorners crowded(topology, places);
  for (const std::uint32_t patch : candidates) {
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
