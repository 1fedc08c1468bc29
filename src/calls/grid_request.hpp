// The checks with which every grid call begins.
#pragma once

#include <algorithm>
#include <cstddef>

#include <simdbezier/evaluate.hpp>

namespace simdbezier::detail {

/// The components that a call evaluates.
struct Components {
  std::size_t first = 0;
  std::size_t dimension = 3; ///< how many, at most three
  bool space = true;         ///< all three of points in space

  /// False where there is no such component.
  [[nodiscard]] bool choose(int of_set, int first_component) noexcept {
    if (first_component < 0 || first_component >= of_set) {
      return false;
    }
    first = static_cast<std::size_t>(first_component);
    dimension = std::min<std::size_t>(static_cast<std::size_t>(of_set) - first, 3);
    space = of_set == 3 && first == 0;
    return true;
  }
};

/// The instruction set, the patches and the components of a call.
struct GridRequest {
  Isa isa = Isa::automatic;
  std::size_t first_patch = 0;
  std::size_t patches = 0;
  Components components;

  /// Of nu x nv samples a patch; false where there are more than can be counted.
  [[nodiscard]] bool count_samples(std::size_t nu, std::size_t nv,
                                   std::size_t& samples) const noexcept {
    return !__builtin_mul_overflow(nu, nv, &samples) &&
           !__builtin_mul_overflow(samples, patches, &samples);
  }
};

/// Of a set of `size` patches or curves. Returns ok | unknown_isa | unsupported_isa |
/// bad_patch_range
inline Status resolve_request(std::size_t size, const Options& options,
                              GridRequest& request) noexcept {
  const Status resolved = resolve_isa(options.isa, request.isa);
  if (resolved != Status::ok) {
    return resolved;
  }
  if (options.first_patch > size) {
    return Status::bad_patch_range;
  }
  const std::size_t rest = size - options.first_patch;
  constexpr auto kAll = static_cast<std::size_t>(-1);
  request.first_patch = options.first_patch;
  request.patches = options.patch_count == kAll ? rest : options.patch_count;
  return request.patches > rest ? Status::bad_patch_range : Status::ok;
}

/// As above, of a set of patches or curves, and the components; bad_components where it has no such
/// one.
template <typename Set>
Status resolve_request(const Set& set, const Options& options, GridRequest& request) noexcept {
  const Status resolved = resolve_request(set.size(), options, request);
  if (resolved != Status::ok) {
    return resolved;
  }
  return request.components.choose(set.components(), options.first_component)
             ? Status::ok
             : Status::bad_components;
}

} // namespace simdbezier::detail
