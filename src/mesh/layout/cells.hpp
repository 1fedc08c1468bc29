// Hands the cells of a patch to a sink, which makes of them what it likes:
//     sink.cell(corners, falling)   a cell with four different vertices, two triangles
//     sink.triangle(a, b, c)        of any other cell, three different vertices, counter-clockwise
//     sink.cells(first, steps, n, falling)   n cells side by side, where a sink has a better way
//                                   than one by one
#pragma once

#include "src/mesh/layout/patch_boundary.hpp"

namespace simdbezier::detail {

/// A leg of a triangle from its right-angled corner on: along a chain, or against it.
class Leg {
public:
  explicit Leg(const Chain& chain) : first_(chain.first), step_(1), segments_(chain.segments) {}

  [[nodiscard]] Leg reversed() const {
    Leg leg = *this;
    leg.first_ += step_ * static_cast<std::ptrdiff_t>(segments_);
    leg.step_ = -step_;
    return leg;
  }

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
/// strip between the legs that advances along the leg that is behind. No triangle has a larger
/// bound on its distance from the surface than the whole half (docs/tessellation.md).
///
/// x, y: counter-clockwise around the corner.
template <typename AnyLeg, typename Sink>
void cut_half(const AnyLeg& x, const AnyLeg& y, Sink& sink) {
  const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && a != c) {
      sink.triangle(a, b, c);
    }
  };
  put(x.vertex(0), x.vertex(1), y.vertex(1));
  const std::uint64_t last_x = x.segments();
  const std::uint64_t last_y = y.segments();
  std::uint32_t i = 1;
  std::uint32_t j = 1;
  while (i < last_x || j < last_y) {
    if (j == last_y || (i < last_x && (i + 1) * last_y <= (j + 1) * last_x)) {
      put(x.vertex(i), x.vertex(i + 1), y.vertex(j));
      ++i;
    } else {
      put(x.vertex(i), y.vertex(j + 1), y.vertex(j));
      ++j;
    }
  }
}

/// The vertices of a cell: at (0,0), (1,0), (0,1), (1,1).
struct CellCorners {
  std::uint32_t at[4];
};

/// The steps from the vertices of a cell to those of the next one: below and above.
struct VertexSteps {
  std::uint32_t below;
  std::uint32_t above;

  void advance(CellCorners& c) const {
    c.at[0] += below;
    c.at[1] += below;
    c.at[2] += above;
    c.at[3] += above;
  }
};

/// Some cells of a row.
template <typename Sink>
void put_cells(CellCorners first, const VertexSteps& steps, std::uint32_t count, bool falling,
               Sink& sink) {
  if constexpr (requires { sink.cells(first, steps, count, falling); }) {
    sink.cells(first, steps, count, falling);
  } else {
    for (; count > 0; --count, steps.advance(first)) {
      sink.cell(first, falling);
    }
  }
}

/// Gives the two triangles of a cell to put(a, b, c), counter-clockwise.
template <typename Put>
__attribute__((always_inline)) inline void put_halves(const CellCorners& c, bool falling,
                                                      const Put& put) {
  if (falling) {
    put(c.at[0], c.at[1], c.at[2]);
    put(c.at[3], c.at[2], c.at[1]);
  } else {
    put(c.at[1], c.at[3], c.at[0]);
    put(c.at[2], c.at[0], c.at[3]);
  }
}

/// The way in which the diagonals of a patch's cells run.
class CellZones {
public:
  CellZones(const MeshData& mesh, std::size_t patch)
      : nu_(mesh.nu[patch]), nv_(mesh.nv[patch]), flags_(mesh.topology.data()->flags[patch]),
        diagonals_(mesh.diagonals[patch]) {}

