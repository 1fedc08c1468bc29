// See topology.hpp.
#include <simdbezier/topology.hpp>

#include <algorithm>
#include <new>
#include <numeric>

#include "src/mesh/topology/entanglement.hpp"
#include "src/mesh/topology/forced_diagonals.hpp"
#include "src/mesh/topology/net_corners.hpp"
#include "src/mesh/topology/orientation.hpp"
#include "src/mesh/topology/snapping.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/nets/edge_rings.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

constexpr std::size_t kMostPatches = std::size_t{1} << 29;

/// Numbers edges in the order of their first sides, and tells every side which way it runs.
void number_edges(const EdgeRings<std::uint32_t>& rings, TopologyData& topology) {
  const std::size_t sides = rings.next.size();
  auto& first = topology.first;
  std::size_t edges = 0;
  for (std::size_t side = 0; side < sides; ++side) {
    edges += rings.next[side] <= side ? 1 : 0; // the last side of a ring leads back to its first
  }
  // Every side hands its edge's number on to the next one of its ring, the last one to nobody,
  // behind all sides: which sides these are follows no rule, so that branches would take longer.
  topology.sides.resize(sides + 1);
  first.assign(edges + 2, 0); // [edge + 2]: how many sides it has
  std::uint32_t numbered = 0;
  for (std::size_t side = 0; side < sides; ++side) {
    if (rings.is_point(side)) {
      ++topology.counts.collapsed_sides;
      continue;
    }
    const bool is_first = topology.sides[side].collapsed(); // no earlier side has numbered it
    const Side own = is_first ? Side(numbered, false) : topology.sides[side];
    numbered += is_first ? 1 : 0;
    topology.sides[side] = own;
    ++first[own.edge() + 2];
    const std::uint32_t next = rings.next[side];
    const bool turns = rings.turned[side] != rings.turned[next];
    topology.sides[next > side ? next : sides] = Side(own.edge(), own.reversed() != turns);
  }
  topology.sides.pop_back();
  std::partial_sum(first.begin(), first.end(), first.begin());
  topology.members.resize(sides - topology.counts.collapsed_sides);
  for (std::size_t side = 0; side < sides; ++side) {
    if (!topology.sides[side].collapsed()) {
      topology.members[first[topology.sides[side].edge() + 1]++] = static_cast<std::uint32_t>(side);
    }
  }
  first.pop_back();
}

/// Sets of corners that are one, each named by its lowest member.
class JoinedCorners {
public:
  explicit JoinedCorners(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  /// Rem's algorithm: climbs from both at once, on the side that is higher, and hangs what it
  /// leaves there below the other.
  void join(std::uint32_t a, std::uint32_t b) noexcept {
    while (parent_[a] != parent_[b]) {
      if (parent_[a] < parent_[b]) {
        std::swap(a, b);
      }
      const std::uint32_t above = parent_[a];
      parent_[a] = parent_[b];
      if (above == a) {
        return;
      }
      a = above;
    }
  }
  [[nodiscard]] std::vector<std::uint32_t> finish() && {
    for (std::uint32_t& parent : parent_) { // is lower, and has its lowest member already
      parent = parent_[parent];
    }
    return std::move(parent_);
  }

private:
  std::vector<std::uint32_t> parent_; ///< a corner's own number, or that of a lower one
};

void join_corners(TopologyData& topology) {
  JoinedCorners corners(topology.sides.size());
  for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
    const auto sides = topology.sides_of(edge);
    for (const std::uint32_t side : sides.subspan(1)) {
      const std::size_t begin = topology.sides[side].reversed() ? 1 : 0;
      corners.join(corner_at(side, begin), corner_at(sides[0], 0));
      corners.join(corner_at(side, 1 - begin), corner_at(sides[0], 1));
    }
  }
  for (std::size_t side = 0; topology.counts.collapsed_sides > 0 && side < topology.sides.size();
       ++side) {
    if (topology.sides[side].collapsed()) {
      corners.join(corner_at(side, 0), corner_at(side, 1));
    }
  }
  topology.corners = std::move(corners).finish();
  // Goes from the last corner to the first, so that the lowest one always leads to the latest.
  topology.next_corner = topology.corners;
  for (std::size_t k = topology.corners.size(); k-- > 0;) {
    const std::uint32_t lowest = topology.corners[k];
    std::uint32_t& latest = topology.next_corner[lowest];
    topology.next_corner[k] = latest;
    latest = lowest == k ? latest : static_cast<std::uint32_t>(k);
    topology.counts.corners += lowest == k ? 1 : 0;
  }
}

