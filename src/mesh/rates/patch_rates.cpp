// See patch_bound.hpp: the fewest cells whose bound is at most a tolerance.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/mesh/rates/patch_bound.hpp"

namespace simdbezier::detail {

CellCounts PatchBound::filip(double tolerance, std::uint32_t most) const {
  // Derivatives are far below the largest limit: one cell keeps it, and no quotient overflows.
  constexpr double kLargestLimit = 1e30;
  const double t = std::scalbn(tolerance, -patch_.exponent);
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
  while (cells.nu <= most && cells.nv <= most && !(bound(cells) <= t)) {
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
  if (best.product() == 1 && bound(best) <= t) {
    return best;
  }
  // Rates near those that the bound of an even pair, in proportion to the tolerance, asks for.
  const CellCounts even{std::max(2U, best.nu & ~1U), std::max(2U, best.nv & ~1U)};
  const double scale = std::min(1.0, std::sqrt(bound(even) / t));
  const auto centre_u = static_cast<std::int64_t>(even.nu * scale);
  const auto centre_v = static_cast<std::int64_t>(even.nv * scale);
  best = raise(best, t, most); // a corner's own diagonal, which Filip's bound holds for as well
  if (best.nu > most) {
    return best;
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

} // namespace simdbezier::detail
