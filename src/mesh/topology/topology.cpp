#include <simdbezier/topology.hpp>

#include <algorithm>
#include <new>
#include <utility>

#include "src/calls/call.hpp"
#include "src/mesh/topology/corner_joiner.hpp"
#include "src/mesh/topology/edge_numbers.hpp"
#include "src/mesh/topology/fit.hpp"
#include "src/mesh/topology/marks.hpp"
#include "src/mesh/topology/net_corners.hpp"
#include "src/mesh/topology/snapping.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/nets/edge_rings.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Collapsed sides beyond those that are points exactly, with all that share their edges: those as
/// short as point_size or `snap`. Open ones would match their neighbours either way round, so that
/// any pairs of them, around a pole for example, would be joined.
template <typename S>
void collapse_short_sides(const NetCorners<S>& nets, double size, EdgeRings& rings) {
  for (std::size_t side = 0; size > 0 && side < rings.next.size(); ++side) {
    if (!rings.is_point(side) && nets.side_within(side, size)) {
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
Status build(std::span<const ControlNets<S>> nets, const TopologyOptions& options, int threads,
             TopologyData& topology) {
  topology.flags.assign(patches_of(nets), 0);
  topology.counts.patches = topology.patches();
  topology.snap = options.snap;
  topology.point_size = std::max(options.point_size, options.snap);
  const NetCorners<S> corners(nets);
  {
    auto rings = find_rings<S>(nets, threads);
    collapse_short_sides(corners, topology.point_size, rings);
    if (options.snap > 0) {
      topology.counts.snapped_sides = snap_sides(corners, options.snap, rings);
    }
    const Shares shares(patches_of(nets), 15, threads);
    EdgeNumbers(rings, shares, topology).run();
    CornerJoiner(shares, topology).run();
  }
  if (topology.point_size > 0 || has_rounded_points(corners, topology)) {
    topology.displacement = find_displacements(corners, topology);
  }
  const std::vector<std::uint32_t> candidates = entanglement_candidates(topology, threads);
  mark_repeated(corners, candidates, topology);
  mark_entangled(candidates, topology);
  const FreshVector<std::uint8_t> doubts = corners.doubts(threads);
  mark_corners(corners, doubts, candidates, topology);
  mark_loops(corners, doubts, topology);
  const Status oriented = orient(options, threads, topology);
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
  return check_model(nets);
}

} // namespace
} // namespace detail

template <typename S>
Status find_topology(std::span<const ControlNets<S>> nets, Topology& topology,
                     const TopologyOptions& options, const RunOptions& run) noexcept try {
  const detail::DefaultFpEnvironment environment;
  if (const Status status = detail::check(nets, options); !status) {
    return status;
  }
  auto data = std::make_shared<detail::TopologyData>();
  const Status built = detail::build(nets, options, run.threads, *data);
  if (built == Status::ok) {
    topology = Topology(std::move(data));
  }
  return built;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

template SIMDBEZIER_API Status find_topology(std::span<const ControlNets<float>>, Topology&,
                                             const TopologyOptions&, const RunOptions&) noexcept;
template SIMDBEZIER_API Status find_topology(std::span<const ControlNets<double>>, Topology&,
                                             const TopologyOptions&, const RunOptions&) noexcept;

template <typename S>
Status find_distinct_nets(std::span<const ControlNets<S>> nets, const Topology& topology,
                          DistinctNets<S>& distinct) noexcept try {
  std::size_t patches = 0;
  if (const Status status = detail::count_patches(nets, patches); !status) {
    return status;
  }
  if (patches != topology.counts().patches) {
    return Status::unequal_lengths;
  }
  DistinctNets<S> found;
  std::uint32_t number = 0;
  for (const ControlNets<S>& view : nets) {
    bool open = false;
    for (std::size_t patch = 0; patch < view.count; ++patch, ++number) {
      if (topology.is_repeated(number)) {
        open = false;
        continue;
      }
      if (!open) {
        ControlNets<S>& part = found.nets.emplace_back(view);
        part.points += static_cast<std::ptrdiff_t>(patch) * view.patch_stride;
        part.count = 0;
        open = true;
      }
      ++found.nets.back().count;
      found.patches.push_back(number);
    }
  }
  distinct = std::move(found);
  return Status::ok;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

SIMDBEZIER_EXPORT_BOTH_TYPES(find_distinct_nets);

TopologyCounts Topology::counts() const noexcept {
  return data_ == nullptr ? TopologyCounts{} : data_->counts;
}

TopologyCounts Topology::counts(SetRange patches) const noexcept {
  TopologyCounts counts;
  std::size_t first = 0;
  if (data_ == nullptr ||
      !detail::resolve_range(patches, data_->patches(), first, counts.patches)) {
    return {};
  }
  counts.snapped_sides = data_->counts.snapped_sides;
  counts.orientable = data_->counts.orientable;
  for (std::size_t p = first; p < first + counts.patches; ++p) {
    counts.repeated_patches += data_->is_repeated(p) ? 1 : 0;
    for (std::size_t side = kPatchEdges * p; side < kPatchEdges * (p + 1); ++side) {
      counts.collapsed_sides += data_->sides[side].collapsed() ? 1 : 0;
    }
    data_->for_owned_corners(p, [&](std::uint32_t) { ++counts.corners; });
    data_->for_owned_edges(p, [&](std::uint32_t edge) {
      const auto sides = data_->sides_of(edge);
      ++counts.edges;
      counts.open_edges += sides.size() == 1 ? 1 : 0;
      counts.non_manifold_edges += sides.size() > 2 ? 1 : 0;
      // As the patches are given, whichever have been turned.
      const auto given = [&](std::uint32_t side) { return data_->is_turned(side / kPatchEdges); };
      counts.turned_edges += sides.size() == 2 && data_->disagree(sides[0], sides[1]) !=
                                                      (given(sides[0]) != given(sides[1]))
                                 ? 1
                                 : 0;
    });
  }
  return counts;
}

bool Topology::is_turned(std::size_t patch) const noexcept {
  return data_ != nullptr && patch < data_->patches() && data_->is_turned(patch);
}

bool Topology::is_repeated(std::size_t patch) const noexcept {
  return data_ != nullptr && patch < data_->patches() && data_->is_repeated(patch);
}

bool Topology::is_entangled(std::size_t patch) const noexcept {
  return data_ != nullptr && patch < data_->patches() &&
         (data_->flags[patch] & detail::kEntangled) != 0;
}

} // namespace simdbezier