void count_edges(TopologyData& topology) {
  topology.counts.patches = topology.patches();
  topology.counts.edges = topology.edges();
  for (std::size_t edge = 0; edge < topology.edges(); ++edge) {
    const std::size_t sides = topology.sides_of(edge).size();
    topology.counts.open_edges += sides == 1 ? 1 : 0;
    topology.counts.non_manifold_edges += sides > 2 ? 1 : 0;
  }
}

/// Collapsed sides beyond those that are points exactly.
template <typename S>
void collapse_short_sides(const NetCorners<S>& nets, double point_size,
                          EdgeRings<std::uint32_t>& rings) {
  if (point_size == 0) {
    return;
  }
  for (std::size_t side = 0; side < rings.next.size(); ++side) {
    if (!rings.is_point(side) && nets.side_within(side, point_size)) {
      rings.make_point(side);
    }
  }
}

/// Whether a side may be a point only because of a rounded division: control points in space are
/// quotients there, which find_adjacency() compares in the type of the values.
template <typename S>
bool has_rounded_points(const NetCorners<S>& nets, const TopologyData& topology) {
  if (topology.counts.collapsed_sides == 0) {
    return false;
  }
  for (std::size_t side = 0; side < topology.sides.size(); ++side) {
    if (topology.sides[side].collapsed() && nets.is_homogeneous(side / kPatchEdges)) {
      return true;
    }
  }
  return false;
}

template <typename S>
Status build(std::span<const ControlNets<S>> nets, const TopologyOptions& options,
             TopologyData& topology) {
  topology.flags.assign(patches_of(nets), 0);
  const NetCorners<S> corners(nets);
  {
    auto rings = find_rings<S, std::uint32_t>(nets, options.threads);
    collapse_short_sides(corners, options.point_size, rings);
    if (options.snap > 0) {
      topology.counts.snapped_sides = snap_sides(corners, options.snap, rings);
    }
    number_edges(rings, topology);
  }
  join_corners(topology);
  count_edges(topology);
  if (options.snap > 0 || options.point_size > 0 || has_rounded_points(corners, topology)) {
    find_displacements(corners, topology);
  }
  const std::vector<std::uint32_t> candidates = entanglement_candidates(topology);
  mark_repeated(corners, candidates, topology);
  mark_entangled(candidates, topology);
  const std::vector<std::uint8_t> doubts = corners.doubts();
  mark_corners(corners, doubts, candidates, topology);
  mark_loops(corners, doubts, topology);
  const Status oriented = orient(options, topology);
  if (oriented == Status::ok && topology.counts.turned_edges > 0) {
    mark_apart(topology);
  }
  return oriented;
}

template <typename S>
Status check(std::span<const ControlNets<S>> nets, const TopologyOptions& options) noexcept {
  if (!(options.point_size >= 0) || !(options.snap >= 0)) {
    return Status::bad_tolerance;
  }
  std::size_t patches = 0;
  for (const ControlNets<S>& view : nets) {
    if (view.components != 3) {
      return Status::bad_components;
    }
    if (view.count >= kMostPatches - patches) {
      return Status::size_overflow;
    }
    patches += view.count;
  }
  return check_views(nets);
}

} // namespace
} // namespace detail

template <typename S>
Status find_topology(std::span<const ControlNets<S>> nets, Topology& topology,
                     const TopologyOptions& options) noexcept try {
  const detail::DefaultFpEnvironment environment;
  const Status status = detail::check(nets, options);
  if (status != Status::ok) {
    return status;
  }
  auto data = std::make_shared<detail::TopologyData>();
  const Status built = detail::build(nets, options, *data);
  if (built == Status::ok) {
    topology = Topology(std::move(data));
  }
  return built;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

template SIMDBEZIER_API Status find_topology(std::span<const ControlNets<float>>, Topology&,
                                             const TopologyOptions&) noexcept;
template SIMDBEZIER_API Status find_topology(std::span<const ControlNets<double>>, Topology&,
                                             const TopologyOptions&) noexcept;

TopologyCounts Topology::counts() const noexcept {
  return data_ == nullptr ? TopologyCounts{} : data_->counts;
}

bool Topology::is_turned(std::size_t patch) const noexcept {
  return data_ != nullptr && patch < data_->patches() &&
         (data_->flags[patch] & detail::kTurned) != 0;
}

bool Topology::is_repeated(std::size_t patch) const noexcept {
  return data_ != nullptr && patch < data_->patches() && data_->is_repeated(patch);
}

} // namespace simdbezier
