// See patch_bound.hpp.
#include "src/mesh/rates/patch_bound.hpp"

#include <cmath>
#include <limits>

#include "src/mesh/topology/topology_data.hpp"

namespace simdbezier::detail {
namespace {

/// Roundings of a second difference and of what it is formed from, in units of the largest value.
constexpr double kDifferenceError = 64 * 0x1p-53;

void cut_all(SecondNets& nets, bool in_u, double t, bool keep_high) {
  cut_net(nets.uu, in_u, t, keep_high);
  cut_net(nets.uv, in_u, t, keep_high);
  cut_net(nets.vv, in_u, t, keep_high);
}

void raise_all(SecondNets& nets, const VectorNet& like) {
  raise_net(nets.uu, like.columns, like.rows);
  raise_net(nets.uv, like.columns, like.rows);
  raise_net(nets.vv, like.columns, like.rows);
}

SecondBounds measure(const SecondNets& nets, const Hull& hull) {
  const auto most = [&](const VectorNet& net) {
    double size = 0;
    for (const ControlVector& v : net.at) {
      size = larger_bound(size, hull.size(v));
    }
    return size;
  };
  return {most(nets.uu), most(nets.uv), most(nets.vv)};
}

/// Factors of S_uu, S_uv and S_vv in the second derivative along a cell's diagonal, and of the
/// first and the last along its sides.
struct CellSteps {
  double uu;
  double uv;
  double vv;

