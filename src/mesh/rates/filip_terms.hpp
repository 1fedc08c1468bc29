// Filip's form of a bound: coarser than others, but the fewest cells that keep it have a formula.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/mesh/bounds/bound_parts.hpp"

namespace simdbezier::detail {

/// A bound a / nu^2 + 2 b / (nu nv) + c / nv^2 that is not to be above a limit.
struct FilipTerms {
  double a;
  double b;
  double c;
  double limit;

  /// Some of the fewest cells; more than `most` in a direction where there are none.
  [[nodiscard]] CellCounts fewest(std::uint32_t most) const;
};

inline CellCounts FilipTerms::fewest(std::uint32_t most) const {
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
  const double share = b * kMixedShare;
  const auto least = [&](double along, double across) {
    const double first = std::max(along, share);
    const double second = std::max(across, share);
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
  if (best.nu > most) { // the best pairs have more segments than there may be
    take({most, other(a, c, most)});
    take({other(c, a, most), most});
  }
  return best;
}

} // namespace simdbezier::detail
