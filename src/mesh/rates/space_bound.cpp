// See space_bound.hpp.
#include "src/mesh/rates/space_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/mesh/topology/topology_data.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kChannels = 4;

/// Halvings of sides at the patch's ends, whose bounds are to be the same for turned patches.
constexpr std::size_t kEndLevels = 4;

/// A vertex is off by so much of the parameter's range.
constexpr double kVertexRounding = kStepRounding / 2;

double binomial(std::size_t n, std::size_t k) {
  double product = 1;
  for (std::size_t i = 0; i < k; ++i) {
    product = product * static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  return product;
}

/// The quotient t / (1 - t) where a curve passes the middle between its ends; 0 where these are one
/// point. Points are `step` values apart.
double middle_of(const double* points, std::size_t count, std::size_t step) {
  const double* const last = points + (count - 1) * step;
  double ahead[kMostDegree + 1] = {}; // of the middle: a polynomial in the quotient
  for (std::size_t c = 0; c + 1 < kChannels; ++c) {
    const double from = points[c] / points[kChannels - 1];
    const double to = last[c] / last[kChannels - 1];
    for (std::size_t k = 0; k < count; ++k) {
      const double* const point = points + k * step;
      ahead[k] += (point[c] / point[kChannels - 1] - (from + to) / 2) * (to - from);
    }
  }
  if (!(ahead[0] < 0)) {
    return 0;
  }
  for (std::size_t k = 0; k < count; ++k) {
    ahead[k] *= binomial(count - 1, k) * points[k * step + kChannels - 1];
  }
  double low = 0x1p-60;
  double high = 0x1p60;
  for (int halvings = 0; halvings < 40; ++halvings) {
    const double middle = std::sqrt(low * high);
    double sum = 0;
    for (std::size_t k = count; k-- > 0;) {
      sum = sum * middle + ahead[k];
    }
    (sum < 0 ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

/// A mean of the two, without those that are 0.
double common(double a, double b) {
  return a == 0 && b == 0 ? 1 : a == 0 ? b : b == 0 ? a : std::sqrt(a * b);
}

} // namespace

bool has_spread_weights(const VectorPatch& patch) {
  if (!patch.rational) {
    return false;
  }
  double low = kInfinity;
  double high = 0;
  for (const ControlVector& v : patch.net.at) {
    low = std::min(low, v.x[3]);
    high = std::max(high, v.x[3]);
  }
  return high > kLeastSpread * low && high < kMostSpread * low;
}

SpaceBound::SpaceBound(const VectorPatch& patch, std::uint8_t flags)
    : columns_(patch.net.columns), rows_(patch.net.rows), flags_(flags),
      work_(static_cast<double>(columns_ * columns_ * rows_ * rows_)) {
  double heaviest = 0;
  for (const ControlVector& v : patch.net.at) {
    net_.insert(net_.end(), v.x, v.x + kChannels);
    heaviest = std::max(heaviest, v.x[3]);
  }
  doubt_ = kPointSetDoubt * patch.largest / heaviest;
  // The triangle of (0,0), (1,1) and (1,0), whose points take i, j and k of their arguments from
  // these: the patch's polar form has `a` of i, `b` of j and `c` of k in u, and the others in v.
  const std::size_t m = columns_ - 1;
  const std::size_t n = rows_ - 1;
  raised_.assign((m + n + 1) * (m + n + 2) / 2 * columns_ * rows_, 0);
  double* to = raised_.data();
  for (std::size_t k = 0; k <= m + n; ++k) {
    for (std::size_t j = 0; j + k <= m + n; ++j, to += columns_ * rows_) {
      const std::size_t i = m + n - j - k;
      for (std::size_t b = 0; b <= std::min(j, m); ++b) {
        for (std::size_t c = 0; c <= std::min(k, m - b); ++c) {
          const std::size_t a = m - b - c;
          if (a <= i) {
            to[(j - b) * columns_ + b + c] +=
                binomial(i, a) * binomial(j, b) * binomial(k, c) / binomial(m + n, m);
          }
        }
      }
    }
  }
}

void SpaceBound::take_row(std::uint32_t j, std::uint32_t nv) {
  strip_ = net_;
  for (std::size_t i = 0; i < columns_; ++i) {
    cut_curve(strip_.data() + i * kChannels, rows_, columns_ * kChannels, kChannels,
              static_cast<double>(j) / nv, static_cast<double>(j + 1) / nv);
  }
}

void SpaceBound::take_cell(std::uint32_t i, std::uint32_t nu) {
  cell_ = strip_;
  for (std::size_t j = 0; j < rows_; ++j) {
    cut_curve(cell_.data() + j * columns_ * kChannels, columns_, kChannels, kChannels,
              static_cast<double>(i) / nu, static_cast<double>(i + 1) / nu);
  }
}

/// Lets both directions of a cell run evenly, by weights that move no point of its surface: the
/// factors x^k of control points move parameters alone. Halves of a cell are compared with
/// triangles where they are close to them, then.
void SpaceBound::even_out() {
  const std::size_t row = columns_ * kChannels;
  const double* const cell = cell_.data();
  const double x[2] = {
      common(middle_of(cell, columns_, kChannels),
             middle_of(cell + (rows_ - 1) * row, columns_, kChannels)),
      common(middle_of(cell, rows_, row), middle_of(cell + row - kChannels, rows_, row))};
  double across = 1;
  for (std::size_t j = 0; j < rows_; ++j, across *= x[1]) {
    double factor = across;
    for (std::size_t i = 0; i < columns_; ++i, factor *= x[0]) {
      for (std::size_t c = 0; c < kChannels; ++c) {
        cell_[j * row + i * kChannels + c] *= factor;
      }
    }
  }
}

/// How far roundings of parameters move the cell's corners into it.
double SpaceBound::motion(std::uint32_t i, std::uint32_t j, const CellCounts& cells) const {
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

/// Takes the triangle of a cell with the corners (0,0), (1,1) and (1,0), where u (flip 1) and v
/// (flip 2) are counted from the other end.
void SpaceBound::take_half(unsigned flip, SimplexNet& half) const {
  const bool flip_u = (flip & 1) != 0;
  const bool flip_v = (flip & 2) != 0;
  half.resize(columns_ + rows_ - 2, kChannels - 1, true);
  const double* factor = raised_.data();
  for (double* to = half.at.data(); to != half.at.data() + half.at.size(); to += kChannels) {
    std::fill_n(to, kChannels, 0.0);
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column, ++factor) {
        const double* const from = cell_.data() + ((flip_v ? rows_ - 1 - row : row) * columns_ +
                                                   (flip_u ? columns_ - 1 - column : column)) *
                                                      kChannels;
        for (std::size_t c = 0; c < kChannels; ++c) {
          to[c] += *factor * from[c];
        }
      }
    }
  }
}

/// A side of a triangle: 0 and 1 along u and v, 2 the diagonal.
void SpaceBound::take_side(const SimplexNet& half, std::size_t side) {
  const std::size_t degree = half.degree;
  side_.resize(degree, kChannels - 1, false);
  for (std::size_t k = 0; k <= degree; ++k) {
    const double* const from = side == 2   ? half.point(0, k)
                               : side == 0 ? half.point(k, 0)
                                           : half.point(k, degree - k);
    std::copy_n(from, kChannels, side_.point(0, k));
  }
}

/// The two triangles of a cell.
double SpaceBound::bound_halves(std::uint32_t i, std::uint32_t j, const CellCounts& cells,
                                bool falling, double enough, double stop) {
  const unsigned flips[2] = {falling ? 1U : 0U, falling ? 2U : 3U};
  double leg[2] = {kInfinity, kInfinity}; // the shorter one of each triangle
  double sides = 0;
  double cut = 0; // what vertices of neighbours may be off
  for (std::size_t k = 0; k < 2; ++k) {
    take_half(flips[k], halves_[k]);
    const bool flip_u = (flips[k] & 1) != 0;
    const bool flip_v = (flips[k] & 2) != 0;
    const bool at_end[2] = {flip_v ? j + 1 == cells.nv : j == 0,
                            flip_u ? i == 0 : i + 1 == cells.nu};
    for (std::size_t side = 0; side < 2; ++side) {
      take_side(halves_[k], side);
      const FlatSimplex segment(side_);
      leg[k] = std::min(leg[k], segment.length());
      const double found = at_end[side]
                               ? distance_.bound(side_, segment, doubt_, kInfinity, kEndLevels)
                               : distance_.bound(side_, segment, enough, stop);
      sides = std::max(sides, found);
      cut = at_end[side] ? std::max(cut, found) : cut;
    }
  }
  if (!(sides + cut <= stop)) {
    return kInfinity;
  }
  const FlatSimplex triangles[2] = {FlatSimplex(halves_[0]), FlatSimplex(halves_[1])};
  const auto both = [&](std::size_t first, std::size_t second, double least, double limit) {
    double most = least;
    for (std::size_t k = 0; k < 2 && most + cut <= limit; ++k) {
      most = std::max(most, distance_.bound(halves_[k], triangles[k == 0 ? first : second],
                                            std::max(enough - cut, doubt_), limit - cut));
    }
    return most + cut <= limit ? most + cut : kInfinity;
  };
  take_side(halves_[0], 2);
  double least =
      both(0, 1, std::max(sides, distance_.bound(side_, FlatSimplex(side_), enough, stop)), stop);
  for (std::size_t k = 0; k < 2; ++k) { // a triangle that is nearly a side of the other one
    const double limit = std::min(stop, least);
    if (sides + leg[k] + cut < limit) {
      least = std::min(least, both(1 - k, 1 - k, sides + leg[k], limit));
    }
  }
  return least;
}

double SpaceBound::bound_cell(std::uint32_t i, std::uint32_t j, const CellCounts& cells,
                              bool falling, double enough, double stop) {
  ++looked_at_;
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
  double most = 0;
  for (unsigned way = 0; way < 2; ++way) {
    if (ways[way] && most <= stop) {
      most = std::max(most, bound_halves(i, j, cells, way == 1, std::max(enough, doubt_), stop));
    }
  }
  return most;
}

double SpaceBound::bound_range(const Range& u, const Range& v, const CellCounts& cells,
                               bool falling, double enough, double stop) {
  double most = 0;
  double moved = 0;
  for (std::uint32_t j = v.begin; j < v.end; ++j) {
    take_row(j, cells.nv);
    for (std::uint32_t i = u.begin; i < u.end; ++i) {
      take_cell(i, cells.nu);
      moved = std::max(moved, motion(i, j, cells));
      even_out();
      most = std::max(most, bound_cell(i, j, cells, falling, std::max(enough, most), stop));
      if (!(most + moved <= stop)) {
        misses_[falling ? 1 : 0] = {(i + 0.5) / cells.nu, (j + 0.5) / cells.nv};
        return kInfinity;
      }
    }
  }
  return most + moved;
}

} // namespace simdbezier::detail