  explicit CellSteps(const CellCounts& cells) {
    const double hu = step_slack(cells.nu) / cells.nu;
    const double hv = step_slack(cells.nv) / cells.nv;
    uu = hu * hu;
    uv = 2 * hu * hv;
    vv = hv * hv;
  }
};

/// The largest second derivative along a diagonal.
double measure_diagonal(const SecondNets& raised, const CellSteps& steps, bool falling,
                        const Hull& hull) {
  const double uv = falling ? -steps.uv : steps.uv;
  double size = 0;
  for (std::size_t k = 0; k < raised.uu.at.size(); ++k) {
    size = larger_bound(size, hull.size(steps.uu * raised.uu.at[k] + uv * raised.uv.at[k] +
                                        steps.vv * raised.vv.at[k]));
  }
  return size;
}

double bound_of(const CellSteps& steps, const SecondBounds& largest, double diagonal,
                const SecondBounds& doubt, const Hull& hull) {
  const double bound =
      triangle_bound(steps.uu * (largest.uu + doubt.uu), steps.vv * (largest.vv + doubt.vv),
                     diagonal + steps.uu * doubt.uu + steps.uv * doubt.uv + steps.vv * doubt.vv);
  return larger_bound(0, bound / hull.smallest_weight);
}

} // namespace

template <typename S>
bool PatchBound::read(const ControlNets<S>& nets, std::size_t patch, std::uint8_t flags) {
  flags_ = flags;
  if (!patch_.read(nets, patch)) {
    return false;
  }
  form_second_nets(patch_.net, nets_);
  find_hulls();
  largest_.fill({});
  for (std::size_t k = 0; k < raised_.size(); ++k) {
    SecondNets& quarter = raised_[k];
    quarter = nets_;
    cut_all(quarter, true, 0.5, k % 2 != 0);
    cut_all(quarter, false, 0.5, k >= 2);
    for (const QuarterSet set : kZones) {
      if ((set >> k & 1) != 0) {
        const SecondBounds part = measure(quarter, hull_of(set));
        largest_[set].uu = larger_bound(largest_[set].uu, part.uu);
        largest_[set].vv = larger_bound(largest_[set].vv, part.vv);
      }
    }
    raise_all(quarter, patch_.net);
  }
  whole_ = measure(nets_, hulls_[kAll]);
  const double m = nets.degree_u;
  const double n = nets.degree_v;
  const double unit = kDifferenceError * patch_.largest;
  doubt_ = {m * (m - 1) * unit, m * n * unit, n * (n - 1) * unit};
  return true;
}

template bool PatchBound::read(const ControlNets<float>&, std::size_t, std::uint8_t);
template bool PatchBound::read(const ControlNets<double>&, std::size_t, std::uint8_t);

/// Polynomial patches have no weights to be bounded, and no vector depends on their hull.
void PatchBound::find_hulls() {
  if (!patch_.rational) {
    hulls_[kAll] = Hull{};
    return;
  }
  HullBox boxes[4];
  for (std::size_t k = 0; k < 4; ++k) {
    VectorNet part = patch_.net;
    cut_net(part, true, 0.5, k % 2 != 0);
    cut_net(part, false, 0.5, k >= 2);
    boxes[k].include(part);
  }
  for (const QuarterSet set : kZones) {
    HullBox box;
    for (std::size_t k = 0; k < 4; ++k) {
      if ((set >> k & 1) != 0) {
        box.include(boxes[k]);
      }
    }
    hulls_[set] = box.hull();
  }
}

double PatchBound::zone_bound(QuarterSet quarters, const CellCounts& cells, bool falling) const {
  const CellSteps steps(cells);
  const Hull& hull = hull_of(quarters);
  double diagonal = 0;
  for (std::size_t k = 0; k < raised_.size(); ++k) {
    if ((quarters >> k & 1) != 0) {
      diagonal = larger_bound(diagonal, measure_diagonal(raised_[k], steps, falling, hull));
    }
  }
  return bound_of(steps, largest_[quarters], diagonal, doubt_, hull);
}

double PatchBound::corner_bound(std::size_t corner, const CellCounts& cells) const {
  const CellSteps steps(cells);
  SecondNets nets = nets_;
  const double hu = std::min(1.0, step_slack(cells.nu) / cells.nu);
  const double hv = std::min(1.0, step_slack(cells.nv) / cells.nv);
  cut_all(nets, true, corner % 2 != 0 ? 1 - hu : hu, corner % 2 != 0);
  cut_all(nets, false, corner >= 2 ? 1 - hv : hv, corner >= 2);
  const Hull& hull = hull_of(kAll);
  const SecondBounds largest = measure(nets, hull);
  raise_all(nets, patch_.net);
  return bound_of(steps, largest, measure_diagonal(nets, steps, falls(corner), hull), doubt_, hull);
}

template <typename Visit>
void PatchBound::for_zones(const CellCounts& cells, const Visit& visit) {
  constexpr QuarterSet kHalves[3] = {0b0101, 0b1010, kAll}; // of u, by Zone
  constexpr QuarterSet kRows[3] = {0b0011, 0b1100, kAll};   // of v
  const auto occurs = [](std::uint32_t n, std::size_t zone) {
    return zone == static_cast<std::size_t>(Zone::middle) ? n % 2 != 0 : n > 1;
  };
  for (std::size_t zone_v = 0; zone_v < 3; ++zone_v) {
    for (std::size_t zone_u = 0; zone_u < 3; ++zone_u) {
      if (occurs(cells.nu, zone_u) && occurs(cells.nv, zone_v)) {
        visit(kHalves[zone_u] & kRows[zone_v], 3 * zone_v + zone_u);
      }
    }
  }
}

double PatchBound::in_space(double bound) const {
  const double scaled = std::scalbn(bound, patch_.exponent);
  return bound > 0 && scaled < std::numeric_limits<double>::min()
             ? std::nextafter(scaled, std::numeric_limits<double>::infinity())
             : scaled;
}

double PatchBound::rising_bound(const CellCounts& cells) const {
  double worst = 0;
  for_zones(cells, [&](QuarterSet quarters, std::size_t) {
    worst = larger_bound(worst, zone_bound(quarters, cells, false));
  });
  return in_space(worst * kRounding);
}

double PatchBound::bound(const CellCounts& cells, std::uint16_t* diagonals) const {
  double worst = 0;
  std::uint16_t falling = 0;
  for_zones(cells, [&](QuarterSet quarters, std::size_t zone) {
    const double rising_bound = zone_bound(quarters, cells, false);
    const double falling_bound = zone_bound(quarters, cells, true);
    if (!(rising_bound < falling_bound)) {
      falling = static_cast<std::uint16_t>(falling | 1U << zone);
    }
    worst = larger_bound(worst, std::min(rising_bound, falling_bound));
  });
  for (std::size_t corner = 0; corner < kPatchCorners; ++corner) {
    if (is_forced_through(flags_, corner)) {
      worst = larger_bound(worst, corner_bound(corner, cells));
    }
  }
  if (diagonals != nullptr) {
    *diagonals = falling;
  }
  return in_space(worst * kRounding);
}

std::array<double, 2> PatchBound::lengths() const {
  const Hull& hull = hulls_[kAll];
  std::array<double, 2> longest{};
  for (std::size_t j = 0; j < patch_.net.rows; ++j) {
    for (std::size_t i = 0; i < patch_.net.columns; ++i) {
      const ControlVector& at = patch_.net(i, j);
      if (i > 0) {
        longest[0] = larger_bound(longest[0], hull.size(at - patch_.net(i - 1, j)));
      }
      if (j > 0) {
        longest[1] = larger_bound(longest[1], hull.size(at - patch_.net(i, j - 1)));
      }
    }
  }
  longest[0] *= static_cast<double>(patch_.net.columns - 1) / hull.smallest_weight;
  longest[1] *= static_cast<double>(patch_.net.rows - 1) / hull.smallest_weight;
  longest = {in_space(longest[0]), in_space(longest[1])};
  return longest;
}

} // namespace simdbezier::detail
