// The triangles of usual patches (see linear_sides.hpp) with a single row or column of cells, such
// as those of ruled surfaces. The order is that of CellCutter.
#pragma once

#include "src/mesh/layout/cells.hpp"
#include "src/mesh/primitives/fan_writer.hpp"
#include "src/mesh/primitives/index_stream.hpp"
#include "src/mesh/primitives/linear_leg.hpp"

namespace simdbezier::detail {

/// One patch, in which nu or nv is 1.
template <typename Index, bool kTurned>
class StripPatch {
public:
  StripPatch(const MeshData& mesh, std::size_t patch, const LinearSides& sides)
      : sides_(sides), zones_(mesh, patch), nu_(mesh.nu[patch]), nv_(mesh.nv[patch]) {}

  Index* write(IndexStream<Index>& stream, Index* to) const {
    return nv_ == 1 ? strip<true>(stream, to) : strip<false>(stream, to);
  }

private:
  using Writer = FanWriter<Index, kTurned>;

  /// Cells between two opposite sides, one after the other along them: in u, or in v.
  template <bool kInU>
  Index* strip(IndexStream<Index>& stream, Index* to) const {
    const LinearSide& near = sides_[kInU ? 0 : 2];
    const LinearSide& far = sides_[kInU ? 1 : 3];
    const std::uint32_t last = (kInU ? nu_ : nv_) - 1;
    UnionWalk near_walk = near.walk;
    UnionWalk far_walk = far.walk;
    std::uint32_t near_place = 0;
    std::uint32_t far_place = 0;
    for (std::uint32_t i = 0; i <= last; ++i) {
      const CellLegs cell{{near, near_place, near_walk.next()}, {far, far_place, far_walk.next()}};
      const bool falling = kInU ? zones_.falling(i, 0) : zones_.falling(0, i);
      Writer out(to);
      i == 0 || i == last ? border_cell<kInU>(cell, i == 0, i == last, falling, out)
                          : inner_cell<kInU>(cell, falling, out);
      to = stream.make_room(out.end());
      near_place += cell.near.segments;
      far_place += cell.far.segments;
    }
    return to;
  }

  /// Some segments of a side.
  struct Segments {
    const LinearSide& side;
    std::uint32_t place;
    std::uint32_t segments;

    [[nodiscard]] std::uint32_t low() const { return side.at(place); }
    [[nodiscard]] std::uint32_t high() const { return side.at(place + segments); }
    [[nodiscard]] bool descends() const { return side.step != 1; }
    [[nodiscard]] LinearLeg leg() const { return {side, place, segments}; }
  };
  /// A cell's legs on both sides.
  struct CellLegs {
    Segments near;
    Segments far;
  };

  /// A cell whose other legs are single segments: a fan around the end of the diagonal on the other
  /// side for each half.
  template <bool kInU>
  static void inner_cell(const CellLegs& cell, bool falling, Writer& out) {
    const auto& [near, far] = cell;
    // Halves come in the order of CellCutter.
    if (falling) {
      out.template fan<kInU>({near.low(), far.low()}, near.descends(), near.segments);
      out.template fan<kInU>({far.high(), near.high()}, !far.descends(), far.segments);
    } else if (kInU) {
      out.template fan<false>({near.high(), far.high()}, !near.descends(), near.segments);
      out.template fan<false>({far.low(), near.low()}, far.descends(), far.segments);
    } else {
      out.template fan<true>({far.low(), near.low()}, far.descends(), far.segments);
      out.template fan<true>({near.high(), far.high()}, !near.descends(), near.segments);
    }
  }

  /// The first or the last cell, or the only one: its other legs may be sides as well.
  template <bool kInU>
  void border_cell(const CellLegs& cell, bool first, bool last, bool falling, Writer& out) const {
    const LinearSide& begin = sides_[kInU ? 2 : 0];
    const LinearSide& end = sides_[kInU ? 3 : 1];
    const LinearLeg near = cell.near.leg();
    const LinearLeg far = cell.far.leg();
    const LinearLeg low =
        first ? LinearLeg(begin, 0, begin.segments) : LinearLeg(near.vertex(0), far.vertex(0));
    const LinearLeg high =
        last ? LinearLeg(end, 0, end.segments)
             : LinearLeg(near.vertex(near.segments()), far.vertex(far.segments()));
    const CellSides<LinearLeg> sides = kInU ? CellSides<LinearLeg>{near, far, low, high}
                                            : CellSides<LinearLeg>{low, high, near, far};
    cut_cell(sides, falling, out);
  }

  const LinearSides& sides_;
  CellZones zones_;
  std::uint32_t nu_;
  std::uint32_t nv_;
};

} // namespace simdbezier::detail
