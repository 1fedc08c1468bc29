#include "src/mesh/bounds/space_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/mesh/bounds/chord_distance.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A vertex is off by so much of the parameter's range.
constexpr double kVertexRounding = kStepRounding / 2;
/// A bound may be above what points of the surface ask for by this factor.
constexpr double kCloseToFound = 1.02;
/// What sides add may be above that by this share of what is enough for the cell.
constexpr double kSideShare = 1.0 / 16;
/// Of one cell; what is left then is bounded by its control points.
constexpr std::size_t kMostCellHalvings = 150;
constexpr std::size_t kMostSideHalvings = 1000;

/// Of the time that a piece takes, what a cell takes that is nowhere larger than the tolerance.
constexpr double kSmallCell = 1.0 / 64;

/// What roundings of parameters may count as, of a bound on cells that have been looked at.
constexpr double kLittleMotion = 1.0 / 256;

/// The largest second difference of some rows in channels [begin, end).
double largest_bend(const double* points, std::size_t count, std::size_t step, std::size_t lines,
                    std::size_t line_step, std::size_t begin, std::size_t end) {
  double most = 0;
  for (std::size_t line = 0; line < lines; ++line) {
    for (std::size_t k = 0; k + 2 < count; ++k) {
      const double* const at = points + line * line_step + k * step;
      for (std::size_t c = begin; c < end; ++c) {
        most = std::max(most, std::fabs(at[c] - 2 * at[c + step] + at[c + 2 * step]));
      }
    }
  }
  return most;
}

/// Lets the next corner be one with another one if they are so close, and returns how close:
/// quadrangles with a side that is hardly more than a point need not be convex.
double join_corners(std::array<const double*, 4>& corners, double close) {
  for (std::size_t k = 0; k < 4; ++k) {
    const double* const a = corners[k];
    const double*& b = corners[(k + 1) % 4];
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double d = a[c] / a[3] - b[c] / b[3];
      square += d * d;
    }
    if (square > 0 && square <= close * close) {
      b = a;
      return std::sqrt(square);
    }
  }
  return 0;
}

} // namespace

double weight_spread(const VectorPatch& patch) {
  if (!patch.rational) {
    return 1;
  }
  const auto [low, high] =
      std::minmax_element(patch.net.at.begin(), patch.net.at.end(),
                          [](const auto& a, const auto& b) { return a.x[3] < b.x[3]; });
  return high->x[3] / low->x[3];
}

SpaceBound::SpaceBound(const VectorPatch& patch, RateFlags flags, const PatchTurn& turn)
    : turn_(turn), columns_(patch.net.columns), rows_(patch.net.rows), flags_(flags),
      work_(static_cast<double>(columns_ * columns_ * rows_ * rows_)),
      spread_(weight_spread(patch)) {
  double heaviest = 0;
  for (const ControlVector& v : patch.net.at) {
    net_.insert(net_.end(), v.x, v.x + kChannels);
    heaviest = std::max(heaviest, v.x[3]);
  }
  doubt_ = kPointSetDoubt * patch.largest / heaviest;
  pieces_.resize((kDeepest + 1) * net_.size());
}

void SpaceBound::take_row(std::uint32_t j, std::uint32_t nv) {
  strip_ = net_;
  const std::size_t row = columns_ * kChannels;
  cut_curve(strip_.data(), rows_, row, row, static_cast<double>(j) / nv,
            static_cast<double>(j + 1) / nv);
}

void SpaceBound::take_cell(std::uint32_t i, std::uint32_t nu) {
  cell_ = strip_;
  for (std::size_t j = 0; j < rows_; ++j) {
    cut_curve(cell_.data() + j * columns_ * kChannels, columns_, kChannels, kChannels,
              static_cast<double>(i) / nu, static_cast<double>(i + 1) / nu);
  }
  radius_ = radius();
}

