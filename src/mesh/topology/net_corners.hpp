// What a topology needs to know of control points beyond which edges are equal.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/control_nets.hpp>

#include "src/mesh/net_points.hpp"
#include "src/mesh/topology/side_curve.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/nets/edge_values.hpp"
#include "src/nets/net_views.hpp"
#include "src/runtime/fresh_vector.hpp"

namespace simdbezier::detail {

/// What may be true: kMayLeaveTogether << corner of both sides there, kEndsMayMeet << PatchEdge of
/// the ends of a side.
enum CornerDoubt : std::uint8_t { kMayLeaveTogether = 1, kEndsMayMeet = 16 };

/// Looks at the corners of the patches of a view: nearly always, the next control points on both
/// sides of a corner certainly lie in different directions, and the ends of a side in different
/// places. kDivided: whether points are homogeneous.
template <typename S, bool kDivided>
class QuickLook {
public:
  explicit QuickLook(const ControlNets<S>& nets) : component_stride_(nets.component_stride) {
    for (std::size_t k = 0; k < kPatchCorners; ++k) {
      const bool at_u1 = k % 2 != 0;
      const bool at_v1 = k >= 2;
      corner_[k] = (at_u1 ? nets.degree_u * nets.point_stride : 0) +
                   (at_v1 ? nets.degree_v * nets.row_stride : 0);
      next_u_[k] = corner_[k] + (at_u1 ? -nets.point_stride : nets.point_stride);
      next_v_[k] = corner_[k] + (at_v1 ? -nets.row_stride : nets.row_stride);
    }
  }

  [[nodiscard]] std::uint8_t doubts(const S* net) const {
    unsigned doubts = 0;
    for (std::size_t k = 0; k < kPatchCorners; k += kLanes) {
      const auto together = may_leave_together(net, k);
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        doubts |= static_cast<unsigned>(together[lane]) & unsigned{kMayLeaveTogether} << (k + lane);
      }
    }
    for (std::size_t k = 0; k < kPatchEdges; ++k) {
      doubts |= ends_may_meet(net, k) ? unsigned{kEndsMayMeet} << k : 0;
    }
    return static_cast<std::uint8_t>(doubts);
  }

private:
  /// A value for each of as many corners as fit the smallest register that there is.
  typedef S Lanes __attribute__((vector_size(16)));
  static constexpr std::size_t kLanes = 16 / sizeof(S);

  static Lanes gather(const S* values, const std::ptrdiff_t* at) {
    if constexpr (kLanes == 4) {
      return Lanes{values[at[0]], values[at[1]], values[at[2]], values[at[3]]};
    } else {
      return Lanes{values[at[0]], values[at[1]]};
    }
  }

  /// All bits of a lane where its corner is in doubt.
  [[nodiscard]] auto may_leave_together(const S* net, std::size_t first) const {
    Lanes square_u = {};
    Lanes square_v = {};
    Lanes product = {};
    Lanes least = Lanes{} + S(0x1p-60);
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      const Lanes corner = points(net, c, corner_ + first);
      const Lanes u = points(net, c, next_u_ + first) - corner;
      const Lanes v = points(net, c, next_v_ + first) - corner;
      square_u += u * u;
      square_v += v * v;
      product += u * v;
      if constexpr (kDivided) { // then roundings turn a difference by a thousandth at most
        least += corner * corner * (sizeof(S) == sizeof(float) ? S(0x1p-22) : S(0x1p-80));
      }
    }
    // Elsewhere products may vanish or overflow; differences are rounded once, wherever points are.
    const auto is_usual =
        (square_u > least) & (square_u < S(0x1p60)) & (square_v > least) & (square_v < S(0x1p60));
    const auto part = (product <= 0) | (product * product < S(0.98) * square_u * square_v);
    return ~(is_usual & part);
  }

  /// Coordinate c of the points at some places.
  Lanes points(const S* net, std::ptrdiff_t c, const std::ptrdiff_t* at) const {
    const Lanes values = gather(net + c * component_stride_, at);
    return kDivided ? values / gather(net + 3 * component_stride_, at) : values;
  }

  /// Whether the coordinates of both ends are the same but for their signs, or may be one point.
  [[nodiscard]] bool ends_may_meet(const S* net, std::size_t side) const {
    if constexpr (kDivided) {
      const auto value = [&](std::size_t end, std::size_t c) {
        return static_cast<double>(net[corner_[kSideCorners[side][end]] +
                                       static_cast<std::ptrdiff_t>(c) * component_stride_]);
      };
      return !are_surely_apart(value, 0, 1, 3,
                               one_point_tolerance(Weights::homogeneous, sizeof(S) == 8));
    }
    BitsOf<S> difference = 0;
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      const S* const values = net + c * component_stride_;
      difference |= std::bit_cast<BitsOf<S>>(values[corner_[kSideCorners[side][0]]]) ^
                    std::bit_cast<BitsOf<S>>(values[corner_[kSideCorners[side][1]]]);
    }
    return difference << 1 == 0;
  }

  std::ptrdiff_t component_stride_;
  std::ptrdiff_t corner_[kPatchCorners]; ///< from the first value of the patch
  std::ptrdiff_t next_u_[kPatchCorners]; ///< the next point in u, or v
  std::ptrdiff_t next_v_[kPatchCorners];
};

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
