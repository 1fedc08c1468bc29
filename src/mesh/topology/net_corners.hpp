// What a topology needs to know of control points beyond which edges are equal.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/control_nets.hpp>

#include "src/mesh/net_points.hpp"
#include "src/mesh/topology/quick_look.hpp"
#include "src/mesh/topology/side_curve.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/nets/net_views.hpp"
#include "src/runtime/fresh_vector.hpp"

namespace simdbezier::detail {

/// The control points of all views in space, with patches numbered consecutively.
template <typename S>
class NetCorners {
public:
  explicit NetCorners(std::span<const ControlNets<S>> nets) : views_(nets) {}

  void read_side(std::size_t side, SideNet& to) const;
  /// The control point of corner 4 * patch + corner.
  [[nodiscard]] Point3 corner_point(std::size_t corner) const noexcept;

  [[nodiscard]] bool is_homogeneous(std::size_t patch) const noexcept {
    return views_.place(patch).nets->weights == Weights::homogeneous;
  }

  /// Whether all control points of a side lie within a distance of both of its ends.
  [[nodiscard]] bool side_within(std::size_t side, double distance) const;

  /// The CornerDoubt flags of each patch.
  [[nodiscard]] FreshVector<std::uint8_t> doubts(int threads) const;

  /// Whether both ends of a side are in one place.
  [[nodiscard]] bool ends_meet(std::size_t side) const noexcept;

  /// Whether both sides at a corner leave it in one direction, so that the triangle of its cell has
  /// almost no area however small cells are.
  [[nodiscard]] bool sides_leave_together(std::size_t patch, std::size_t corner) const noexcept;

  /// The first of a patch's control points by x, y and z.
  [[nodiscard]] std::array<double, 3> lowest_point(std::size_t patch) const noexcept;

  /// Whether two patches have the same control points, whichever way round.
  [[nodiscard]] bool same(std::size_t a, std::size_t b) const noexcept;

private:
  NetViews<S> views_;
};

/// Marks patches that repeat an earlier one. candidates: as of entanglement_candidates().
template <typename S>
void mark_repeated(const NetCorners<S>& nets, std::span<const std::uint32_t> candidates,
                   TopologyData& topology);

} // namespace simdbezier::detail