/// How far roundings of parameters move the cell's corners into it. What is little may be above
/// that.
double SpaceBound::motion(std::uint32_t i, std::uint32_t j, const CellCounts& cells,
                          double little) const {
  // Corners are means of control points, which but for one have weights below this in all.
  const double steps = kVertexRounding * (static_cast<double>(columns_ * cells.nu) +
                                          static_cast<double>(rows_ * cells.nv));
  const double rough = 2 * radius_ * spread_ * steps / (1 - steps);
  if (steps < 1 && rough <= little) {
    return rough;
  }
  double most = 0;
  for (std::size_t corner = 0; corner < kPatchCorners; ++corner) {
    const bool high_u = corner % 2 != 0;
    const bool high_v = corner >= 2;
    const bool fixed_u = high_u ? i + 1 == cells.nu : i == 0;
    const bool fixed_v = high_v ? j + 1 == cells.nv : j == 0;
    const auto row = static_cast<std::ptrdiff_t>(columns_ * kChannels);
    const auto step = static_cast<std::ptrdiff_t>(kChannels);
    const NetCorner net{cell_.data() + (high_u ? columns_ - 1 : 0) * kChannels +
                            (high_v ? rows_ - 1 : 0) * columns_ * kChannels,
                        columns_,
                        rows_,
                        {high_u ? -step : step, high_v ? -row : row},
                        kChannels - 1};
    most = larger_bound(most, net.motion(fixed_u ? 0 : kVertexRounding * cells.nu,
                                         fixed_v ? 0 : kVertexRounding * cells.nv));
  }
  return most;
}

/// What the distances of a piece come to: docs/tessellation.md has the cases.
double SpaceBound::Look::total(const GraphDistance& piece) const {
  const double across = std::max(piece.outside + cut.inside, shift());
  return std::max(sides, distance(piece, piece.outside + shift(), across));
}

/// What those of a piece of a side come to.
double SpaceBound::Look::side_total(const GraphDistance& piece) const {
  const double far = piece.inside + shift();
  return distance(piece, far, far);
}

/// Of points that far across the axis, where the graph may have been that far along it.
double SpaceBound::Look::distance(const GraphDistance& piece, double along, double across) const {
  const double steep =
      std::max(piece.above + cut.below, piece.below + cut.above) + graph.slope() * along;
  return std::sqrt(steep * steep + across * across);
}

/// Whether halves along u are flatter than those along v.
bool SpaceBound::halve_along_u(const double* net, bool across) const {
  const std::size_t row = columns_ * kChannels;
  const std::size_t begin = across ? 0 : 2;
  const std::size_t end = across ? 2 : 3;
  const double u = largest_bend(net, columns_, kChannels, rows_, row, begin, end);
  const double v = largest_bend(net, rows_, row, columns_, kChannels, begin, end);
  const double* const corner[4] = {net, net + row - kChannels, net + (rows_ - 1) * row,
                                   net + rows_ * row - kChannels};
  double twist = 0;
  double length[2] = {0, 0};
  for (std::size_t c = 0; c < 3; ++c) {
    const double along_u = corner[1][c] - corner[0][c];
    const double along_v = corner[2][c] - corner[0][c];
    twist += c >= begin && c < end ? std::fabs(corner[3][c] - corner[2][c] - along_u) : 0;
    length[0] += std::fabs(along_u) + std::fabs(corner[3][c] - corner[2][c]);
    length[1] += std::fabs(along_v) + std::fabs(corner[3][c] - corner[1][c]);
  }
  return std::max(u, v) > twist ? u > v : length[0] > length[1];
}

