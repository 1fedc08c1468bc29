// See group_bound.hpp.
#include "src/mesh/bounds/group_bound.hpp"

#include <algorithm>
#include <cmath>

#include "src/mesh/bounds/chord_distance.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/tables/net_table.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::detail {
namespace {

/// Roundings of a second difference and of what it is formed from, in units of the largest value.
constexpr double kDifferenceError = 64 * 0x1p-53;

/// More cells than about these are not looked at, since they would take far longer than their
/// vertices; nor chosen, unless others have so many times more.
constexpr double kMostLooked = 64;

} // namespace

// Both tables have the same bounds. A program that knows floats alone has one of them.
GroupBound::GroupBound(Isa isa) noexcept : kernels_(separate_table<NetTable<float>>(isa).bounds) {}

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
  const auto pays = [&] {
    if (usual.cells.product() < least) {
      return false;
    }
    if (!bends_[lane]) {
      bends_[lane].emplace(samples_, patch);
    }
    const double bound = usual.bound * patch.scale.inverse();
    const double fewest = bends_[lane]->fewest(bound);
    const double most =
        least > 0 ? std::max(kMostLooked, usual.cells.product() / kMostLooked) : kMostLooked;
    return fewest <= most && (fewest <= kWorthLooking * usual.cells.product() ||
                              bends_[lane]->at(usual.cells) <= kWorthLooking * bound);
  };
  const double spread = weight_spread(patch);
  if (!(spread < kMostSpread) || !(spread > kLeastSpread || pays())) {
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

} // namespace simdbezier::detail
