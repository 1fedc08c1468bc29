// The triangles of usual patches (see linear_sides.hpp) with two rows and columns of cells at
// least. The order is that of CellCutter, which cuts all other patches, and the cells in their
// corners.
//
// Cells need no look-ups and few branches: inner cells are written in registers, and so are those
// at a side, up to four triangles of a fan before it is known how many there are. What follows
// overwrites those that are none.
#pragma once

#include "src/mesh/primitives/fan_writer.hpp"
#include "src/mesh/primitives/index_stream.hpp"
#include "src/mesh/primitives/linear_sides.hpp"
#include "src/mesh/primitives/usual_patch.hpp"

namespace simdbezier::detail {

/// Cells of side kSide but those in the patch's corners.
template <PatchEdge kSide, typename Index, bool kTurned>
class SideCells {
public:
  /// From inner vertex `inner` on, with `inner_step` to the next one.
  SideCells(const LinearSide& side, std::uint32_t inner, std::uint32_t inner_step)
      : counts_(side.counts), step_(side.step), rung_{side.at(counts_[0]), inner},
        inner_step_(inner_step) {}

  /// Writes cell k, which comes after cell k - 1.
  void put(std::uint32_t k, bool falling, FanWriter<Index, kTurned>& out) {
    const std::uint32_t n = counts_[k];
    const Rung next{rung_.side + n * step_, rung_.inner + inner_step_};
    constexpr bool kHigh = kSide == PatchEdge::v1 || kSide == PatchEdge::u1;
    constexpr bool kRunsInU = kSide == PatchEdge::v0 || kSide == PatchEdge::v1;
    // The fan is in the half that has its right angle at the side; halves come in the order of
    // CellCutter.
    falling ? put_between<kRunsInU, !kHigh, !kHigh>(next, n, out)
            : put_between<!kRunsInU, kHigh, kRunsInU != kHigh>(next, n, out);
    rung_ = next;
  }

private:
  template <bool kSideFirst, bool kForwards, bool kFanFirst>
  void put_between(const Rung& next, std::uint32_t n, FanWriter<Index, kTurned>& out) const {
    out.template cell<kSideFirst, kFanFirst>(kForwards ? rung_ : next, kForwards ? next : rung_,
                                             kForwards ? step_ : 0 - step_, n);
  }

  const std::uint8_t* counts_;
  std::uint32_t step_;
  Rung rung_;
  std::uint32_t inner_step_;
};

/// One patch.
template <typename Index, bool kTurned>
class RegularPatch : UsualPatch {
public:
  RegularPatch(const MeshData& mesh, std::size_t patch, const LinearSides& sides,
               RowPatterns<Index>& patterns)
      : UsualPatch(mesh, patch, sides), patterns_(patterns) {}

  Index* write(IndexStream<Index>& stream, Index* to) const {
    to = stream.make_room(border_row<false>(to));
    const std::uint32_t last = nu_ - 1;
    SideCells<PatchEdge::u0, Index, kTurned> u0(u0_, inner(1, 1), last);
    SideCells<PatchEdge::u1, Index, kTurned> u1(u1_, inner(last, 1), last);
    std::uint32_t base = inner(0, 1);
    for_inner_rows(patterns_, [&](std::uint32_t j, const Index* pattern, std::uint32_t falling) {
      Writer out(to);
      u0.put(j, (falling & 1) != 0, out);
      out.cells(pattern + 6, last - 1, base);
      u1.put(j, (falling & 2) != 0, out);
      to = stream.make_room(out.end());
      base += last;
    });
    return stream.make_room(border_row<true>(to));
  }

private:
  using Writer = FanWriter<Index, kTurned>;

  /// The first or the last row of cells.
  template <bool kHigh>
  Index* border_row(Index* to) const {
    const std::uint32_t j = kHigh ? nv_ - 1 : 0;
    const std::uint32_t last = nu_ - 1;
    const std::uint64_t row = zones_.falling_row(j);
    Writer out(to);
    corner_cell<false, kHigh>((row & 1) != 0, out);
    SideCells<kHigh ? PatchEdge::v1 : PatchEdge::v0, Index, kTurned> cells(
        kHigh ? v1_ : v0_, inner(1, kHigh ? j : 1), 1);
    for (std::uint32_t i = 1; i < last; ++i) {
      cells.put(i, (row >> i & 1) != 0, out);
    }
    corner_cell<true, kHigh>((row >> last & 1) != 0, out);
    return out.end();
  }

  /// Both sides of it may have further vertices.
  template <bool kRight, bool kHigh>
  void corner_cell(bool falling, Writer& out) const {
    const CornerLeg row = leg<kRight>(kHigh ? v1_ : v0_, nu_);
    const CornerLeg column = leg<kHigh>(kRight ? u1_ : u0_, nv_);
    const std::uint32_t inside = inner(kRight ? nu_ - 1 : 1, kHigh ? nv_ - 1 : 1);
    constexpr bool kRowFirst = kRight == kHigh; // from leg to leg, counter-clockwise
    const CornerLeg& first = kRowFirst ? row : column;
    const CornerLeg& second = kRowFirst ? column : row;
    if (falling == kRowFirst) {
      if (kHigh) { // the half inside comes first
        out.triangle(inside, second.far(), first.far());
      }
      out.corner_half(first, second);
      if (!kHigh) {
        out.triangle(inside, second.far(), first.far());
      }
    } else if (kRight) {
      out.template corner_fan<true>(second, inside);
      out.template corner_fan<false>(first, inside);
    } else {
      out.template corner_fan<false>(first, inside);
      out.template corner_fan<true>(second, inside);
    }
  }
  /// A side's part in the cell at its beginning or end.
  template <bool kAtEnd>
  static CornerLeg leg(const LinearSide& side, std::uint32_t rate) {
    return kAtEnd ? CornerLeg{side.end[1], side.at(side.segments), 0 - side.step,
                              side.counts[rate - 1]}
                  : CornerLeg{side.end[0], side.at(0), side.step, side.counts[0]};
  }

  RowPatterns<Index>& patterns_;
};

} // namespace simdbezier::detail