/// Of the piece in a level's place, whose later half takes that place.
double SpaceBound::bound_piece(Look& look, std::size_t level, std::size_t depth) {
  ++looked_at_;
  double* const net = piece(level);
  const GraphDistance measured = look.graph.of_hull(net, columns_ * rows_);
  const double total = look.total(measured);
  if (total <= look.enough) {
    return total;
  }
  for (const std::size_t corner :
       {std::size_t{0}, columns_ - 1, columns_ * (rows_ - 1), columns_ * rows_ - 1}) {
    look.found = std::max(look.found, look.total(look.graph.of_hull(net + corner * kChannels, 1)));
  }
  if (look.found > look.stop) {
    return kInfinity;
  }
  if (total <= kCloseToFound * look.found || depth == kDeepest ||
      look.halvings == kMostCellHalvings) {
    look.enough = std::max(look.enough, total);
    return total;
  }
  ++look.halvings;
  const std::size_t row = columns_ * kChannels;
  if (halve_along_u(net, measured.outside > std::max(measured.above, measured.below))) {
    for (std::size_t j = 0; j < rows_; ++j) {
      halve_rows(net + j * row, piece(level + 1) + j * row, columns_, kChannels, kChannels);
    }
  } else {
    halve_rows(net, piece(level + 1), rows_, row, row);
  }
  const double most = bound_piece(look, level + 1, depth + 1);
  return most <= look.stop ? std::max(most, bound_piece(look, level, depth + 1)) : most;
}

/// Of a piece of a side. What neighbours have on sides is known before the others are looked at.
GraphDistance SpaceBound::bound_side(Look& look, SideLook& side, std::size_t level,
                                     std::size_t depth) {
  double* const points = piece(level);
  const GraphDistance measured = look.graph.from_side(side.side, points, side.points);
  if (!side.is_cut && !(measured.inside > 0)) {
    return {}; // nothing is passed on the way to the segment
  }
  const auto size = [&](const GraphDistance& d) {
    return side.is_cut ? std::max({d.above, d.below, d.outside / 4, d.inside / 4})
                       : look.side_total(d);
  };
  const double total = size(measured);
  const double enough = side.is_cut ? look.enough * kSideShare : std::max(look.enough, look.sides);
  bool close = total <= enough || depth == kDeepest || side.halvings == kMostSideHalvings;
  if (!close) {
    side.found = std::max(side.found, size(look.graph.from_side(side.side, points, 1)));
    close = total <= (side.is_cut ? kCloseEnough : kCloseToFound) * side.found;
  }
  if (close) {
    look.sides = std::max(look.sides, side.is_cut ? 0 : total);
    return measured;
  }
  ++side.halvings;
  halve_rows(points, piece(level + 1), side.points, kChannels, kChannels);
  GraphDistance most = bound_side(look, side, level + 1, depth + 1);
  most.include(bound_side(look, side, level, depth + 1));
  return most;
}

/// All sides of the cell in the first level's place, those that neighbours may cut before others.
void SpaceBound::bound_sides(const bool (&is_cut)[4], bool falling, Look& look) {
  const std::size_t row = columns_ * kChannels;
  const double* const net = piece(0);
  const double* const first[4] = {net, net + row - kChannels, net + (rows_ - 1) * row, net};
  for (const bool cut : {true, false}) {
    for (std::size_t k = 0; k < 4; ++k) { // at v = 0, u = 1, v = 1, u = 0
      if (is_cut[k] != cut) {
        continue;
      }
      const bool along_u = k % 2 == 0;
      SideLook side{(falling ? k + 3 : k) % 4, along_u ? columns_ : rows_, cut};
      for (std::size_t i = 0; i < side.points; ++i) {
        std::copy_n(first[k] + i * (along_u ? kChannels : row), kChannels,
                    piece(1) + i * kChannels);
      }
      const GraphDistance found = bound_side(look, side, 1, 1);
      if (cut) {
        look.cut.include(found);
      }
    }
    look.sides = std::max(look.sides, look.side_total(look.cut));
  }
}

/// The middle of the cell in the first level's place.
const double* SpaceBound::turned_middle() {
  const std::size_t row = columns_ * kChannels;
  std::copy_n(piece(0), net_.size(), piece(1));
  halve_rows(piece(1), piece(2), rows_, row, row);
  halve_rows(piece(1), piece(2), columns_, kChannels, kChannels);
  return piece(1);
}

