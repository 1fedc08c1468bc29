// See edge_rings.hpp. Edges are hashed without regard to their direction; those of one hash are
// compared value by value, from the end on that all sides of a ring agree on.
#include "src/nets/edge_rings.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>
#include <vector>

#include "src/nets/edge_keys.hpp"
#include "src/nets/edge_values.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fresh_vector.hpp"

namespace simdbezier::detail {
namespace {

/// So many sides before one is entered into the table, its place there is fetched.
constexpr std::size_t kAhead = 32;

/// Open addressing: the latest side of each ring, at a place that the low half of its hash leads
/// to, with the high half.
class RingTable {
public:
  explicit RingTable(std::size_t sides)
      : slots_(std::bit_ceil(sides + sides / 4 + 1)), mask_(slots_.size() - 1) {}

  /// To be called first, by the thread that enters sides.
  void clear() noexcept { std::fill(slots_.begin(), slots_.end(), Slot{0, EdgeRings::kPoint}); }
  /// How many rings there is room for.
  [[nodiscard]] std::size_t room() const noexcept { return mask_; }

  void prefetch(std::uint64_t hash) const noexcept { __builtin_prefetch(&slots_[hash & mask_]); }

  /// Enters a side, and returns the latest one before with the same hash of which same(side) is
  /// true, or the side itself if there is none.
  template <typename Same>
  std::uint32_t enter(std::uint64_t hash, std::uint32_t side, const Same& same) noexcept {
    const auto high = static_cast<std::uint32_t>(hash >> 32);
    std::size_t at = hash & mask_;
    for (;; at = (at + 1) & mask_) {
      const Slot& slot = slots_[at];
      const bool is_free = slot.latest == EdgeRings::kPoint;
      const bool is_like = slot.high == high;
      // Taken together, since which of the two it is cannot be predicted.
      if ((is_free | is_like) && (is_free || same(slot.latest))) {
        break;
      }
    }
    const std::uint32_t latest = slots_[at].latest;
    slots_[at] = {high, side};
    return latest == EdgeRings::kPoint ? side : latest;
  }

private:
  struct Slot {
    std::uint32_t high;
    std::uint32_t latest; ///< kPoint: none
  };

  FreshVector<Slot> slots_;
  std::size_t mask_;
};

/// Where the results of hashing go: of every side its hash, and a ring of its own.
struct HashTarget {
  EdgeRings& rings;
  std::uint64_t* hashes;
};

/// Hashes the edges of patches [first, last), which are in one view.
template <typename Keys, typename S>
void hash_patches(const AllEdges<S>& edges, std::size_t view, Keys keys, std::size_t first,
                  std::size_t last, HashTarget to) noexcept {
  std::uint32_t* const next = to.rings.next.data();
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
      next[side + k] = static_cast<std::uint32_t>(side + k);
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
        next[side + k] = EdgeRings::kPoint;
      }
    }
  }
}

template <typename S>
void hash_edges(const AllEdges<S>& edges, HashTarget to, int threads) noexcept {
  auto body = [&](int, std::size_t begin, std::size_t end) {
    edges.views().for_views(begin, end, [&](const auto& nets, auto view, auto first, auto last) {
      with_keys(nets, [&](const auto& keys) { hash_patches(edges, view, keys, first, last, to); });
    });
  };
  divide_work(edges.views().patches(), 40, threads, body);
}

/// Links one part of all sides, which equal hashes are in together, so that each part can be linked
/// by a thread of its own.
template <typename S>
class PartLinker {
public:
  PartLinker(const AllEdges<S>& edges, EdgeRings& rings, std::span<const std::uint64_t> hashes,
             std::size_t part, std::size_t parts)
      : edges_(edges), rings_(rings), hashes_(hashes), part_(part), parts_(parts),
        own_(std::min(kPassed, hashes.size()) + kAhead),
        table_(hashes.size() / parts + (parts > 1 ? kUneven : 0)) {}

  /// Links sides of equal hashes. Returns whether all of them are equal and there was room for all;
  /// where not, the links are of no use.
  [[nodiscard]] bool run() noexcept {
    table_.clear();
    for (std::size_t begin = 0; begin < hashes_.size(); begin += kPassed) {
      const auto own = own_sides(begin, std::min(begin + kPassed, hashes_.size()));
      if (count_ + own.size() > table_.room()) {
        return false;
      }
      for (std::size_t first = 0; first < own.size(); first += kCompared) {
        if (!link(first, std::min(first + kCompared, own.size()))) {
          return false;
        }
      }
    }
    return true;
  }

private:
  static constexpr std::size_t kPassed = 4096;  ///< sides that are passed to find those of the part
  static constexpr std::size_t kCompared = 128; ///< sides that are linked before they are compared
  static constexpr std::size_t kUneven = 256;   ///< room for parts that are not all of one size

