// The triangles of usual patches (see linear_sides.hpp) in a mesh whose edges have no points but
// those of each side, such as one of a common grid.
//
// A row of cells is written as if its inner points went on at both ends. Then the vertices of the
// sides u = 0 and u = 1 take their places.
#pragma once

#include "src/mesh/primitives/index_stream.hpp"
#include "src/mesh/primitives/usual_patch.hpp"

namespace simdbezier::detail {

/// One patch.
template <typename Index, bool kTurned>
class PlainPatch : UsualPatch {
public:
  PlainPatch(const MeshData& mesh, std::size_t patch, const LinearSides& sides,
             RowPatterns<Index>& patterns)
      : UsualPatch(mesh, patch, sides), patterns_(patterns) {}

  // Left to itself, g++ calls functions for a row or two of cells.
  __attribute__((noinline, flatten)) Index* write(IndexStream<Index>& stream, Index* to) const {
    to = border_row(0, stream, to);
    for_inner_rows(patterns_, [&](std::uint32_t j, const Index* pattern, std::uint32_t falling) {
      Index* const row = to;
      to = CellRun<Index>::shift(pattern, inner(0, j), std::size_t{6} * nu_, to);
      put_sides(j, falling, row, to);
      to = stream.make_room(to);
    });
    return border_row(nv_ - 1, stream, to);
  }

private:
  Index* border_row(std::uint32_t j, IndexStream<Index>& stream, Index* to) const {
    Index* const row = to;
    const std::uint64_t falling = zones_.falling_row(j);
    for_like_cells(falling, 0, nu_, [&](std::uint32_t i, std::uint32_t n, bool falls) {
      to = border_cells(i, j, falls).write(0, n, to);
    });
    put_sides(j, (falling & 1) | (falling >> (nu_ - 1) & 1) << 1, row, to);
    return stream.make_room(to);
  }
  /// The row's cells from i on, in the first row (j = 0) or the last one, of which the points on
  /// the side follow each other.
  [[nodiscard]] CellRun<Index> border_cells(std::uint32_t i, std::uint32_t j, bool falling) const {
    const LinearSide& side = j == 0 ? v0_ : v1_;
    const VertexSteps steps{j == 0 ? side.step : 1, j == 0 ? 1 : side.step};
    const std::uint32_t below = j == 0 ? side.at(i) : inner(i, j);
    const std::uint32_t above = j == 0 ? inner(i, 1) : side.at(i);
    return {below, above, steps, falling, kTurned};
  }
  /// The vertices of the sides in the row's first and last cell. falling: bit 0 and bit 1 for them.
  void put_sides(std::uint32_t j, std::uint64_t falling, Index* begin, Index* end) const {
    constexpr unsigned kLeft = 0b0101;
    constexpr unsigned kRight = 0b1010;
    const bool low = j == 0;
    const bool high = j + 1 == nv_;
    put_corners<kLeft, kTurned>(
        begin, {low ? v0_.end[0] : u0_.at(j), 0, high ? v1_.end[0] : u0_.at(j + 1), 0},
        (falling & 1) != 0);
    put_corners<kRight, kTurned>(
        end - 6, {0, low ? v0_.end[1] : u1_.at(j), 0, high ? v1_.end[1] : u1_.at(j + 1)},
        (falling & 2) != 0);
  }

  RowPatterns<Index>& patterns_;
};

} // namespace simdbezier::detail
