// See patch_bound.hpp: the fewest cells whose bound is at most a tolerance.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "src/mesh/rates/patch_bound.hpp"

namespace simdbezier::detail {

CellCounts PatchBound::filip(double tolerance, std::uint32_t most) const {
  // Derivatives are far below the largest limit: one cell keeps it, and no quotient overflows.
  constexpr double kLargestLimit = 1e30;
  const double t = tolerance * patch_.scale.inverse();
  const double limit =
      std::min(kLargestLimit, 8 * t * hulls_[kAll].smallest_weight /
                                  (kRounding * step_slack(most) * step_slack(most)));
  const double a = whole_.uu + doubt_.uu;
  const double b = whole_.uv + doubt_.uv;
  const double c = whole_.vv + doubt_.vv;
  CellCounts best{most + 1, most + 1};
  const auto up = [&](double n) {
    return n <= most ? std::max(1U, static_cast<std::uint32_t>(std::ceil(n))) : most + 1;
  };
  // The least other rate, with one rate given, for which a/nu^2 + 2 b/(nu nv) + c/nv^2 <= limit.
  const auto other = [&](double first, double second, std::uint32_t n) {
    const double left = limit - first / (static_cast<double>(n) * n);
    const double mixed = b / n;
    return left > 0 ? up((mixed + std::sqrt(mixed * mixed + second * left)) / left * (1 + 1e-12))
                    : most + 1;
  };
  const auto least = [&](double first, double second) {
    const double n =
        std::sqrt(2 * (first + (second > 0 ? b * std::sqrt(first / second) : 0)) / limit);
    return n < most ? std::max(1U, static_cast<std::uint32_t>(n)) : most;
  };
  const auto take = [&](const CellCounts& cells) {
    const bool fits = cells.nu <= most && cells.nv <= most;
    best = fits && cells.product() < best.product() ? cells : best;
  };
  for (std::uint32_t step = 0; step < 2; ++step) {
    const std::uint32_t nu = std::min(most, least(a, c) + step);
    take({nu, other(a, c, nu)});
    const std::uint32_t nv = std::min(most, least(c, a) + step);
    take({other(c, a, nv), nv});
  }
  if (best.nu > most) { // the best pairs are longer than may be
    take({most, other(a, c, most)});
    take({other(c, a, most), most});
  }
  return best;
}

CellCounts PatchBound::raise(CellCounts cells, double t, std::uint32_t most) const {
  std::size_t zone = 0;
  while (cells.nu <= most && cells.nv <= most && exceeds(cells, t, zone)) {
    if (cells.nu == most && cells.nv == most) {
      return {most + 1, most + 1};
    }
    cells = {std::min(most, cells.nu + 1), std::min(most, cells.nv + 1)};
  }
  return cells;
}

CellCounts PatchBound::choose(double t, std::uint32_t most) const {
  CellCounts best = filip(t, most);
  if (best.nu > most) { // beyond Filip's bound ours may still hold
    best = {most, most};
    if (!(bound(best) <= t)) {
      return {most + 1, most + 1};
    }
  }
  // Rates near those that the bound of an even pair, in proportion to the tolerance, asks for.
  const CellCounts even{std::max(2U, best.nu & ~1U), std::max(2U, best.nv & ~1U)};
  const double scale = std::min(1.0, std::sqrt(bound(even) / t));
  const auto near_centre = [&](std::uint32_t n, std::int64_t step) {
    const auto centre = static_cast<std::int64_t>(n * scale);
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(centre + step, 1, most));
  };
  CellCounts candidates[16];
  for (std::int64_t k = 0; k < 16; ++k) {
    candidates[k] = {near_centre(even.nu, k / 4 - 1), near_centre(even.nv, k % 4 - 1)};
  }
  const auto fewer = [](const CellCounts& a, const CellCounts& b) {
    return a.product() < b.product() || (a.product() == b.product() && a.nu < b.nu);
  };
  std::sort(std::begin(candidates), std::end(candidates), fewer);
  // The first that holds is the best one. Filip's rates are raised only where none of fewer cells
  // holds: they may not where a corner's diagonal is forced, which his bound does not know of.
  std::size_t zone = 0;
  bool raised = false;
  for (const CellCounts& cells : candidates) {
    if (!raised && !fewer(cells, best)) {
      best = raise(best, t, most);
      raised = true;
    }
    if (raised && (best.nu > most || !fewer(cells, best))) {
      return best;
    }
    if (!exceeds(cells, t, zone)) {
      return cells;
    }
  }
  return raised ? best : raise(best, t, most);
}

} // namespace simdbezier::detail