  /// The part's sides of [begin, end), ascending.
  [[nodiscard]] std::span<const std::uint32_t> own_sides(std::size_t begin,
                                                         std::size_t end) noexcept {
    std::size_t count = 0;
    if (parts_ == 1) {
      count = end - begin;
      std::iota(own_.begin(), own_.begin() + static_cast<std::ptrdiff_t>(count),
                static_cast<std::uint32_t>(begin));
    }
    for (std::size_t side = begin; parts_ > 1 && side < end; ++side) {
      own_[count] = static_cast<std::uint32_t>(side);
      count += (hashes_[side] >> 32) * parts_ >> 32 == part_ ? 1 : 0;
    }
    std::fill_n(own_.begin() + static_cast<std::ptrdiff_t>(count), kAhead,
                static_cast<std::uint32_t>(begin));
    return {own_.data(), count};
  }

  /// Links own sides [begin, end), and compares their values afterwards, when these have come into
  /// a cache.
  [[nodiscard]] bool link(std::size_t begin, std::size_t end) noexcept {
    std::uint32_t later[kCompared];
    EdgeValues<S> earlier[kCompared];
    std::size_t count = 0;
    for (std::size_t k = begin; k < end; ++k) {
      table_.prefetch(hashes_[own_[k + kAhead]]);
      const std::uint32_t side = own_[k];
      if (rings_.is_point(side)) {
        continue;
      }
      const std::uint32_t latest =
          table_.enter(hashes_[side], side, [](std::uint32_t) { return true; });
      if (latest != side) {
        rings_.link(latest, side);
        earlier[count] = agreed(latest);
        earlier[count].prefetch();
        later[count++] = side;
      } else {
        ++count_;
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (!(agreed(later[k]) == earlier[k])) {
        return false;
      }
    }
    return true;
  }
  /// The values of a side in the direction on which its ring agrees.
  [[nodiscard]] EdgeValues<S> agreed(std::uint32_t side) const noexcept {
    return edges_[side].turned(rings_.turned[side] != 0);
  }

  const AllEdges<S>& edges_;
  EdgeRings& rings_;
  std::span<const std::uint64_t> hashes_;
  std::size_t part_;
  std::size_t parts_;
  FreshVector<std::uint32_t>
      own_; ///< those passed last, and some behind them that are fetched in vain
  RingTable table_;
  std::size_t count_ = 0; ///< of rings
};

/// Links sides of equal hashes, as many parts at once as there are threads; see PartLinker::run().
template <typename S>
bool link_by_hashes(const AllEdges<S>& edges, EdgeRings& rings,
                    std::span<const std::uint64_t> hashes, int threads) {
  const Shares parts(hashes.size(), 10, threads);
  std::vector<PartLinker<S>> linkers;
  for (std::size_t part = 0; part < parts.count(); ++part) {
    linkers.emplace_back(edges, rings, hashes, part, parts.count());
  }
  std::atomic<bool> linked = true;
  parts.run([&](std::size_t part) {
    if (!linkers[part].run()) {
      linked = false;
    }
  });
  return linked;
}

/// Links sides of equal values, also where others have the same hash.
template <typename S>
void link_by_values(const AllEdges<S>& edges, EdgeRings& rings,
                    std::span<const std::uint64_t> hashes) {
  RingTable table(hashes.size());
  table.clear();
  const auto agreed = [&](std::uint32_t side) {
    return edges[side].turned(rings.turned[side] != 0);
  };
  for (std::size_t k = 0; k < hashes.size(); ++k) {
    if (rings.is_point(k)) {
      continue;
    }
    const auto side = static_cast<std::uint32_t>(k);
    rings.next[k] = side;
    const auto same = [&](std::uint32_t latest) { return agreed(latest) == agreed(side); };
    rings.link(table.enter(hashes[k], side, same), side);
  }
}

} // namespace

template <typename S>
EdgeRings find_rings(std::span<const ControlNets<S>> nets, int threads) {
  const AllEdges<S> edges(nets);
  const std::size_t sides = kPatchEdges * edges.views().patches();
  EdgeRings rings;
  if (sides > 0) {
    rings.next.resize(sides);
    rings.turned.resize(sides);
    FreshVector<std::uint64_t> hashes(sides);
    hash_edges<S>(edges, {rings, hashes.data()}, threads);
    if (!link_by_hashes<S>(edges, rings, hashes, threads)) {
      link_by_values<S>(edges, rings, hashes);
    }
  }
  return rings;
}

SIMDBEZIER_OF_BOTH_TYPES(find_rings);

} // namespace simdbezier::detail
