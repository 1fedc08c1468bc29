// See edge_rings.hpp. Edges are hashed without regard to their direction; those of one hash are
// compared value by value, from the end on that all sides of a ring agree on.
#include "src/nets/edge_rings.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <vector>

#include "src/nets/edge_keys.hpp"
#include "src/nets/edge_values.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier::detail {
namespace {

/// So many sides before one is entered into the table, its place there is fetched.
constexpr std::size_t kAhead = 32;

/// Open addressing: the latest side of each ring, at a place that the low half of its hash leads
/// to, with the high half.
template <typename Index>
class RingTable {
public:
  struct Slot {
    std::uint32_t high = 0;
    Index latest = EdgeRings<Index>::kPoint; ///< that is: none
  };

  explicit RingTable(std::size_t sides)
      : slots_(std::bit_ceil(sides + sides / 4)), mask_(slots_.size() - 1) {}

  void prefetch(std::uint64_t hash) const noexcept { __builtin_prefetch(&slots_[hash & mask_]); }

  /// Enters a side, and returns the latest one before with the same hash of which same(side) is
  /// true, or the side itself if there is none.
  template <typename Same>
  Index enter(std::uint64_t hash, Index side, const Same& same) noexcept {
    const auto high = static_cast<std::uint32_t>(hash >> 32);
    std::size_t at = hash & mask_;
    for (;; at = (at + 1) & mask_) {
      const Slot& slot = slots_[at];
      const bool is_free = slot.latest == EdgeRings<Index>::kPoint;
      const bool is_like = slot.high == high;
      // Taken together, since which of the two it is cannot be predicted.
      if ((is_free | is_like) && (is_free || same(slot.latest))) {
        break;
      }
    }
    const Index latest = slots_[at].latest;
    slots_[at] = {high, side};
    return latest == EdgeRings<Index>::kPoint ? side : latest;
  }

private:
  std::vector<Slot> slots_;
  std::size_t mask_;
};

/// Where the results of hashing go: of every side its hash, and a ring of its own.
template <typename Index>
struct HashTarget {
  EdgeRings<Index>& rings;
  std::uint64_t* hashes;
};

/// Hashes the edges of patches [first, last), which are in one view.
template <typename Keys, typename S, typename Index>
void hash_patches(const AllEdges<S>& edges, std::size_t view, Keys keys, std::size_t first,
                  std::size_t last, HashTarget<Index> to) noexcept {
  Index* const next = to.rings.next.data();
  std::uint8_t* const turned = to.rings.turned.data();
  const bool weighted = edges.form(view, 0).weights != Weights::none;
  for (std::size_t patch = first; patch < last; ++patch) {
    const S* const net = edges.views().net(view, patch);
    keys.read(net);
    const std::size_t side = kPatchEdges * patch;
    bool closed = false;
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      to.hashes[side + k] = keys.hash(k);
      turned[side + k] = keys.runs_against(k) ? 1 : 0;
      next[side + k] = static_cast<Index>(side + k);
      closed |= keys.may_be_closed(k);
    }
    // Different keys at both ends tell the direction, and that the edge is no point; but points
    // are compared without their weights, which keys contain.
    for (std::size_t k = 0; (closed || weighted) && k < kPatchEdges; ++k) {
      const EdgeValues<S> edge(edges.form(view, k), net);
      if (keys.may_be_closed(k)) {
        turned[side + k] = edge.runs_against() ? 1 : 0;
      }
      if (edge.collapsed()) {
        next[side + k] = EdgeRings<Index>::kPoint;
      }
    }
  }
}

template <typename S, typename Index>
void hash_edges(const AllEdges<S>& edges, HashTarget<Index> to, int threads) noexcept {
  auto body = [&](int, std::size_t begin, std::size_t end) {
    edges.views().for_views(begin, end, [&](const auto& nets, auto view, auto first, auto last) {
      if (shape_of(nets).is_bicubic()) {
        hash_patches(edges, view, EdgeKeys<S, 3, 3>(nets), first, last, to);
      } else {
        hash_patches(edges, view, EdgeKeys<S, 0, 0>(nets), first, last, to);
      }
    });
  };
  divide_work(edges.views().patches(), 40, threads, body);
}

/// Links sides of equal hashes, and compares their values a block later, when they have come into a
/// cache. Returns whether all were equal, too; where not, the links are of no use.
template <typename S, typename Index>
bool link_by_hashes(const AllEdges<S>& edges, EdgeRings<Index>& rings,
                    const std::uint64_t* hashes) {
  constexpr std::size_t kBlock = 128;
  const std::size_t sides = rings.next.size();
  RingTable<Index> table(sides);
  Index later[kBlock];
  EdgeValues<S> earlier[kBlock];
  for (std::size_t begin = 0; begin < sides; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, sides);
    std::size_t count = 0;
    for (std::size_t k = begin; k < end; ++k) {
      table.prefetch(hashes[k + kAhead]);
      if (rings.is_point(k)) {
        continue;
      }
      const auto side = static_cast<Index>(k);
      const Index latest = table.enter(hashes[k], side, [](Index) { return true; });
      if (latest != side) {
        rings.link(latest, side);
        earlier[count] = edges[latest].turned(rings.turned[latest] != 0);
        earlier[count].prefetch();
        later[count++] = side;
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (!(edges[later[k]].turned(rings.turned[later[k]] != 0) == earlier[k])) {
        return false;
      }
    }
  }
  return true;
}

/// Links sides of equal values, also where others have the same hash.
template <typename S, typename Index>
void link_by_values(const AllEdges<S>& edges, EdgeRings<Index>& rings,
                    const std::uint64_t* hashes) {
  RingTable<Index> table(rings.next.size());
  const auto agreed = [&](Index side) { return edges[side].turned(rings.turned[side] != 0); };
  for (std::size_t k = 0; k < rings.next.size(); ++k) {
    if (rings.is_point(k)) {
      continue;
    }
    const auto side = static_cast<Index>(k);
    rings.next[k] = side;
    const auto same = [&](Index latest) { return agreed(latest) == agreed(side); };
    rings.link(table.enter(hashes[k], side, same), side);
  }
}

} // namespace

template <typename S, typename Index>
EdgeRings<Index> find_rings(std::span<const ControlNets<S>> nets, int threads) {
  const AllEdges<S> edges(nets);
  const std::size_t sides = kPatchEdges * edges.views().patches();
  EdgeRings<Index> rings;
  if (sides > 0) {
    rings.next.resize(sides);
    rings.turned.resize(sides);
    const auto hashes = std::make_unique_for_overwrite<std::uint64_t[]>(sides + kAhead);
    std::fill_n(hashes.get() + sides, kAhead, 0);
    hash_edges<S, Index>(edges, {rings, hashes.get()}, threads);
    if (!link_by_hashes(edges, rings, hashes.get())) {
      link_by_values(edges, rings, hashes.get());
    }
  }
  return rings;
}

#define SIMDBEZIER_EDGE_RINGS(S)                                                                   \
  template EdgeRings<std::uint32_t> find_rings(std::span<const ControlNets<S>>, int);              \
  template EdgeRings<std::uint64_t> find_rings(std::span<const ControlNets<S>>, int);
SIMDBEZIER_EDGE_RINGS(float)
SIMDBEZIER_EDGE_RINGS(double)
#undef SIMDBEZIER_EDGE_RINGS

} // namespace simdbezier::detail
