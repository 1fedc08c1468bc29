// See edge_rings.hpp. Every edge is reduced to a direction that both of its sides agree on, then
// hashed; edges of one hash are compared value by value.
#include "src/nets/edge_rings.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <type_traits>

#include "src/nets/net_views.hpp"
#include "src/runtime/batch.hpp"
#include "src/storage/net_shape.hpp"

namespace simdbezier::detail {
namespace {

/// The values of one edge, in the direction of its parameter or against it.
template <typename S>
class EdgeValues {
public:
  using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;

  EdgeValues(const ControlNets<S>& nets, std::size_t patch, PatchEdge edge) noexcept
      : channels_(static_cast<std::ptrdiff_t>(shape_of(nets).channels())),
        component_stride_(nets.component_stride), weights_(nets.weights) {
    const bool in_u = edge == PatchEdge::v0 || edge == PatchEdge::v1;
    degree_ = in_u ? nets.degree_u : nets.degree_v;
    stride_ = in_u ? nets.point_stride : nets.row_stride;
    first_ = nets.points + static_cast<std::ptrdiff_t>(patch) * nets.patch_stride;
    if (edge == PatchEdge::v1) {
      first_ += nets.degree_v * nets.row_stride;
    } else if (edge == PatchEdge::u1) {
      first_ += nets.degree_u * nets.point_stride;
    }
    turn();
  }

  /// Whether the agreed direction is against the edge's own: not where both give the same values.
  [[nodiscard]] bool turned() const noexcept { return turned_; }

  [[nodiscard]] bool operator==(const EdgeValues& other) const noexcept {
    if (degree_ != other.degree_ || channels_ != other.channels_ || weights_ != other.weights_) {
      return false;
    }
    for (std::ptrdiff_t k = 0; k <= degree_; ++k) {
      for (std::ptrdiff_t c = 0; c < channels_; ++c) {
        if (bits(k, c) != other.bits(k, c)) {
          return false;
        }
      }
    }
    return true;
  }

  /// Whether all points are equal, whatever their weights.
  [[nodiscard]] bool collapsed() const noexcept {
    const std::ptrdiff_t components = weights_ == Weights::none ? channels_ : channels_ - 1;
    for (std::ptrdiff_t k = 1; k <= degree_; ++k) {
      for (std::ptrdiff_t c = 0; c < components; ++c) {
        if (!same_coordinate(k, c)) {
          return false;
        }
      }
    }
    return true;
  }

  /// Multiplication and the high half's return to the low one (the finaliser of MurmurHash3), on
  /// sums of four values at a time, whose products do not wait for each other.
  [[nodiscard]] std::uint64_t hash() const noexcept {
    constexpr std::uint64_t kFactors[4] = {0x9e3779b97f4a7c15ULL, 0xbf58476d1ce4e5b9ULL,
                                           0x94d049bb133111ebULL, 0xd6e8feb86659fd93ULL};
    const auto mixed = [](std::uint64_t state) {
      state *= 0xff51afd7ed558ccdULL;
      return state ^ (state >> 33);
    };
    std::uint64_t state = static_cast<std::uint64_t>(degree_) * 64 +
                          static_cast<std::uint64_t>(channels_) * 4 +
                          static_cast<std::uint64_t>(weights_);
    for (std::ptrdiff_t k = 0; k <= degree_; ++k) {
      for (std::ptrdiff_t first = 0; first < channels_; first += 4) {
        std::uint64_t sum = 0;
        for (std::ptrdiff_t c = first; c < channels_ && c < first + 4; ++c) {
          sum += bits(k, c) * kFactors[c - first];
        }
        state = mixed(state ^ sum);
      }
    }
    state *= 0xc4ceb9fe1a85ec53ULL;
    return state ^ (state >> 33);
  }

private:
  /// Value c of point k in the agreed direction; -0 as +0.
  [[nodiscard]] Bits bits(std::ptrdiff_t k, std::ptrdiff_t c) const noexcept {
    return at(turned_ ? degree_ - k : k, c);
  }
  [[nodiscard]] Bits at(std::ptrdiff_t k, std::ptrdiff_t c) const noexcept {
    const auto value = std::bit_cast<Bits>(first_[k * stride_ + c * component_stride_]);
    constexpr Bits kSign = Bits{1} << (8 * sizeof(Bits) - 1);
    return value == kSign ? 0 : value;
  }

