// From the cells of a patch to triangles.
#pragma once

#include "src/mesh/patch_boundary.hpp"

namespace simdbezier::detail {

/// Writes triangles, the other way round where the patch is turned; those with two equal vertices
/// are left out.
template <typename Index>
class TriangleWriter {
public:
  TriangleWriter(Index* to, bool turned) : to_(to), turned_(turned) {}

  void put(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && a != c) {
      put_proper(a, b, c);
    }
  }
  void put_proper(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    to_[0] = static_cast<Index>(a);
    to_[1] = static_cast<Index>(turned_ ? c : b);
    to_[2] = static_cast<Index>(turned_ ? b : c);
    to_ += 3;
  }
  [[nodiscard]] Index* end() const { return to_; }

private:
  Index* to_;
  bool turned_;
};

/// A leg of a triangle from its right-angled corner on: along a chain, or against it.
class Leg {
public:
  Leg(const Chain& chain, bool against)
      : first_(against ? chain.first + chain.segments : chain.first), step_(against ? -1 : 1),
        segments_(chain.segments) {}

  /// A leg of one segment at least: where the side is a point, both ends are it.
  [[nodiscard]] std::uint32_t segments() const { return segments_ == 0 ? 1 : segments_; }
  [[nodiscard]] std::uint32_t vertex(std::uint32_t k) const {
    return segments_ == 0 ? *first_ : first_[step_ * static_cast<std::ptrdiff_t>(k)];
  }

private:
  const std::uint32_t* first_;
  std::ptrdiff_t step_;
  std::uint32_t segments_;
};

/// One half of a cell, whose legs may have further vertices: the triangle at the corner, then a
/// strip between the legs that advances on the one that is behind. None of these triangles has a
/// larger bound on its distance from the surface than the whole half (docs/accuracy.md).
///
/// x, y: counter-clockwise around the corner.
template <typename Index>
void cut_half(const Leg& x, const Leg& y, TriangleWriter<Index>& triangles) {
  triangles.put(x.vertex(0), x.vertex(1), y.vertex(1));
  const std::uint64_t last_x = x.segments();
  const std::uint64_t last_y = y.segments();
  std::uint32_t i = 1;
  std::uint32_t j = 1;
  while (i < last_x || j < last_y) {
    if (j == last_y || (i < last_x && (i + 1) * last_y <= (j + 1) * last_x)) {
      triangles.put(x.vertex(i), x.vertex(i + 1), y.vertex(j));
      ++i;
    } else {
      triangles.put(x.vertex(i), y.vertex(j + 1), y.vertex(j));
      ++j;
    }
  }
}

/// The cells of one patch.
template <typename Index>
class CellCutter {
public:
  CellCutter(const MeshData& mesh, const PatchBoundary& boundary, std::size_t patch)
      : boundary_(boundary), nu_(mesh.nu[patch]), nv_(mesh.nv[patch]), inner_(mesh.inner[patch]),
        flags_(mesh.topology.data()->flags[patch]), diagonals_(mesh.diagonals[patch]) {}

  void write(TriangleWriter<Index>& triangles) const {
    write_border_row(0, triangles);
    for (std::uint32_t j = 1; j + 1 < nv_; ++j) {
      write_border_cell(0, j, triangles);
      write_inner_row(j, triangles);
      if (nu_ > 1) {
        write_border_cell(nu_ - 1, j, triangles);
      }
    }
    if (nv_ > 1) {
      write_border_row(nv_ - 1, triangles);
    }
  }

private:
  enum SideNumber : std::size_t { kV0, kV1, kU0, kU1 };

