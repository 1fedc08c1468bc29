// See adjacency.hpp. Every edge is reduced to a direction that both of its sides agree on, then
// hashed; edges of one hash are compared value by value.
#include <simdbezier/adjacency.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <new>
#include <type_traits>
#include <vector>

#include "src/nets/net_call.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
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

/// All edges of all views, numbered 4 * patch + edge.
template <typename S>
class EdgeSoup {
public:
  explicit EdgeSoup(std::span<const ControlNets<S>> sets) : sets_(sets) {
    starts_.reserve(sets.size() + 1);
    starts_.push_back(0);
    for (const ControlNets<S>& nets : sets) {
      starts_.push_back(starts_.back() + nets.count);
    }
  }
  [[nodiscard]] std::size_t size() const noexcept { return kPatchEdges * starts_.back(); }
  [[nodiscard]] EdgeValues<S> edge(std::size_t number) const noexcept {
    const std::size_t patch = number / kPatchEdges;
    std::size_t low = 0; // the last view that starts at or before the patch and is not empty
    std::size_t high = sets_.size();
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (starts_[middle] <= patch ? low : high) = middle;
    }
    return {sets_[low], patch - starts_[low], static_cast<PatchEdge>(number % kPatchEdges)};
  }

private:
  std::span<const ControlNets<S>> sets_;
  std::vector<std::size_t> starts_; ///< first patch of each view, then the number of all
};

constexpr std::size_t kNoEdge = std::numeric_limits<std::size_t>::max();

/// Edges of equal values form a ring in the order of their numbers.
struct EdgeRings {
  std::vector<std::uint64_t> hash;
  std::vector<std::uint8_t> turned;
  std::vector<std::size_t> next;  ///< in the ring; kNoEdge for collapsed edges
  std::vector<std::size_t> table; ///< open addressing: the latest edge of each ring, or kNoEdge
};

template <typename S>
void hash_edges(const EdgeSoup<S>& soup, EdgeRings& rings, int threads) noexcept {
  auto body = [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t number = begin; number < end; ++number) {
      const EdgeValues<S> edge = soup.edge(number);
      rings.hash[number] = edge.hash();
      rings.turned[number] = edge.turned() ? 1 : 0;
      rings.next[number] = edge.collapsed() ? kNoEdge : number;
    }
  };
  for_blocks(soup.size(), thread_count(threads, soup.size()), BlockBody(body));
}

template <typename S>
void close_rings(const EdgeSoup<S>& soup, EdgeRings& rings) noexcept {
  const std::size_t mask = rings.table.size() - 1;
  constexpr std::size_t kAhead = 16; // slots lie anywhere in a table that no near cache holds
  for (std::size_t number = 0; number < soup.size(); ++number) {
    __builtin_prefetch(&rings.table[rings.hash[std::min(number + kAhead, soup.size() - 1)] & mask]);
    if (rings.next[number] == kNoEdge) {
      continue;
    }
    std::size_t slot = rings.hash[number] & mask;
    for (;; slot = (slot + 1) & mask) {
      const std::size_t latest = rings.table[slot];
      if (latest == kNoEdge) {
        break;
      }
      if (rings.hash[latest] == rings.hash[number] && soup.edge(latest) == soup.edge(number)) {
        rings.next[number] = rings.next[latest];
        rings.next[latest] = number;
        break;
      }
    }
    rings.table[slot] = number;
  }
}

EdgeLink link_of(const EdgeRings& rings, std::size_t number) noexcept {
  const std::size_t other = rings.next[number];
  if (other == kNoEdge) {
    return {EdgeKind::collapsed};
  }
  if (other == number) {
    return {EdgeKind::boundary};
  }
  return {rings.next[other] == number ? EdgeKind::shared : EdgeKind::non_manifold,
          static_cast<PatchEdge>(other % kPatchEdges), rings.turned[number] != rings.turned[other],
          other / kPatchEdges};
}

template <typename S>
Status check_sets(std::span<const ControlNets<S>> sets, const Values<EdgeLink>& edges) noexcept {
  if (sets.data() == nullptr && !sets.empty()) {
    return Status::null_input;
  }
  std::size_t patches = 0;
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / 512;
  for (const ControlNets<S>& nets : sets) {
    if (const Status status = check_input(nets); !status) {
      return status;
    }
    if (nets.count > kMost - patches) {
      return Status::size_overflow;
    }
    patches += nets.count;
  }
  if (patches * kPatchEdges > edges.capacity) {
    return Status::output_too_small;
  }
  if (patches > 0 && edges.first == nullptr) {
    return Status::null_output;
  }
  const MemoryRange written(edges.first, patches * kPatchEdges * sizeof(EdgeLink));
  for (const ControlNets<S>& nets : sets) {
    if (const Status status = check_apart(nets, written); !status) {
      return status;
    }
  }
  return Status::ok;
}

} // namespace
} // namespace detail

template <typename S>
Status find_adjacency(std::span<const ControlNets<S>> sets, Values<EdgeLink> edges,
                      const Options& options) noexcept try {
  const Status status = detail::check_sets(sets, edges);
  if (status != Status::ok) {
    return status;
  }
  const detail::DefaultFpEnvironment environment;
  const detail::EdgeSoup<S> soup(sets);
  if (soup.size() == 0) {
    return Status::ok;
  }
  detail::EdgeRings rings;
  rings.hash.resize(soup.size());
  rings.turned.resize(soup.size());
  rings.next.resize(soup.size());
  rings.table.assign(std::bit_ceil(soup.size() + soup.size() / 2), detail::kNoEdge);
  detail::hash_edges(soup, rings, options.threads);
  detail::close_rings(soup, rings);
  auto body = [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t number = begin; number < end; ++number) {
      edges.first[number] = detail::link_of(rings, number);
    }
  };
  detail::for_blocks(soup.size(), detail::thread_count(options.threads, soup.size()),
                     detail::BlockBody(body));
  return Status::ok;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

template SIMDBEZIER_API Status find_adjacency(std::span<const ControlNets<float>>, Values<EdgeLink>,
                                              const Options&) noexcept;
template SIMDBEZIER_API Status find_adjacency(std::span<const ControlNets<double>>,
                                              Values<EdgeLink>, const Options&) noexcept;

} // namespace simdbezier