  /// Whether point k has the coordinate of point 0.
  [[nodiscard]] bool same_coordinate(std::ptrdiff_t k, std::ptrdiff_t c) const noexcept {
    if (weights_ != Weights::homogeneous) {
      return at(k, c) == at(0, c);
    }
    const auto point = [&](std::ptrdiff_t i) {
      const S* const values = first_ + i * stride_;
      return values[c * component_stride_] / values[(channels_ - 1) * component_stride_];
    };
    return point(k) == point(0);
  }

  /// The agreed direction has the smaller bits where both first differ.
  void turn() noexcept {
    for (std::ptrdiff_t k = 0; k <= degree_ / 2; ++k) {
      for (std::ptrdiff_t c = 0; c < channels_; ++c) {
        const Bits forward = at(k, c);
        const Bits backward = at(degree_ - k, c);
        if (forward != backward) {
          turned_ = backward < forward;
          return;
        }
      }
    }
  }

  const S* first_;
  std::ptrdiff_t degree_;
  std::ptrdiff_t stride_;
  std::ptrdiff_t channels_;
  std::ptrdiff_t component_stride_;
  Weights weights_;
  bool turned_ = false;
};

template <typename S>
EdgeValues<S> edge_of(const NetViews<S>& views, std::size_t side) noexcept {
  const auto [nets, patch] = views.place(side / kPatchEdges);
  return {*nets, patch, static_cast<PatchEdge>(side % kPatchEdges)};
}

/// Open addressing: the latest side of each ring, at a place that its hash leads to.
template <typename Index>
struct RingTable {
  static constexpr Index kNone = EdgeRings<Index>::kPoint;
  std::unique_ptr<Index[]> hash; ///< of every side
  std::vector<Index> slot;

  explicit RingTable(std::size_t sides)
      : hash(std::make_unique_for_overwrite<Index[]>(sides)),
        slot(std::bit_ceil(sides + sides / 2), kNone) {}
};

template <typename S, typename Index>
void hash_edges(const NetViews<S>& views, EdgeRings<Index>& rings, RingTable<Index>& table,
                int threads) noexcept {
  auto body = [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t side = begin; side < end; ++side) {
      const EdgeValues<S> edge = edge_of(views, side);
      table.hash[side] = static_cast<Index>(edge.hash());
      rings.turned[side] = edge.turned() ? 1 : 0;
      rings.next[side] = edge.collapsed() ? EdgeRings<Index>::kPoint : static_cast<Index>(side);
    }
  };
  const std::size_t sides = rings.next.size();
  for_blocks(sides, thread_count(threads, sides), BlockBody(body));
}

template <typename S, typename Index>
void close_rings(const NetViews<S>& views, EdgeRings<Index>& rings, RingTable<Index>& table) {
  const std::size_t sides = rings.next.size();
  const std::size_t mask = table.slot.size() - 1;
  constexpr std::size_t kAhead = 16; // slots lie anywhere in a table that no near cache holds
  for (std::size_t side = 0; side < sides; ++side) {
    __builtin_prefetch(&table.slot[table.hash[std::min(side + kAhead, sides - 1)] & mask]);
    if (rings.is_point(side)) {
      continue;
    }
    std::size_t at = table.hash[side] & mask;
    for (;; at = (at + 1) & mask) {
      const Index latest = table.slot[at];
      if (latest == RingTable<Index>::kNone) {
        break;
      }
      if (table.hash[latest] == table.hash[side] &&
          edge_of(views, latest) == edge_of(views, side)) {
        rings.next[side] = rings.next[latest];
        rings.next[latest] = static_cast<Index>(side);
        break;
      }
    }
    table.slot[at] = static_cast<Index>(side);
  }
}

} // namespace

template <typename S, typename Index>
EdgeRings<Index> find_rings(std::span<const ControlNets<S>> sets, int threads) {
  const NetViews<S> views(sets);
  const std::size_t sides = kPatchEdges * views.patches();
  EdgeRings<Index> rings;
  if (sides > 0) {
    rings.next.resize(sides);
    rings.turned.resize(sides);
    RingTable<Index> table(sides);
    hash_edges(views, rings, table, threads);
    close_rings(views, rings, table);
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
