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
  PlainPatch(const MeshData& mesh, std::size_t patch, const LinearSides& sides)
      : UsualPatch(mesh, patch, sides), inner_cells_(nu_) {}

  // Left to itself, g++ calls functions for a row or two of cells.
  __attribute__((noinline, flatten)) Index* write(IndexStream<Index>& stream, Index* to) const {
    for (std::uint32_t j = 0; j < nv_; ++j) {
      const bool border = j == 0 || j + 1 == nv_;
      const std::uint64_t falling = zones_.falling_row(j);
      Index* const row = to;
      to = border ? border_row(j, falling, to) : inner_row(j, falling, to);
      put_sides(j, falling, row, to);
      to = stream.make_room(to);
    }
    return to;
  }

private:
  Index* inner_row(std::uint32_t j, std::uint64_t falling, Index* to) const {
    for_like_cells(falling, 0, nu_, [&](std::uint32_t i, std::uint32_t n, bool falls) {
      to = inner_cells_.run(falls).write(inner(i, j), n, to);
    });
    return to;
  }
  Index* border_row(std::uint32_t j, std::uint64_t falling, Index* to) const {
    for_like_cells(falling, 0, nu_, [&](std::uint32_t i, std::uint32_t n, bool falls) {
      to = border_cells<Index, kTurned>(i, j, falls).write(0, n, to);
    });
    return to;
  }
  /// The vertices of the sides in the row's first and last cell.
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
        (falling >> (nu_ - 1) & 1) != 0);
  }

  InnerCells<Index, kTurned> inner_cells_;
};

} // namespace simdbezier::detail
