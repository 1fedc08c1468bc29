// What the patches of a set have in common, and where their packed values lie.
//
// A direction of degree 6 or more is cut in two at its middle: every half is expanded around its
// own centre, which keeps the power basis as accurate as de Casteljau's algorithm up to degree 15.
// A patch thus consists of 1, 2 or 4 cells, and a cell is packed and evaluated like a patch of its
// own on half of the parameter range, edges and corners included. The edges between cells depend
// only on what both cells share, so that no seam can open.
#pragma once

#include <algorithm>
#include <cstddef>

#include <simdbezier/control_nets.hpp>

namespace simdbezier::detail {

/// The most coefficients in one direction, and the most values of a point, its weight included.
inline constexpr std::size_t kMostOrder = std::size_t{kMostDegree} + 1;
inline constexpr std::size_t kMostChannels = std::size_t{kMostComponents} + 1;

/// Above this degree a direction has two cells.
inline constexpr int kMostWholeDegree = 5;

/// Values of T in whole cache lines, for float and double alike.
constexpr std::size_t whole_blocks(std::size_t values) { return (values + 15) / 16 * 16; }

/// Layouts, all in elements:
///   coefficients    [patch][cell][channel][power k of X][power l of Y]
///   edges           [patch][cell]{ [channel][power][edge v=0, v=1, u=0, u=1], [channel][corner] }
///                   In place of corners the weight has two marks, for the cell's edges u=0 and
///                   u=1: 1 where the edge is a point and packed around its corner at v=0, 2 around
///                   that at v=1 (pack/collapsed_edges.hpp), else 0
///   origins         [patch][cell][channel][8], see kOriginBlock
///   given points    [patch][j][i][channel], see given_points.hpp
/// Cells: lower v first, then lower u. Channels: the components, then the weight. For bicubic
/// patches in space these are exactly the constants of bicubic_layout.hpp.
struct NetShape {
  int degree_u = 3;
  int degree_v = 3;
  int components = 3;
  bool rational = false;

  friend bool operator==(const NetShape&, const NetShape&) = default;

  [[nodiscard]] constexpr std::size_t order_u() const {
    return static_cast<std::size_t>(degree_u) + 1;
  }
  [[nodiscard]] constexpr std::size_t order_v() const {
    return static_cast<std::size_t>(degree_v) + 1;
  }
  /// Components and weight.
  [[nodiscard]] constexpr std::size_t channels() const {
    return static_cast<std::size_t>(components) + (rational ? 1 : 0);
  }
  [[nodiscard]] constexpr std::size_t points() const { return order_u() * order_v(); }
  [[nodiscard]] constexpr std::size_t control_values() const { return points() * channels(); }

  [[nodiscard]] constexpr std::size_t cells_u() const {
    return degree_u > kMostWholeDegree ? 2 : 1;
  }
  [[nodiscard]] constexpr std::size_t cells_v() const {
    return degree_v > kMostWholeDegree ? 2 : 1;
  }
  [[nodiscard]] constexpr std::size_t cells() const { return cells_u() * cells_v(); }

  /// One channel of a cell.
  [[nodiscard]] constexpr std::size_t matrix() const { return order_u() * order_v(); }
  [[nodiscard]] constexpr std::size_t cell_coefficients() const {
    return whole_blocks(channels() * matrix());
  }
  [[nodiscard]] constexpr std::size_t coefficients() const { return cells() * cell_coefficients(); }

  /// Powers that an edge's channel has room for: those of the longer edge; unused ones are zero.
  [[nodiscard]] constexpr std::size_t edge_powers() const { return std::max(order_u(), order_v()); }
  [[nodiscard]] constexpr std::size_t corners_at() const { return channels() * edge_powers() * 4; }
  [[nodiscard]] constexpr std::size_t cell_edges() const {
    return whole_blocks(corners_at() + channels() * 4);
  }
  [[nodiscard]] constexpr std::size_t edges() const { return cells() * cell_edges(); }

  /// Values that the quick test of normals compares with: a floor, or two sizes of errors.
  [[nodiscard]] constexpr std::size_t floors() const { return rational ? 2 : 1; }

  [[nodiscard]] constexpr std::size_t cell_origins() const { return channels() * 8; }
  [[nodiscard]] constexpr std::size_t origins() const { return cells() * cell_origins(); }

  /// Bicubic polynomial patches in space, which have kernels of their own.
  [[nodiscard]] constexpr bool is_bicubic() const {
    return degree_u == 3 && degree_v == 3 && components == 3 && !rational;
  }
};

template <typename S>
constexpr NetShape shape_of(const ControlNets<S>& nets) {
  return {nets.degree_u, nets.degree_v, nets.components, nets.weights != Weights::none};
}

} // namespace simdbezier::detail
