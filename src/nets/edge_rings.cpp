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

/// The values of one edge, from the end on at which the direction that both sides agree on begins.
template <typename S>
class EdgeValues {
public:
  using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;

  /// The values of an edge in its own direction.
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
  }

  /// The agreed direction has the smaller bits where both first differ. Whether that is against the
  /// edge's own: not where both give the same values.
  [[nodiscard]] bool runs_against() const noexcept {
    for (std::ptrdiff_t k = 0; k <= degree_ / 2; ++k) {
      for (std::ptrdiff_t c = 0; c < channels_; ++c) {
        const Bits forward = bits(k, c);
        const Bits backward = bits(degree_ - k, c);
        if (forward != backward) {
          return backward < forward;
        }
      }
    }
    return false;
  }
  /// The edge from its other end on, or as it is.
  [[nodiscard]] EdgeValues turned(bool turn) const noexcept {
    EdgeValues edge = *this;
    if (turn) {
      edge.first_ += degree_ * stride_;
      edge.stride_ = -stride_;
    }
    return edge;
  }

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
    return channels_ == 3 ? hash_of<3>() : hash_of<0>();
  }
  void prefetch() const noexcept {
    __builtin_prefetch(first_);
    __builtin_prefetch(first_ + degree_ * stride_);
  }

private:
  /// kChannels: how many there are, or 0 where that is known at run time only.
  template <std::ptrdiff_t kChannels>
  [[nodiscard]] std::uint64_t hash_of() const noexcept {
    constexpr std::uint64_t kFactors[4] = {0x9e3779b97f4a7c15ULL, 0xbf58476d1ce4e5b9ULL,
                                           0x94d049bb133111ebULL, 0xd6e8feb86659fd93ULL};
    const std::ptrdiff_t channels = kChannels > 0 ? kChannels : channels_;
    const auto mixed = [](std::uint64_t state) {
      state *= 0xff51afd7ed558ccdULL;
      return state ^ (state >> 33);
    };
    std::uint64_t state = static_cast<std::uint64_t>(degree_) * 64 +
                          static_cast<std::uint64_t>(channels) * 4 +
                          static_cast<std::uint64_t>(weights_);
    for (std::ptrdiff_t k = 0; k <= degree_; ++k) {
      for (std::ptrdiff_t first = 0; first < channels; first += 4) {
        std::uint64_t sum = 0;
        for (std::ptrdiff_t c = first; c < channels && c < first + 4; ++c) {
          sum += bits(k, c) * kFactors[c - first];
        }
        state = mixed(state ^ sum);
      }
    }
    state *= 0xc4ceb9fe1a85ec53ULL;
    return state ^ (state >> 33);
  }

  /// Value c of point k; -0 as +0.
  [[nodiscard]] Bits bits(std::ptrdiff_t k, std::ptrdiff_t c) const noexcept {
    const auto value = std::bit_cast<Bits>(first_[k * stride_ + c * component_stride_]);
    constexpr Bits kSign = Bits{1} << (8 * sizeof(Bits) - 1);
    return value == kSign ? 0 : value;
  }

  /// Whether point k has the coordinate of point 0.
  [[nodiscard]] bool same_coordinate(std::ptrdiff_t k, std::ptrdiff_t c) const noexcept {
    if (weights_ != Weights::homogeneous) {
      return bits(k, c) == bits(0, c);
    }
    const auto point = [&](std::ptrdiff_t i) {
      const S* const values = first_ + i * stride_;
      return values[c * component_stride_] / values[(channels_ - 1) * component_stride_];
    };
    return point(k) == point(0);
  }

  const S* first_;
  std::ptrdiff_t degree_;
  std::ptrdiff_t stride_;
  std::ptrdiff_t channels_;
  std::ptrdiff_t component_stride_;
  Weights weights_;
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
      const bool turned = edge.runs_against();
      table.hash[side] = static_cast<Index>(edge.turned(turned).hash());
      rings.turned[side] = turned ? 1 : 0;
      rings.next[side] = edge.collapsed() ? EdgeRings<Index>::kPoint : static_cast<Index>(side);
    }
  };
  const std::size_t sides = rings.next.size();
  divide_work(sides, 20, threads, body);
}

template <typename S, typename Index>
void close_rings(const NetViews<S>& views, EdgeRings<Index>& rings, RingTable<Index>& table) {
  const std::size_t sides = rings.next.size();
  const std::size_t mask = table.slot.size() - 1;
  const auto place = [&](std::size_t side) { return table.hash[side] & mask; };
  const auto agreed = [&](std::size_t side) {
    return edge_of(views, side).turned(rings.turned[side] != 0);
  };
  // Slots lie anywhere in a table that no near cache holds, and the edges that they name in memory.
  constexpr std::size_t kAhead = 16;
  for (std::size_t side = 0; side < sides; ++side) {
    __builtin_prefetch(&table.slot[place(std::min(side + kAhead, sides - 1))]);
    const Index soon = table.slot[place(std::min(side + kAhead / 2, sides - 1))];
    if (soon != RingTable<Index>::kNone) {
      edge_of(views, soon).prefetch();
    }
    if (rings.is_point(side)) {
      continue;
    }
    std::size_t at = place(side);
    for (;; at = (at + 1) & mask) {
      const Index latest = table.slot[at];
      if (latest == RingTable<Index>::kNone) {
        break;
      }
      if (table.hash[latest] == table.hash[side] && agreed(latest) == agreed(side)) {
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
EdgeRings<Index> find_rings(std::span<const ControlNets<S>> nets, int threads) {
  const NetViews<S> views(nets);
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
