// Filip's form of a bound: coarser than others, but the fewest cells that keep it have a formula.
#pragma once

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

} // namespace simdbezier::detail
