// See patch_bound.hpp.
#include "src/mesh/rates/patch_bound.hpp"

#include <cmath>
#include <limits>

#include "src/mesh/topology/topology_data.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/tables/net_table.hpp"

namespace simdbezier::detail {
namespace {

/// Zones of cells, as Zone numbers them: 3 * (of v) + (of u).
constexpr std::size_t kZoneCount = 9;

/// Whether cells have a zone.
bool occurs(const CellCounts& cells, std::size_t zone) {
  const auto has = [](std::uint32_t n, std::size_t which) {
    return which == static_cast<std::size_t>(Zone::middle) ? n % 2 != 0 : n > 1;
  };
  return has(cells.nu, zone % 3) && has(cells.nv, zone / 3);
}

/// The quarters that a zone's cells lie in.
unsigned quarters_of(std::size_t zone) {
  constexpr unsigned kHalves[3] = {0b0101, 0b1010, 0b1111}; // of u, by Zone
  constexpr unsigned kRows[3] = {0b0011, 0b1100, 0b1111};   // of v
  return kHalves[zone % 3] & kRows[zone / 3];
}

void cut_all(SecondNets& nets, bool in_u, double t, bool keep_high) {
  cut_net(nets.uu, in_u, t, keep_high);
  cut_net(nets.uv, in_u, t, keep_high);
  cut_net(nets.vv, in_u, t, keep_high);
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

double bound_of(const CellSteps& steps, const SecondBounds& largest, double diagonal,
                const SecondBounds& doubt, const Hull& hull) {
  const double bound =
      triangle_bound(steps.uu * (largest.uu + doubt.uu), steps.vv * (largest.vv + doubt.vv),
                     diagonal + steps.uu * doubt.uu + steps.uv * doubt.uv + steps.vv * doubt.vv);
  return larger_bound(0, bound / hull.smallest_weight);
}

} // namespace

/// One number of cells, as far as its zones have been looked at. Quarters of polynomial patches
/// have the same sizes in all zones.
class PatchBound::Look {
public:
  Look(const PatchBound& patch, const CellCounts& cells) : patch_(patch), steps_(cells) {}

  DiagonalBounds zone(std::size_t zone) {
    const QuarterSet quarters = quarters_of(zone);
    const Hull& hull = patch_.hull_of(quarters);
    DiagonalSizes largest;
    for (std::size_t k = 0; k < kPatchCorners; ++k) {
      if ((quarters >> k & 1) != 0) {
        const DiagonalSizes sizes = sizes_in(k, hull);
        largest.rising = larger_bound(largest.rising, sizes.rising);
        largest.falling = larger_bound(largest.falling, sizes.falling);
      }
    }
    return bounds(patch_.largest_[quarters], largest, hull);
  }

  DiagonalBounds bounds(const SecondBounds& largest, const DiagonalSizes& sizes,
                        const Hull& hull) const {
    return {bound_of(steps_, largest, sizes.rising, patch_.doubt_, hull),
            bound_of(steps_, largest, sizes.falling, patch_.doubt_, hull)};
  }
  [[nodiscard]] DiagonalSizes sizes(const RaisedPlanes& planes, const Hull& hull) const {
    return patch_.sizes_.diagonals(
        {planes.uu.list(), planes.uv.list(), planes.vv.list(), steps_.uu, steps_.uv, steps_.vv},
        hull, patch_.patch_.rational);
  }

private:
  DiagonalSizes sizes_in(std::size_t quarter, const Hull& hull) {
    if (patch_.patch_.rational) {
      return sizes(patch_.quarters_[quarter], hull);
    }
    if ((known_ >> quarter & 1) == 0) {
      known_ |= 1U << quarter;
      sizes_[quarter] = sizes(patch_.quarters_[quarter], hull);
    }
    return sizes_[quarter];
  }

