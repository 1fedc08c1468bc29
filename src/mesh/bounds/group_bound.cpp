#include "src/mesh/bounds/group_bound.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/mesh/bounds/chord_distance.hpp"
#include "src/mesh/net_points.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/tables/net_table.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::detail {
namespace {

/// Roundings of a second difference and of what it is formed from, in units of the largest value.
constexpr double kDifferenceError = 64 * 0x1p-53;

/// More cells than about these are not looked at, since they would take far longer than their
/// vertices; nor chosen, unless others have far more.
constexpr double kMostLooked = 64;
constexpr double kMostThoroughlyLooked = 1024;
constexpr double kFarMore = 64;

/// The angle of (x, y), where y is not below 0, to a few units in the last place: atan2() may have
/// another last bit in another C library, and rates would depend on it.
double angle_of(double x, double y) {
  const double most = std::max(std::fabs(x), y);
  const bool steep = y >= std::fabs(x); // counted from the y axis
  double t = most > 0 ? (steep ? x : y) / most : 0;
  for (int halving = 0; halving < 2; ++halving) {
    t /= 1 + std::sqrt(1 + t * t);
  }
  double series = 0; // of the arctangent; |t| is at most tan(pi / 16)
  for (int k = 21; k > 0; k -= 2) {
    series = 1.0 / k - t * t * series;
  }
  const double angle = 4 * t * series;
  return !(most > 0) ? 0
         : steep     ? std::numbers::pi / 2 - angle
         : x < 0     ? std::numbers::pi - angle
                     : angle;
}

/// Angles between vectors that follow each other; those without a direction are passed over.
class TurnSum {
public:
  void add(const Point3& next) {
    if (!(dot(next, next) > 0)) {
      return;
    }
    const Point3 n = cross(last_, next);
    sum_ += angle_of(dot(last_, next), std::sqrt(dot(n, n)));
    last_ = next;
  }
  [[nodiscard]] double sum() const { return sum_; }

private:
  Point3 last_{};
  double sum_ = 0;
};

} // namespace

// Both tables have the same bounds. A program that knows floats alone has one of them.
GroupBound::GroupBound(Isa isa, bool thorough) noexcept
    : kernels_(separate_table<NetTable<float>>(isa).bounds), thorough_(thorough) {}

template <typename S>
bool GroupBound::read(const ControlNets<S>& nets, std::size_t patch, RateFlags flags) {
  const std::size_t lane = count_++;
  flags_[lane] = flags;
  const bool readable = patches_[lane].read(nets, patch);
  if (!readable) { // the search ends soon for a point
    patches_[lane].shrink_to_point();
  }
  return readable;
}
template bool GroupBound::read(const ControlNets<float>&, std::size_t, RateFlags);
template bool GroupBound::read(const ControlNets<double>&, std::size_t, RateFlags);

void GroupBound::form() {
  const VectorPatch& first = patches_[0];
  const std::size_t vectors = first.net.at.size();
  const std::size_t components = first.rational ? 4 : 3;
  const std::size_t values = kBoundNets * vectors * components + kBoundValues;
  memory_.resize((values * kernels_.lanes + kMostBoundLanes - 1) / kMostBoundLanes);
  group_.columns = first.net.columns;
  group_.rows = first.net.rows;
  group_.rational = first.rational;
  group_.memory = memory_.data()->at;
  const double m = static_cast<double>(group_.columns - 1);
  const double n = static_cast<double>(group_.rows - 1);
  for (std::size_t lane = 0; lane < kernels_.lanes; ++lane) {
    const VectorPatch& patch = patches_[std::min(lane, count_ - 1)]; // no lane is empty
    double* to = group_.memory + lane;
    for (const ControlVector& v : patch.net.at) {
      for (std::size_t c = 0; c < components; ++c, to += kernels_.lanes) {
        *to = v.x[c];
      }
    }
    const double unit = kDifferenceError * patch.largest;
    group_.doubt.uu[lane] = m * (m - 1) * unit;
    group_.doubt.uv[lane] = m * n * unit;
    group_.doubt.vv[lane] = n * (n - 1) * unit;
  }
  for (std::size_t lane = 0; lane < count_; ++lane) {
    separable_[lane] = bound_separable(patches_[lane]);
    bends_[lane].reset();
    spaces_[lane].reset();
  }
  if (!samples_.suits(first.net)) {
    samples_ = BendSamples(first.net.columns, first.net.rows);
  }
  kernels_.form(group_, whole_);
}

