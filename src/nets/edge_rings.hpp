// Finds which sides of patches are equal, as rings of side numbers: what find_adjacency() reports
// and topologies are built from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <simdbezier/control_nets.hpp>

#include "src/runtime/fresh_vector.hpp"

namespace simdbezier::detail {

/// The sides of all patches of all views, numbered 4 * patch + PatchEdge, those of equal values
/// linked in ascending order, and the last one with the first. Numbers of 32 bits are half the
/// memory of larger ones. Most of it is touched once, so that its pages cost more than what is done
/// with them.
struct EdgeRings {
  static constexpr std::uint32_t kPoint = std::numeric_limits<std::uint32_t>::max();

  FreshVector<std::uint32_t> next; ///< kPoint: all points of the side are equal
  /// Whether a side runs against the direction on which all of its ring agree.
  FreshVector<std::uint8_t> turned;

  [[nodiscard]] bool is_point(std::size_t side) const noexcept { return next[side] == kPoint; }
  [[nodiscard]] bool is_alone(std::size_t side) const noexcept { return next[side] == side; }
  /// Puts a side that is alone behind the last one of a ring, or behind itself: nothing changes.
  void link(std::uint32_t last, std::uint32_t side) noexcept {
    const std::uint32_t first = next[last];
    next[last] = side;
    next[side] = first;
  }
  /// Takes a side's ring apart: all of its sides count as points.
  void make_point(std::size_t side) noexcept {
    while (!is_point(side)) {
      const std::size_t other = next[side];
      next[side] = kPoint;
      side = other;
    }
  }
};

/// Throws bad_alloc. The views are sound, and their sides fewer than EdgeRings::kPoint.
template <typename S>
EdgeRings find_rings(std::span<const ControlNets<S>> nets, int threads);

} // namespace simdbezier::detail
