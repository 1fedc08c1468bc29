// See patch_bound.hpp.
#include "src/mesh/patch_bound.hpp"

#include <cmath>

#include "src/mesh/topology_data.hpp"

namespace simdbezier::detail {
namespace {

/// Parameters of samples are rounded, so that a step may be (1 + 4 n u) times as long as 1/n; and
/// everything else that rounds here.
double slack(std::uint32_t n) { return 1 + 4 * 0x1p-24 * n; }
constexpr double kRounding = 1 + 1e-12;

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

} // namespace

template <typename S>
bool PatchBound::read(const ControlNets<S>& nets, std::size_t patch, std::uint8_t flags) {
  flags_ = flags;
  if (!patch_.read(nets, patch)) {
    return false;
  }
  form_second_nets(patch_.net, nets_);
  measure(nets_, whole_);
  const double m = nets.degree_u;
  const double n = nets.degree_v;
  const double unit = kDifferenceError * patch_.largest;
  doubt_ = {m * (m - 1) * unit, m * n * unit, n * (n - 1) * unit};
  for (std::size_t k = 0; k < quarters_.size(); ++k) {
    Quarter& quarter = quarters_[k];
    quarter.raised = nets_;
    cut_all(quarter.raised, true, 0.5, k % 2 != 0);
    cut_all(quarter.raised, false, 0.5, k >= 2);
    measure(quarter.raised, quarter.largest);
    raise_all(quarter.raised, patch_.net);
  }
  return true;
}

template bool PatchBound::read(const ControlNets<float>&, std::size_t, std::uint8_t);
template bool PatchBound::read(const ControlNets<double>&, std::size_t, std::uint8_t);

void PatchBound::measure(const SecondNets& nets, SecondBounds& largest) const {
  const auto most = [&](const VectorNet& net) {
    double size = 0;
    for (const ControlVector& v : net.at) {
      size = std::max(size, patch_.size(v));
    }
    return size;
  };
  largest = {most(nets.uu), most(nets.uv), most(nets.vv)};
}

double PatchBound::largest_form(const SecondNets& raised, double uu, double uv, double vv) const {
  double size = 0;
  for (std::size_t k = 0; k < raised.uu.at.size(); ++k) {
    size = std::max(
        size, patch_.size(uu * raised.uu.at[k] + uv * raised.uv.at[k] + vv * raised.vv.at[k]));
  }
  return size;
}

double PatchBound::diagonal_bound(QuarterSet quarters, const CellCounts& cells,
                                  bool falling) const {
  const double hu = slack(cells.nu) / cells.nu;
  const double hv = slack(cells.nv) / cells.nv;
  const double uu = hu * hu;
  const double uv = 2 * hu * hv;
  const double vv = hv * hv;
  double a = 0;
  double c = 0;
  double d = 0;
  for (std::size_t k = 0; k < quarters_.size(); ++k) {
    if ((quarters >> k & 1) != 0) {
      a = std::max(a, quarters_[k].largest.uu);
      c = std::max(c, quarters_[k].largest.vv);
      d = std::max(d, largest_form(quarters_[k].raised, uu, falling ? -uv : uv, vv));
    }
  }
  return triangle_bound(uu * (a + doubt_.uu), vv * (c + doubt_.vv),
                        d + uu * doubt_.uu + uv * doubt_.uv + vv * doubt_.vv);
}

double PatchBound::corner_bound(std::size_t corner, const CellCounts& cells) const {
  const double hu = slack(cells.nu) / cells.nu;
  const double hv = slack(cells.nv) / cells.nv;
  SecondNets nets = nets_;
  if (cells.nu > 1) {
    cut_all(nets, true, corner % 2 != 0 ? 1 - hu : hu, corner % 2 != 0);
  }
  if (cells.nv > 1) {
    cut_all(nets, false, corner >= 2 ? 1 - hv : hv, corner >= 2);
  }
  SecondBounds largest;
  measure(nets, largest);
  raise_all(nets, patch_.net);
  const double uu = hu * hu;
  const double uv = 2 * hu * hv;
  const double vv = hv * hv;
  const double d = largest_form(nets, uu, falls(corner) ? -uv : uv, vv);
  return triangle_bound(uu * (largest.uu + doubt_.uu), vv * (largest.vv + doubt_.vv),
                        d + uu * doubt_.uu + uv * doubt_.uv + vv * doubt_.vv);
}

double PatchBound::bound(const CellCounts& cells, std::uint16_t* diagonals) const {
  constexpr QuarterSet kHalves[3] = {0b0101, 0b1010, kAll}; // of u, by Zone
  constexpr QuarterSet kRows[3] = {0b0011, 0b1100, kAll};   // of v
  const auto occurs = [](std::uint32_t n, std::size_t zone) {
    return zone == static_cast<std::size_t>(Zone::middle) ? n % 2 != 0 : n > 1;
  };
  double worst = 0;
  std::uint16_t falling = 0;
  for (std::size_t zone_v = 0; zone_v < 3; ++zone_v) {
    for (std::size_t zone_u = 0; zone_u < 3; ++zone_u) {
      if (!occurs(cells.nu, zone_u) || !occurs(cells.nv, zone_v)) {
        continue;
      }
      const QuarterSet quarters = kHalves[zone_u] & kRows[zone_v];
      const double rising_bound = diagonal_bound(quarters, cells, false);
      const double falling_bound = diagonal_bound(quarters, cells, true);
      if (!(rising_bound < falling_bound)) {
        falling = static_cast<std::uint16_t>(falling | 1U << (3 * zone_v + zone_u));
      }
      worst = std::max(worst, std::min(rising_bound, falling_bound));
    }
  }
  for (std::size_t corner = 0; corner < kPatchCorners; ++corner) {
    if ((flags_ >> corner & 1) != 0) {
      worst = std::max(worst, corner_bound(corner, cells));
    }
  }
  if (diagonals != nullptr) {
    *diagonals = falling;
  }
  return worst * kRounding / patch_.smallest_weight;
}

CellCounts PatchBound::filip(double t, std::uint32_t most) const {
  const double limit = 8 * t * patch_.smallest_weight / (kRounding * slack(most) * slack(most));
  const double a = whole_.uu + doubt_.uu;
  const double b = whole_.uv + doubt_.uv;
  const double c = whole_.vv + doubt_.vv;
  CellCounts best{most + 1, most + 1};
  const auto up = [&](double n) {
    return n > most ? most + 1 : std::max(1U, static_cast<std::uint32_t>(std::ceil(n)));
  };
  // With one rate given, the least other one with a/nu^2 + 2 b/(nu nv) + c/nv^2 <= limit.
  const auto other = [&](double first, double second, std::uint32_t n) {
    const double left = limit - first / (static_cast<double>(n) * n);
    const double mixed = b / n;
    return left > 0 ? up((mixed + std::sqrt(mixed * mixed + second * left)) / left * (1 + 1e-12))
                    : most + 1;
  };
  const auto least = [&](double first, double second) {
    const double n =
        std::sqrt(2 * (first + (second > 0 ? b * std::sqrt(first / second) : 0)) / limit);
    return n >= most ? most : std::max(1U, static_cast<std::uint32_t>(n));
  };
  const auto take = [&](const CellCounts& cells) {
    best = cells.product() < best.product() ? cells : best;
  };
  for (std::uint32_t step = 0; step < 2; ++step) {
    const std::uint32_t nu = std::min(most, least(a, c) + step);
    take({nu, other(a, c, nu)});
    const std::uint32_t nv = std::min(most, least(c, a) + step);
    take({other(c, a, nv), nv});
  }
  return best;
}

CellCounts PatchBound::choose(double t, std::uint32_t most) const {
  CellCounts best = filip(t, most);
  if (best.nu > most || best.nv > most) { // beyond Filip's bound ours may still hold
    best = {most, most};
    if (!(bound(best) <= t)) {
      return {most + 1, most + 1};
    }
  }
  if (best.product() == 1 && bound(best) <= t) {
    return best;
  }
  // Rates next to those for which the bound is in proportion with that of an even pair.
  const CellCounts even{std::max(2U, best.nu & ~1U), std::max(2U, best.nv & ~1U)};
  const double scale = std::min(1.0, std::sqrt(bound(even) / t));
  const auto centre_u = static_cast<std::int64_t>(even.nu * scale);
  const auto centre_v = static_cast<std::int64_t>(even.nv * scale);
  while (!(bound(best) <= t)) { // a corner's own diagonal, which Filip's bound holds for as well
    best.nu = std::min(most + 1, best.nu + 1);
    best.nv = std::min(most + 1, best.nv + 1);
    if (best.nu > most && best.nv > most) {
      return best;
    }
  }
  for (std::int64_t i = centre_u - 1; i <= centre_u + 2; ++i) {
    for (std::int64_t j = centre_v - 1; j <= centre_v + 2; ++j) {
      const auto clamp = [&](std::int64_t n) {
        return static_cast<std::uint32_t>(std::clamp<std::int64_t>(n, 1, most));
      };
      const CellCounts cells{clamp(i), clamp(j)};
      const bool fewer = cells.product() < best.product() ||
                         (cells.product() == best.product() && cells.nu < best.nu);
      if (fewer && bound(cells) <= t) {
        best = cells;
      }
    }
  }
  return best;
}

std::array<double, 2> PatchBound::lengths() const {
  std::array<double, 2> longest{};
  for (std::size_t j = 0; j < patch_.net.rows; ++j) {
    for (std::size_t i = 0; i < patch_.net.columns; ++i) {
      const ControlVector& at = patch_.net(i, j);
      if (i > 0) {
        longest[0] = std::max(longest[0], patch_.size(at - patch_.net(i - 1, j)));
      }
      if (j > 0) {
        longest[1] = std::max(longest[1], patch_.size(at - patch_.net(i, j - 1)));
      }
    }
  }
  longest[0] *= static_cast<double>(patch_.net.columns - 1) / patch_.smallest_weight;
  longest[1] *= static_cast<double>(patch_.net.rows - 1) / patch_.smallest_weight;
  return longest;
}

} // namespace simdbezier::detail