LaneSegments GroupBound::segments_of(const Lanes<CellCounts>& cells) const {
  LaneSegments segments;
  for (std::size_t lane = 0; lane < kernels_.lanes; ++lane) {
    segments.nu[lane] = cells[lane].nu;
    segments.nv[lane] = cells[lane].nv;
  }
  return segments;
}

void GroupBound::include_corners(LaneSet lanes, const LaneSegments& segments,
                                 CellBounds& bounds) const {
  for (std::size_t corner = 0; corner < kPatchCorners; ++corner) {
    LaneSet forced = 0;
    for (std::size_t lane = 0; lane < count_; ++lane) {
      forced |= is_forced_through(flags_[lane], corner) ? 1U << lane : 0;
    }
    if ((forced & lanes) == 0) {
      continue;
    }
    LaneValues found;
    kernels_.corner(group_, segments, corner, falls(corner), found);
    for (std::size_t lane = 0; lane < count_; ++lane) {
      if ((forced >> lane & 1) != 0) {
        bounds.bound[lane] = larger_bound(bounds.bound[lane], found[lane]);
      }
    }
  }
}

SpaceBound* GroupBound::space_of(std::size_t lane, const CertifiedCells& usual,
                                 double least) const {
  const VectorPatch& patch = patches_[lane];
  const double count = usual.cells.product();
  const double spread = weight_spread(patch);
  const bool is_far = spread > kLeastSpread; // nothing tells whether it pays
  if (!(spread < kMostSpread) || !(is_far || count >= least)) {
    return nullptr;
  }
  if (!bends_[lane]) {
    bends_[lane].emplace(samples_, patch);
  }
  const NormalBends& bends = *bends_[lane];
  const auto pays = [&] {
    const double bound = usual.bound * patch.scale.inverse();
    const double fewest = bends.fewest(bound);
    const double worth = thorough_ ? kThoroughlyWorthLooking : kWorthLooking;
    const double most = thorough_ ? kMostThoroughlyLooked : kMostLooked;
    return fewest <= std::max(most, least > 0 ? count / kFarMore : 0) &&
           (fewest <= worth * count ||
            bends.at(1.0 / usual.cells.nu, 1.0 / usual.cells.nv) <= worth * bound);
  };
  if (!is_far && !pays()) {
    return nullptr;
  }
  if (spaces_[lane] == nullptr) {
    spaces_[lane] = std::make_unique<SpaceBound>(patch, flags_[lane]);
  }
  return spaces_[lane].get();
}

CertifiedCells GroupBound::smaller_as_sets(std::size_t lane, const CertifiedCells& certified,
                                           bool may_fall, double enough) const {
  CertifiedCells least = certified;
  SpaceBound* const space = certified.bound <= enough ? nullptr : space_of(lane, certified);
  if (space == nullptr) {
    return certified;
  }
  take_if_close(lane, space->certify(certified.cells, in_patch(lane, certified.bound), 0, may_fall),
                least);
  return least;
}

GroupBound::Lanes<CertifiedCells> GroupBound::certify(const Lanes<CellCounts>& cells,
                                                      const Lanes<double>& enough) const {
  const LaneSegments segments = segments_of(cells);
  CellBounds bounds;
  kernels_.bound(group_, segments, kAllZones, bounds);
  include_corners(all_lanes(), segments, bounds);
  Lanes<CertifiedCells> certified;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    certified[lane] =
        smaller_as_sets(lane,
                        {cells[lane], smaller_in_space(lane, cells[lane], bounds.bound[lane]),
                         static_cast<std::uint16_t>(bounds.falling[lane])},
                        true, enough[lane]);
  }
  return certified;
}

