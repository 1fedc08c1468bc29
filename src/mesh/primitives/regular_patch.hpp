// The triangles of usual patches (see linear_sides.hpp) with two rows and columns of cells at
// least. The order is that of CellCutter, which cuts all other patches, and the cells in their
// corners.
//
// Cells need no look-ups and few branches: inner cells are written in registers, and so are those
// at a side, up to four triangles of a fan before it is known how many there are. What follows
// overwrites those that are none.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/mesh/layout/cells.hpp"
#include "src/mesh/primitives/cell_patterns.hpp"
#include "src/mesh/primitives/index_stream.hpp"
#include "src/mesh/primitives/linear_sides.hpp"
#include "src/mesh/primitives/usual_patch.hpp"

namespace simdbezier::detail {

/// A leg of a cell in a corner of the patch, from the corner on, as cut_half() takes it.
struct CornerLeg {
  std::uint32_t corner;
  std::uint32_t zero; ///< the number that the corner would have as a point of the row
  std::uint32_t step;
  std::uint32_t count; ///< of segments

  [[nodiscard]] std::uint32_t segments() const { return count; }
  [[nodiscard]] std::uint32_t vertex(std::uint32_t k) const {
    return k == 0 ? corner : zero + k * step;
  }
  /// The leg's other end.
  [[nodiscard]] std::uint32_t far() const { return zero + count * step; }
};

/// A vertex of a side and one of the row of inner points next to it. A side and that row are like
/// the rails of a ladder: each cell lies between two rungs. It is a fan of the side's segments
/// around the inner vertex of one rung, and a triangle of both vertices of the other rung and this
/// inner vertex.
struct Rung {
  std::uint32_t side;
  std::uint32_t inner;
};

/// Writes triangles of cells whose sides may have further vertices, in room that is known to be
/// there.
template <typename Index, bool kTurned>
class FanWriter {
public:
  explicit FanWriter(Index* to) : to_(to) {}

  [[nodiscard]] Index* end() const { return to_; }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    put(0, a, b, c);
    to_ += 3;
  }
  /// A cell of n segments of a side between two rungs.
  ///
  /// kSideFirst: whether the side is the first leg of the fan's half, for cut_half(), or the
  /// second. kFanFirst: whether the fan, which begins at `start`, comes before the other triangle.
  /// step: from one of the side's numbers to the next, from `start` to `far`.
  template <bool kSideFirst, bool kFanFirst>
  void cell(const Rung& start, const Rung& far, std::uint32_t step, std::uint32_t n) {
    if (!kFanFirst) {
      other<kSideFirst>(start, far);
    }
    fan<kSideFirst>(start, step, n);
    if (kFanFirst) {
      other<kSideFirst>(start, far);
    }
  }
  /// The fan of a leg in a corner around the inner vertex, towards the corner.
  template <bool kSideFirst>
  void corner_fan(const CornerLeg& leg, std::uint32_t inner) {
    fan<kSideFirst>({leg.far(), inner}, 0 - leg.step, leg.count);
    const bool single = !kSideFirst && leg.count == 1;
    to_[(single != kTurned) ? -1 : -2] = static_cast<Index>(leg.corner);
  }
  /// The half of a cell that has the corner: cut_half() of its legs. One further vertex at most on
  /// either leg is usual: then three triangles are written, of which those count that are there.
  void corner_half(const CornerLeg& x, const CornerLeg& y) {
    if (x.count > 2 || y.count > 2) [[unlikely]] {
      *this = long_corner_half(x, y, *this);
      return;
    }
    const std::uint32_t x1 = x.vertex(1);
    const std::uint32_t y1 = y.vertex(1);
    const std::uint32_t x2 = x.vertex(2);
    const std::uint32_t y2 = y.vertex(2);
    put(0, x.corner, x1, y1);
    put(1, x1, x.count == 2 ? x2 : y2, y1);
    put(2, x2, y2, y1);
    to_ += std::size_t{3} * (x.count + y.count - 1);
  }

  /// n cells side by side: a pattern, whose numbers become larger by `base`.
  void cells(const Index* pattern, std::uint32_t n, std::uint32_t base) {
    to_ = CellRun<Index>::shift(pattern, base, std::size_t{6} * n, to_);
  }

private:
  /// The triangle of a cell that is not in its fan.
  template <bool kSideFirst>
  void other(const Rung& start, const Rung& far) {
    kSideFirst ? triangle(far.inner, start.inner, far.side)
               : triangle(far.inner, far.side, start.inner);
  }
  /// n segments of a side around the inner vertex of a rung, which the fan begins at. Two are
  /// written whether there are as many or not: a branch would be anyone's guess.
  template <bool kSideFirst>
  void fan(const Rung& start, std::uint32_t step, std::uint32_t n) {
    const std::uint32_t next = start.side + step;
    // Only the first triangle has the corner of the half, and begins there.
    kSideFirst ? put(0, start.side, next, start.inner) : put(0, start.side, start.inner, next);
    put_in_fan<kSideFirst>(1, start, step);
    if (n > 2) [[unlikely]] {
      put_long_fan<kSideFirst>(start, step, n, *this);
    }
    to_ += std::size_t{3} * n;
  }
  template <bool kSideFirst>
  void put_in_fan(std::uint32_t k, const Rung& start, std::uint32_t step) const {
    const std::uint32_t a = start.side + k * step;
    kSideFirst ? put(k, a, a + step, start.inner) : put(k, start.inner, a + step, a);
  }
  /// These two take the writer by value, since an object whose address is known elsewhere stays in
  /// memory.
  template <bool kSideFirst>
  __attribute__((noinline)) static void put_long_fan(Rung start, std::uint32_t step,
                                                     std::uint32_t n, FanWriter out) {
    for (std::uint32_t k = 2; k < n; ++k) {
      out.put_in_fan<kSideFirst>(k, start, step);
    }
  }
  __attribute__((noinline)) static FanWriter long_corner_half(const CornerLeg& x,
                                                              const CornerLeg& y, FanWriter out) {
    cut_half(x, y, out);
    return out;
  }
  void put(std::size_t k, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    Index* const to = to_ + 3 * k;
    to[0] = static_cast<Index>(a);
    to[1] = static_cast<Index>(kTurned ? c : b);
    to[2] = static_cast<Index>(kTurned ? b : c);
  }

  Index* to_;
};

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