  const PatchBound& patch_;
  CellSteps steps_;
  DiagonalSizes sizes_[4];
  QuarterSet known_ = 0;
};

PatchBound::PatchBound(Isa isa) noexcept : sizes_(kernel_table<double>(isa).nets->sizes) {}

double PatchBound::corner_bound(std::size_t corner, const CellCounts& cells) const {
  const Look look(*this, cells);
  SecondNets nets = nets_;
  const double hu = std::min(1.0, step_slack(cells.nu) / cells.nu);
  const double hv = std::min(1.0, step_slack(cells.nv) / cells.nv);
  cut_all(nets, true, corner % 2 != 0 ? 1 - hu : hu, corner % 2 != 0);
  cut_all(nets, false, corner >= 2 ? 1 - hv : hv, corner >= 2);
  const Hull& hull = hull_of(kAll);
  const bool rational = patch_.rational;
  RaisedPlanes planes;
  planes.uu.read(nets.uu);
  planes.vv.read(nets.vv);
  const SecondBounds largest{sizes_.largest(planes.uu.list(), hull, rational), 0,
                             sizes_.largest(planes.vv.list(), hull, rational)};
  raise_all(nets, patch_.net);
  planes.uu.read(nets.uu);
  planes.uv.read(nets.uv);
  planes.vv.read(nets.vv);
  const DiagonalBounds bounds = look.bounds(largest, look.sizes(planes, hull), hull);
  return falls(corner) ? bounds.falling : bounds.rising;
}

double PatchBound::in_space(double bound) const {
  const double scaled = bound * patch_.scale;
  return bound > 0 && scaled < std::numeric_limits<double>::min()
             ? std::nextafter(scaled, std::numeric_limits<double>::infinity())
             : scaled;
}

double PatchBound::rising_bound(const CellCounts& cells) const {
  Look look(*this, cells);
  double worst = 0;
  for (std::size_t zone = 0; zone < kZoneCount; ++zone) {
    if (occurs(cells, zone)) {
      worst = larger_bound(worst, look.zone(zone).rising);
    }
  }
  return in_space(worst * kRounding);
}

double PatchBound::bound(const CellCounts& cells, std::uint16_t* diagonals) const {
  Look look(*this, cells);
  double worst = 0;
  std::uint16_t falling = 0;
  for (std::size_t zone = 0; zone < kZoneCount; ++zone) {
    if (occurs(cells, zone)) {
      const DiagonalBounds bounds = look.zone(zone);
      if (!(bounds.rising < bounds.falling)) {
        falling = static_cast<std::uint16_t>(falling | 1U << zone);
      }
      worst = larger_bound(worst, std::min(bounds.rising, bounds.falling));
    }
  }
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

bool PatchBound::exceeds(const CellCounts& cells, double t, std::size_t& zone) const {
  Look look(*this, cells);
  const auto is_above = [&](std::size_t which) {
    const DiagonalBounds bounds = look.zone(which);
    const double bound = larger_bound(0, std::min(bounds.rising, bounds.falling));
    return !(in_space(bound * kRounding) <= t);
  };
  const std::size_t likely = zone;
  if (occurs(cells, likely) && is_above(likely)) {
    return true;
  }
  for (std::size_t k = 0; k < kZoneCount; ++k) {
    if (k != likely && occurs(cells, k) && is_above(k)) {
      zone = k;
      return true;
    }
  }
  for (std::size_t corner = 0; corner < kPatchCorners; ++corner) {
    if (is_forced_through(flags_, corner) &&
        !(in_space(corner_bound(corner, cells) * kRounding) <= t)) {
      return true;
    }
  }
  return false;
}

std::array<double, 2> PatchBound::lengths() const {
  std::array<double, 2> longest{};
  const Hull& hull = hulls_[kAll];
  const auto size = [&](const ControlVector& v) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double along = v.x[c] - hull.middle[c] * v.x[3];
      square += along * along;
    }
    return std::sqrt(square) + hull.radius * std::fabs(v.x[3]);
  };
  for (std::size_t j = 0; j < patch_.net.rows; ++j) {
    for (std::size_t i = 0; i < patch_.net.columns; ++i) {
      const ControlVector& at = patch_.net(i, j);
      if (i > 0) {
        longest[0] = larger_bound(longest[0], size(at - patch_.net(i - 1, j)));
      }
      if (j > 0) {
        longest[1] = larger_bound(longest[1], size(at - patch_.net(i, j - 1)));
      }
    }
  }
  longest[0] *= static_cast<double>(patch_.net.columns - 1) / hull.smallest_weight;
  longest[1] *= static_cast<double>(patch_.net.rows - 1) / hull.smallest_weight;
  longest = {in_space(longest[0]), in_space(longest[1])};
  return longest;
}

} // namespace simdbezier::detail
