// The triangles of usual patches: rates from 2 to 63, and sides whose vertices follow each other.
// The order is that of CellCutter, which cuts all other patches, and the cells in their corners.
//
// Cells need no look-ups and few branches: inner cells are written in registers, and for a cell at
// a side, whose triangles are a fan, two triangles are written before it is known whether there is
// a second. If there is none, what follows overwrites it.
#pragma once

#include "src/mesh/primitives/fan_writer.hpp"
#include "src/mesh/primitives/index_stream.hpp"
#include "src/mesh/primitives/usual_patch.hpp"

namespace simdbezier::detail {

/// One patch.
template <typename Index, bool kTurned>
class RegularPatch : UsualPatch {
public:
  RegularPatch(const MeshData& mesh, std::size_t patch, const LinearSides& sides)
      : UsualPatch(mesh, patch, sides), inner_cells_(nu_) {}

  Index* write(IndexStream<Index>& stream, Index* to) const {
    to = stream.make_room(border_row(0, v0_, to));
    for (std::uint32_t j = 1; j + 1 < nv_; ++j) {
      to = stream.make_room(inner_row(j, to));
    }
    return stream.make_room(border_row(nv_ - 1, v1_, to));
  }

private:
  using Writer = FanWriter<Index, kTurned>;

  Index* inner_row(std::uint32_t j, Index* to) const {
    Writer out(to);
    const std::uint64_t row = zones_.falling_row(j);
    const std::uint32_t first = inner(1, j);
    const std::uint32_t last = first + nu_ - 2;
    cell_at_u0(j, first, (row & 1) != 0, out);
    for_like_cells(row, 1, nu_ - 1, [&](std::uint32_t i, std::uint32_t n, bool falling) {
      out.cells(inner_cells_.run(falling), first + i - 1, n);
    });
    cell_at_u1(j, last, (row >> (nu_ - 1) & 1) != 0, out);
    return out.end();
  }
  /// b: its vertex at (1,0).
  void cell_at_u0(std::uint32_t j, std::uint32_t b, bool falling, Writer& out) const {
    const std::uint32_t d = b + nu_ - 1;
    const std::uint32_t place = u0_.places[j];
    const std::uint32_t n = u0_.places[j + 1] - place;
    const std::uint32_t a = u0_.at(place);
    const std::uint32_t c = u0_.at(place + n);
    if (falling) {
      out.fan_of_second(a, u0_.step, n, b);
      out.triangle(d, c, b);
    } else {
      out.triangle(b, d, a);
      out.fan_of_first(c, 0 - u0_.step, n, d);
    }
  }
  /// a: its vertex at (0,0).
  void cell_at_u1(std::uint32_t j, std::uint32_t a, bool falling, Writer& out) const {
    const std::uint32_t c = a + nu_ - 1;
    const std::uint32_t place = u1_.places[j];
    const std::uint32_t n = u1_.places[j + 1] - place;
    const std::uint32_t b = u1_.at(place);
    const std::uint32_t d = u1_.at(place + n);
    if (falling) {
      out.triangle(a, b, c);
      out.fan_of_second(d, 0 - u1_.step, n, c);
    } else {
      out.fan_of_first(b, u1_.step, n, a);
      out.triangle(c, a, d);
    }
  }

  /// The first or the last row of cells.
  Index* border_row(std::uint32_t j, const LinearSide& side, Index* to) const {
    to = corner_cell(0, j, to);
    Writer out(to);
    const std::uint64_t row = zones_.falling_row(j);
    if (side.segments == nu_) {
      for_like_cells(row, 1, nu_ - 1, [&](std::uint32_t i, std::uint32_t n, bool falling) {
        out.cells(border_cells<Index, kTurned>(i, j, falling), 0, n);
      });
    } else {
      for (std::uint32_t i = 1; i + 1 < nu_; ++i) {
        const bool falling = (row >> i & 1) != 0;
        j == 0 ? cell_at_v0(i, falling, out) : cell_at_v1(i, falling, out);
      }
    }
    return corner_cell(nu_ - 1, j, out.end());
  }
  void cell_at_v0(std::uint32_t i, bool falling, Writer& out) const {
    const std::uint32_t place = v0_.places[i];
    const std::uint32_t n = v0_.places[i + 1] - place;
    const std::uint32_t a = v0_.at(place);
    const std::uint32_t b = v0_.at(place + n);
    const std::uint32_t c = inner(i, 1);
    if (falling) {
      out.fan_of_first(a, v0_.step, n, c);
      out.triangle(c + 1, c, b);
    } else {
      out.fan_of_second(b, 0 - v0_.step, n, c + 1);
      out.triangle(c, a, c + 1);
    }
  }
  void cell_at_v1(std::uint32_t i, bool falling, Writer& out) const {
    const std::uint32_t place = v1_.places[i];
    const std::uint32_t n = v1_.places[i + 1] - place;
    const std::uint32_t c = v1_.at(place);
    const std::uint32_t d = v1_.at(place + n);
    const std::uint32_t a = inner(i, nv_ - 1);
    if (falling) {
      out.triangle(a, a + 1, c);
      out.fan_of_first(d, 0 - v1_.step, n, a + 1);
    } else {
      out.triangle(a + 1, d, a);
      out.fan_of_second(c, v1_.step, n, a);
    }
  }

  /// Both sides of it may have further vertices.
  Index* corner_cell(std::uint32_t i, std::uint32_t j, Index* to) const {
    const bool right = i > 0;
    const bool high = j > 0;
    const CornerLeg row = leg(high ? v1_ : v0_, right, nu_);
    const CornerLeg column = leg(right ? u1_ : u0_, high, nv_);
    const std::uint32_t inside = inner(right ? i : 1, high ? j : 1);
    const bool row_first = right == high; // from leg to leg, counter-clockwise
    Writer out(to);
    if (zones_.falling(i, j) == row_first) {
      if (high) { // the half inside comes first
        put_inner_half(row, column, row_first, inside, out);
      }
      out.corner_half(row_first ? row : column, row_first ? column : row);
      if (!high) {
        put_inner_half(row, column, row_first, inside, out);
      }
    } else if (right) {
      out.fan_of_first(row_first ? column : row, inside);
      out.fan_of_second(row_first ? row : column, inside);
    } else {
      out.fan_of_second(row_first ? row : column, inside);
      out.fan_of_first(row_first ? column : row, inside);
    }
    return out.end();
  }
  /// The half of a cell in a corner that does not have the corner.
  static void put_inner_half(const CornerLeg& row, const CornerLeg& column, bool row_first,
                             std::uint32_t inside, Writer& out) {
    const std::uint32_t a = row_first ? column.far() : row.far();
    const std::uint32_t b = row_first ? row.far() : column.far();
    out.triangle(inside, a, b);
  }
  /// A side's part in the cell at its beginning or end.
  static CornerLeg leg(const LinearSide& side, bool at_end, std::uint32_t rate) {
    return at_end ? CornerLeg{side.end[1], side.at(side.segments), 0 - side.step,
                              side.segments - side.places[rate - 1]}
                  : CornerLeg{side.end[0], side.at(0), side.step, side.places[1]};
  }

  InnerCells<Index, kTurned> inner_cells_;
};

} // namespace simdbezier::detail