/// The two triangles of a cell.
double SpaceBound::bound_triangles(std::uint32_t i, std::uint32_t j, const CellCounts& cells,
                                   bool falling, double enough, double stop) {
  const std::size_t row = columns_ * kChannels;
  const double* const net = cell_.data();
  const double* const around[4] = {net, net + row - kChannels, net + rows_ * row - kChannels,
                                   net + (rows_ - 1) * row};
  std::array<const double*, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] = around[(k + (falling ? 1 : 0)) % 4];
  }
  Look look{{}, enough, stop};
  double moved = 0;
  if (!look.graph.set(corners, doubt_)) {
    moved = join_corners(corners, enough * kSideShare);
    look.stop -= moved;
    if (moved == 0 || !look.graph.set(corners, doubt_)) {
      return kInfinity;
    }
  }
  for (std::size_t k = 0; k < net_.size(); k += kChannels) {
    look.graph.turn(net + k, piece(0) + k);
  }
  look.found = look.total(look.graph.of_hull(turned_middle(), 1));
  if (look.found > look.stop) {
    return kInfinity;
  }
  const auto is_cut = [&](PatchEdge side, bool at_end) {
    return at_end && (flags_ & kOpenSide << static_cast<unsigned>(side)) == 0;
  };
  bound_sides({is_cut(PatchEdge::v0, j == 0), is_cut(PatchEdge::u1, i + 1 == cells.nu),
               is_cut(PatchEdge::v1, j + 1 == cells.nv), is_cut(PatchEdge::u0, i == 0)},
              falling, look);
  return bound_piece(look, 0, 0) + moved;
}

/// How far no point is from a corner, which the surface and all triangles have in common.
double SpaceBound::radius() const {
  const double* const net = cell_.data();
  double most = 0;
  for (const double* point = net; point != net + net_.size(); point += kChannels) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double d = point[c] / point[3] - net[c] / net[3];
      square += d * d;
    }
    most = std::max(most, square);
  }
  return std::sqrt(most);
}

double SpaceBound::bound_cell(std::uint32_t i, std::uint32_t j, const CellCounts& cells,
                              bool falling, double enough, double stop) {
  bool ways[2] = {!falling, falling};
  if (has_forced_diagonal(flags_)) {
    bool forced[2] = {false, false};
    for (std::size_t corner = 0; corner < kPatchCorners; ++corner) {
      const bool here =
          i == (corner % 2 != 0 ? cells.nu - 1 : 0) && j == (corner >= 2 ? cells.nv - 1 : 0);
      forced[falls(corner) ? 1 : 0] |= here && is_forced_through(flags_, corner);
    }
    if (forced[0] || forced[1]) {
      std::copy_n(forced, 2, ways);
    }
  }
  if (radius_ <= enough) {
    return radius_;
  }
  double most = 0;
  for (unsigned way = 0; way < 2; ++way) {
    if (ways[way] && most <= stop) {
      most = std::max(most, bound_triangles(i, j, cells, way == 1, std::max(enough, doubt_), stop));
    }
  }
  return std::min(most, radius_);
}

double SpaceBound::bound_range(const Range& u, const Range& v, const CellCounts& cells,
                               bool falling, double enough, double stop,
                               std::array<double, 2>& miss) {
  double most = 0;
  double moved = 0;
  for (std::uint32_t j = v.begin; j < v.end; ++j) {
    take_row(j, cells.nv);
    for (std::uint32_t i = u.begin; i < u.end; ++i) {
      take_cell(i, cells.nu);
      const double least = std::max(enough, most);
      if (const double size = 2 * radius_; size <= least) { // wherever corners move in it
        most = std::max(most, size);
        looked_at_ += kSmallCell;
      } else {
        moved = larger_bound(moved, motion(i, j, cells, most * kLittleMotion));
        most = std::max(most, bound_cell(i, j, cells, falling, least, stop));
      }
      if (!(most + moved <= stop && looked_at_ <= most_looks_)) {
        miss = {(i + 0.5) / cells.nu, (j + 0.5) / cells.nv};
        return kInfinity;
      }
    }
  }
  return most + moved;
}

} // namespace simdbezier::detail
