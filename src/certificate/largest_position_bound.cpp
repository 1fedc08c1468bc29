// See bounds.hpp.
#include <algorithm>
#include <limits>

#include <simdbezier/bounds.hpp>

#include "src/certificate/position_bounds.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"

namespace simdbezier {

template <typename T>
double largest_position_bound(const PatchSet<T>& set, Isa isa) noexcept {
  Isa chosen = Isa::automatic;
  if (resolve_isa(isa, chosen) != Status::ok) {
    return set.empty() ? 0 : std::numeric_limits<double>::infinity();
  }
  double largest = 0;
  detail::in_default_environment([&]() noexcept { // bounds may be denormal
    for (std::size_t patch = 0; patch < set.size();) {
      constexpr std::size_t kBlock = 32;
      detail::PositionBound bounds[kBlock];
      const std::size_t end = std::min(set.size(), patch + kBlock);
      detail::find_position_bounds(set, chosen, patch, end, bounds);
      for (const detail::PositionBound* at = bounds; patch < end; ++patch, ++at) {
        largest = std::max(largest, *std::max_element(at->begin(), at->begin() + set.components()));
      }
    }
  });
  return largest;
}

SIMDBEZIER_EXPORT_BOTH_TYPES(largest_position_bound);

} // namespace simdbezier