GroupBound::Lanes<double> GroupBound::rising_bounds(const CellCounts& cells) const {
  Lanes<CellCounts> all;
  all.fill(cells);
  CellBounds bounds;
  kernels_.bound(group_, segments_of(all), kAllZones, bounds);
  Lanes<double> rising{};
  for (std::size_t lane = 0; lane < count_; ++lane) {
    const CertifiedCells usual{cells, smaller_in_space(lane, cells, bounds.rising[lane]), 0};
    rising[lane] = smaller_as_sets(lane, usual, false, 0).bound;
  }
  return rising;
}

std::array<double, 2> GroupBound::lengths(std::size_t lane) const {
  const VectorPatch& patch = patches_[lane];
  const VectorNet& net = patch.net;
  const LaneHulls& hull = whole_.hull;
  const auto size = [&](const ControlVector& v) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double along = v.x[c] - hull.middle[c][lane] * v.x[3];
      square += along * along;
    }
    return std::sqrt(square) + hull.radius[lane] * std::fabs(v.x[3]);
  };
  std::array<double, 2> longest{};
  for (std::size_t j = 0; j < net.rows; ++j) {
    for (std::size_t i = 0; i < net.columns; ++i) {
      const ControlVector& at = net(i, j);
      if (i > 0) {
        longest[0] = larger_bound(longest[0], size(at - net(i - 1, j)));
      }
      if (j > 0) {
        longest[1] = larger_bound(longest[1], size(at - net(i, j - 1)));
      }
    }
  }
  longest[0] *= static_cast<double>(net.columns - 1) / hull.smallest_weight[lane];
  longest[1] *= static_cast<double>(net.rows - 1) / hull.smallest_weight[lane];
  return {patch.in_space(longest[0]), patch.in_space(longest[1])};
}

// The cross products of a cell's sides are the normals that the surface would have at the cell's
// corners if each cell of the net were a bilinear patch. The angles between each normal and the
// next one are added up along rows, and along columns.
std::array<double, 2> GroupBound::normal_turns(std::size_t lane) const {
  const VectorPatch& patch = patches_[lane];
  const auto difference = [&](std::size_t i, std::size_t j, std::size_t to_i, std::size_t to_j) {
    const ControlVector& a = patch.net(i, j);
    const ControlVector& b = patch.net(to_i, to_j);
    Point3 d;
    for (std::size_t c = 0; c < 3; ++c) {
      d.x[c] = patch.rational ? b.x[c] / b.x[3] - a.x[c] / a.x[3] : b.x[c] - a.x[c];
    }
    return d;
  };
  const std::size_t sizes[2] = {patch.net.columns, patch.net.rows};
  std::array<double, 2> turns{};
  for (std::size_t along = 0; along < 2; ++along) {
    // (s, t): s along, t across; that normals of columns point the other way changes no angle.
    const auto leg = [&](std::size_t s, std::size_t t, std::size_t to_s, std::size_t to_t) {
      return along == 0 ? difference(s, t, to_s, to_t) : difference(t, s, to_t, to_s);
    };
    for (std::size_t t = 0; t + 1 < sizes[1 - along]; ++t) {
      for (const std::size_t row : {t, t + 1}) {
        TurnSum sum;
        for (std::size_t s = 0; s + 1 < sizes[along]; ++s) {
          const Point3 forward = leg(s, row, s + 1, row);
          sum.add(cross(forward, leg(s, t, s, t + 1)));
          sum.add(cross(forward, leg(s + 1, t, s + 1, t + 1)));
        }
        turns[along] = std::max(turns[along], sum.sum());
      }
    }
  }
  return turns;
}

} // namespace simdbezier::detail
