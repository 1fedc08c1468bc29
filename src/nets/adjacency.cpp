#include <simdbezier/topology.hpp>

#include <new>

#include "src/nets/edge_rings.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {
namespace {

EdgeLink link_of(const EdgeRings& rings, std::size_t side) noexcept {
  if (rings.is_point(side)) {
    return {EdgeKind::collapsed};
  }
  if (rings.is_alone(side)) {
    return {EdgeKind::boundary};
  }
  const std::size_t other = rings.next[side];
  return {rings.next[other] == side ? EdgeKind::shared : EdgeKind::non_manifold,
          static_cast<PatchEdge>(other % kPatchEdges), rings.turned[side] != rings.turned[other],
          other / kPatchEdges};
}

constexpr std::size_t kMostPatches = std::size_t{1} << 30; ///< sides have 32 bits

template <typename S>
Status check(std::span<const ControlNets<S>> nets, const Values<EdgeLink>& edges) noexcept {
  if (const Status status = check_views(nets); !status) {
    return status;
  }
  const std::size_t patches = patches_of(nets);
  if (patches >= kMostPatches) {
    return Status::size_overflow;
  }
  const std::size_t sides = kPatchEdges * patches;
  if (sides > edges.capacity) {
    return Status::output_too_small;
  }
  if (sides > 0 && edges.first == nullptr) {
    return Status::null_output;
  }
  const MemoryRange written(edges.first, sides * sizeof(EdgeLink));
  for (const ControlNets<S>& view : nets) {
    if (const Status status = check_apart(view, written); !status) {
      return status;
    }
  }
  return Status::ok;
}

} // namespace
} // namespace detail

template <typename S>
Status find_adjacency(std::span<const ControlNets<S>> nets, Values<EdgeLink> edges,
                      const RunOptions& options) noexcept try {
  if (const Status status = detail::check(nets, edges); !status) {
    return status;
  }
  const detail::DefaultFpEnvironment environment;
  const std::span links(edges.first, kPatchEdges * detail::patches_of(nets));
  const detail::EdgeRings rings = detail::find_rings<S>(nets, options.threads);
  auto body = [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t side = begin; side < end; ++side) {
      links[side] = detail::link_of(rings, side);
    }
  };
  detail::divide_work(links.size(), 5, options.threads, body);
  return Status::ok;
} catch (const std::bad_alloc&) {
  return Status::out_of_memory;
}

template SIMDBEZIER_API Status find_adjacency(std::span<const ControlNets<float>>, Values<EdgeLink>,
                                              const RunOptions&) noexcept;
template SIMDBEZIER_API Status find_adjacency(std::span<const ControlNets<double>>,
                                              Values<EdgeLink>, const RunOptions&) noexcept;

} // namespace simdbezier