  /// The zone of cell i of n.
  static std::uint32_t zone(std::uint32_t i, std::uint32_t n) {
    const Zone where = n % 2 != 0 && i == n / 2 ? Zone::middle
                       : 2 * i >= n             ? Zone::high
                                                : Zone::low;
    return static_cast<std::uint32_t>(where);
  }
  /// Whether the cell's diagonal runs from (1,0) to (0,1).
  [[nodiscard]] bool falling(std::uint32_t i, std::uint32_t j) const {
    for (std::uint32_t corner = 0; corner < kPatchCorners; ++corner) {
      if ((flags_ >> corner & 1) != 0 && i == (corner % 2 != 0 ? nu_ - 1 : 0) &&
          j == (corner >= 2 ? nv_ - 1 : 0)) {
        return falls(corner);
      }
    }
    return (diagonals_ >> (3 * zone(j, nv_) + zone(i, nu_)) & 1) != 0;
  }

  /// The vertex of point (i, j).
  [[nodiscard]] std::uint32_t vertex(std::uint32_t i, std::uint32_t j) const {
    return j == 0     ? boundary_.vertex(kV0, i)
           : j == nv_ ? boundary_.vertex(kV1, i)
           : i == 0   ? boundary_.vertex(kU0, j)
           : i == nu_ ? boundary_.vertex(kU1, j)
                      : inner_ + (j - 1) * (nu_ - 1) + (i - 1);
  }

  void write_border_row(std::uint32_t j, TriangleWriter<Index>& triangles) const {
    for (std::uint32_t i = 0; i < nu_; ++i) {
      write_border_cell(i, j, triangles);
    }
  }

  void write_border_cell(std::uint32_t i, std::uint32_t j, TriangleWriter<Index>& triangles) const {
    const std::uint32_t low[2] = {vertex(i, j), vertex(i + 1, j)};
    const std::uint32_t high[2] = {vertex(i, j + 1), vertex(i + 1, j + 1)};
    const std::uint32_t left[2] = {low[0], high[0]};
    const std::uint32_t right[2] = {low[1], high[1]};
    const Chain bottom = j == 0 ? boundary_.between(kV0, i) : Chain{low, 1};
    const Chain top = j + 1 == nv_ ? boundary_.between(kV1, i) : Chain{high, 1};
    const Chain west = i == 0 ? boundary_.between(kU0, j) : Chain{left, 1};
    const Chain east = i + 1 == nu_ ? boundary_.between(kU1, j) : Chain{right, 1};
    if (falling(i, j)) { // right angles at (i, j) and (i + 1, j + 1)
      cut_half(Leg(bottom, false), Leg(west, false), triangles);
      cut_half(Leg(top, true), Leg(east, true), triangles);
    } else { // at (i + 1, j) and (i, j + 1)
      cut_half(Leg(east, false), Leg(bottom, true), triangles);
      cut_half(Leg(west, true), Leg(top, false), triangles);
    }
  }

  /// Cells between the first and the last one of a row that is neither the first nor the last.
  void write_inner_row(std::uint32_t j, TriangleWriter<Index>& triangles) const {
    const std::uint32_t below = inner_ + (j - 1) * (nu_ - 1) - 1; // of (i, j) less i
    const std::uint32_t above = below + (nu_ - 1);
    for (std::uint32_t i = 1; i + 1 < nu_;) {
      const std::uint32_t end = zone_end(i);
      if (falling(i, j)) {
        for (; i < end; ++i) {
          triangles.put_proper(below + i, below + i + 1, above + i);
          triangles.put_proper(above + i + 1, above + i, below + i + 1);
        }
      } else {
        for (; i < end; ++i) {
          triangles.put_proper(below + i + 1, above + i + 1, below + i);
          triangles.put_proper(above + i, below + i, above + i + 1);
        }
      }
    }
  }
  /// Where the zone of an inner cell ends, or the inner cells do.
  [[nodiscard]] std::uint32_t zone_end(std::uint32_t i) const {
    const std::uint32_t middle = nu_ / 2;
    const std::uint32_t end = i < middle ? middle : nu_ % 2 != 0 && i == middle ? middle + 1 : nu_;
    return std::min(end, nu_ - 1);
  }

  const PatchBoundary& boundary_;
  std::uint32_t nu_;
  std::uint32_t nv_;
  std::uint32_t inner_;
  std::uint8_t flags_;
  std::uint16_t diagonals_;
};

} // namespace simdbezier::detail
