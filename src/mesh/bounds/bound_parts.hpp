// What bounds on cells and on polylines have in common; docs/tessellation.md has the proofs.
#pragma once

#include <cstdint>
#include <limits>

#include "src/tables/rate_task.hpp"

namespace simdbezier::detail {

/// The larger of two bounds; infinity where one of them is no number, because comparisons with nan
/// would pass it over.
inline double larger_bound(double a, double b) {
  return b <= a ? a : b > a ? b : std::numeric_limits<double>::infinity();
}

/// Parameters of samples are rounded: one of n steps may be longer than 1/n by this factor.
inline double step_slack(double n) { return 1 + kStepRounding * n; }

/// What vertices that are off by `error` leave of a tolerance: less one rounding, so that bound and
/// error together stay below what was wanted.
inline double tolerance_less(double wanted, double error) { return wanted * (1 - 0x1p-51) - error; }

/// Segments in u and v.
struct CellCounts {
  std::uint32_t nu;
  std::uint32_t nv;

  [[nodiscard]] double product() const { return static_cast<double>(nu) * nv; }
};

/// What a topology says of a patch: PatchFlag, and which sides belong to no other one, so that no
/// neighbour has vertices on them: 256 << PatchEdge.
using RateFlags = std::uint16_t;
inline constexpr RateFlags kOpenSide = 256;
inline constexpr RateFlags kAllOpen = 15 * kOpenSide;

/// Cells, how far their triangles are from the patch at most, and the diagonals for which that
/// holds.
struct CertifiedCells {
  CellCounts cells;
  double bound;
  std::uint16_t diagonals;
};
inline CertifiedCells uncertified(const CellCounts& cells) {
  return {cells, std::numeric_limits<double>::infinity(), 0};
}

} // namespace simdbezier::detail