  /// Whether the cell's diagonal runs from (1,0) to (0,1).
  [[nodiscard]] bool falling(std::uint32_t i, std::uint32_t j) const {
    for (std::uint32_t corner = 0; corner < kPatchCorners && has_forced_diagonal(flags_);
         ++corner) {
      if (is_forced_through(flags_, corner) && i == (corner % 2 != 0 ? nu_ - 1 : 0) &&
          j == (corner >= 2 ? nv_ - 1 : 0)) {
        return falls(corner);
      }
    }
    return (diagonals_ >> (3 * zone_at(j, nv_) + zone_at(i, nu_)) & 1) != 0;
  }
  /// The first cell after an inner cell i that is in another zone or is the last cell.
  [[nodiscard]] std::uint32_t end_of_zone(std::uint32_t i) const {
    const std::uint32_t middle = nu_ / 2;
    const std::uint32_t end = i < middle ? middle : nu_ % 2 != 0 && i == middle ? middle + 1 : nu_;
    return std::min(end, nu_ - 1);
  }
  /// Bit i: whether cell i of a row is falling; for up to 64 cells a row.
  [[nodiscard]] std::uint64_t falling_row(std::uint32_t j) const {
    const std::uint32_t zones = static_cast<std::uint32_t>(diagonals_) >> 3 * zone_at(j, nv_);
    const std::uint32_t middle = nu_ / 2;
    const std::uint64_t low = (std::uint64_t{1} << middle) - 1;
    const std::uint64_t centre = nu_ % 2 != 0 ? std::uint64_t{1} << middle : 0;
    const auto cells = [&](Zone where, std::uint64_t mask) {
      return (zones >> static_cast<std::uint32_t>(where) & 1) != 0 ? mask : 0;
    };
    const std::uint64_t row =
        cells(Zone::low, low) | cells(Zone::middle, centre) | cells(Zone::high, ~(low | centre));
    return has_forced_diagonal(flags_) ? with_corners(row, j) : row;
  }

private:
  /// A row in which the first and the last cell may be corners. A function of its own, because it
  /// is rare.
  __attribute__((noinline)) std::uint64_t with_corners(std::uint64_t row, std::uint32_t j) const {
    const std::uint64_t last = std::uint64_t{1} << (nu_ - 1);
    return (row & ~(1 | last)) | (falling(0, j) ? 1 : 0) | (falling(nu_ - 1, j) ? last : 0);
  }

  std::uint32_t nu_;
  std::uint32_t nv_;
  std::uint8_t flags_;
  std::uint16_t diagonals_;
};

/// Calls visit(i, n, falling) for cells i .. i + n - 1 of [begin, end) with like diagonals; `row`
/// is of CellZones::falling_row().
template <typename Visit>
__attribute__((always_inline)) inline void for_like_cells(std::uint64_t row, std::uint32_t begin,
                                                          std::uint32_t end, const Visit& visit) {
  for (std::uint32_t i = begin; i < end;) {
    const bool falling = (row >> i & 1) != 0;
    const auto like = static_cast<std::uint32_t>(std::countr_zero((falling ? ~row : row) >> i));
    const std::uint32_t n = std::min(like, end - i);
    visit(i, n, falling);
    i += n;
  }
}

/// The cells of one patch.
class CellCutter {
public:
  CellCutter(const MeshData& mesh, const PatchBoundary& boundary, std::size_t patch)
      : boundary_(boundary), nu_(mesh.nu[patch]), nv_(mesh.nv[patch]), inner_(mesh.inner[patch]),
        zones_(mesh, patch) {}

  /// Row by row: columns [0, width) of all rows, then the next ones, so that neighbours are soon
  /// written.
  template <typename Sink>
  void cut(std::uint32_t width, Sink& sink) const {
    for (std::uint32_t begin = 0; begin < nu_; begin += width) {
      for (std::uint32_t j = 0; j < nv_; ++j) {
        cut_row(j, begin, std::min(nu_, begin + width), sink);
      }
    }
  }
  /// Whole rows.
  template <typename Sink>
  void cut(Sink& sink) const {
    cut(nu_, sink);
  }

private:
  static constexpr auto kV0 = static_cast<std::size_t>(PatchEdge::v0);
  static constexpr auto kV1 = static_cast<std::size_t>(PatchEdge::v1);
  static constexpr auto kU0 = static_cast<std::size_t>(PatchEdge::u0);
  static constexpr auto kU1 = static_cast<std::size_t>(PatchEdge::u1);

