// See fit.hpp, and fits() in topology.hpp.
#include "src/mesh/topology/fit.hpp"

#include <algorithm>

#include <simdbezier/topology.hpp>

#include "src/mesh/topology/snapping.hpp"
#include "src/nets/edge_values.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {
namespace detail {

/// Of the sides of each patch. Not in an anonymous namespace, because a lambda of a function with
/// external linkage captures it.
template <typename S>
class TopologyFit {
public:
  TopologyFit(const TopologyData& topology, std::span<const ControlNets<S>> nets)
      : topology_(topology), edges_(nets), corners_(nets) {}

  /// Whether a patch's sides are joined.
  [[nodiscard]] bool holds(std::size_t patch) const {
    bool joined = true;
    for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
      joined = joined && is_joined(side);
    }
    return joined || are_near(patch);
  }

private:
  [[nodiscard]] bool is_joined(std::size_t side) const {
    const Side& own = topology_.sides[side];
    if (own.collapsed()) {
      return edges_[side].collapsed();
    }
    const std::size_t first = topology_.sides_of(own.edge())[0];
    return first == side || edges_[side].turned(own.reversed()) == edges_[first];
  }
  /// Whether sides that were snapped, or were short enough to be points, still are.
  [[nodiscard]] bool are_near(std::size_t patch) const {
    bool near = topology_.point_size > 0;
    for (std::size_t side = kPatchEdges * patch; side < kPatchEdges * (patch + 1); ++side) {
      near = near && (is_joined(side) || is_near(side));
    }
    return near;
  }
  [[nodiscard]] bool is_near(std::size_t side) const {
    constexpr double kMoved = 1 + 0x1p-10; // a model that moves as a whole rounds its points anew
    const bool point = topology_.sides[side].collapsed();
    if (point && corners_.side_within(side, kMoved * topology_.point_size)) {
      return true;
    }
    // An open side that matched a point may have been longer than those that are points anyway.
    const double most = point ? topology_.displacement_of(side / kPatchEdges) : topology_.snap;
    return topology_.snap > 0 && distance_from_joint(corners_, topology_, side) <= kMoved * most;
  }

  const TopologyData& topology_;
  AllEdges<S> edges_;
  NetCorners<S> corners_;
};

template <typename S>
Status check_model(std::span<const ControlNets<S>> nets) noexcept {
  constexpr std::size_t kMostPatches = std::size_t{1} << 29;
  if (is_missing(nets)) {
    return Status::null_input;
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

SIMDBEZIER_OF_BOTH_TYPES(check_model);

template <typename S>
std::size_t first_misfit(const TopologyData& topology, std::span<const ControlNets<S>> nets,
                         int threads) {
  const TopologyFit<S> fit(topology, nets);
  return first_failure(topology.patches(), 40, threads,
                       [&](std::size_t patch) { return fit.holds(patch); });
}

SIMDBEZIER_OF_BOTH_TYPES(first_misfit);

} // namespace detail

template <typename S>
bool fits(const Topology& topology, std::span<const ControlNets<S>> nets,
          const RunOptions& options) noexcept try {
  const detail::DefaultFpEnvironment environment;
  if (!detail::check_model(nets)) {
    return false;
  }
  const std::size_t patches = detail::patches_of(nets);
  return topology.counts().patches == patches &&
         (patches == 0 || detail::first_misfit(*topology.data(), nets, options.threads) == patches);
} catch (const std::bad_alloc&) {
  return false;
}

template SIMDBEZIER_API bool fits(const Topology&, std::span<const ControlNets<float>>,
                                  const RunOptions&) noexcept;
template SIMDBEZIER_API bool fits(const Topology&, std::span<const ControlNets<double>>,
                                  const RunOptions&) noexcept;

} // namespace simdbezier