  /// The vertex of point (i, j).
  [[nodiscard]] std::uint32_t vertex(std::uint32_t i, std::uint32_t j) const {
    return j == 0     ? boundary_.vertex(kV0, i)
           : j == nv_ ? boundary_.vertex(kV1, i)
           : i == 0   ? boundary_.vertex(kU0, j)
           : i == nu_ ? boundary_.vertex(kU1, j)
                      : inner_ + (j - 1) * (nu_ - 1) + (i - 1);
  }

  [[nodiscard]] PointRow point_row(std::uint32_t j) const {
    return j == 0     ? boundary_.row(kV0)
           : j == nv_ ? boundary_.row(kV1)
                      : PointRow{inner_ + (j - 1) * (nu_ - 1) - 1, 1};
  }

  template <typename Sink>
  void cut_row(std::uint32_t j, std::uint32_t begin, std::uint32_t end, Sink& sink) const {
    const PointRow below = point_row(j);
    const PointRow above = point_row(j + 1);
    const bool single = j == 0 && j + 1 == nv_; // both sides may be one edge
    const bool regular = below.step != 0 && above.step != 0 && !single;
    for (std::uint32_t i = begin; i < end;) {
      if (!regular || i == 0 || i + 1 == nu_) {
        cut_border_cell(i, j, sink);
        ++i;
      } else {
        const std::uint32_t last = std::min(end, zones_.end_of_zone(i));
        const std::uint32_t b = below.zero + i * below.step;
        const std::uint32_t a = above.zero + i * above.step;
        put_cells({{b, b + below.step, a, a + above.step}}, {below.step, above.step}, last - i,
                  zones_.falling(i, j), sink);
        i = last;
      }
    }
  }

  template <typename Sink>
  void cut_border_cell(std::uint32_t i, std::uint32_t j, Sink& sink) const {
    const std::uint32_t a = vertex(i, j);
    const std::uint32_t b = vertex(i + 1, j);
    const std::uint32_t c = vertex(i, j + 1);
    const std::uint32_t d = vertex(i + 1, j + 1);
    const bool plain = (j > 0 || boundary_.segments(kV0, i) == 1) &&
                       (j + 1 < nv_ || boundary_.segments(kV1, i) == 1) &&
                       (i > 0 || boundary_.segments(kU0, j) == 1) &&
                       (i + 1 < nu_ || boundary_.segments(kU1, j) == 1);
    if (plain && a != b && a != c && a != d && b != c && b != d && c != d) {
      sink.cell({{a, b, c, d}}, zones_.falling(i, j));
    } else {
      cut_chains(i, j, {{a, b, c, d}}, sink);
    }
  }

  /// A cell whose sides have further vertices, or none.
  template <typename Sink>
  void cut_chains(std::uint32_t i, std::uint32_t j, const CellCorners& c, Sink& sink) const {
    const std::uint32_t left[2] = {c.at[0], c.at[2]};
    const std::uint32_t right[2] = {c.at[1], c.at[3]};
    const Leg bottom(j == 0 ? boundary_.between(kV0, i) : Chain{c.at, 1});
    const Leg top(j + 1 == nv_ ? boundary_.between(kV1, i) : Chain{c.at + 2, 1});
    const Leg west(i == 0 ? boundary_.between(kU0, j) : Chain{left, 1});
    const Leg east(i + 1 == nu_ ? boundary_.between(kU1, j) : Chain{right, 1});
    if (zones_.falling(i, j)) { // right angles at (0,0) and (1,1)
      cut_half(bottom, west, sink);
      cut_half(top.reversed(), east.reversed(), sink);
    } else { // at (1,0) and (0,1)
      cut_half(east, bottom.reversed(), sink);
      cut_half(west.reversed(), top, sink);
    }
  }

  const PatchBoundary& boundary_;
  std::uint32_t nu_;
  std::uint32_t nv_;
  std::uint32_t inner_;
  CellZones zones_;
};

} // namespace simdbezier::detail
