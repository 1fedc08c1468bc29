// The checks with which every grid call begins.
#pragma once

#include <cstddef>

#include <simdbezier/evaluate.hpp>

namespace simdbezier::detail {

/// The instruction set and the patches of a call.
struct GridRequest {
  Isa isa = Isa::automatic;
  std::size_t first_patch = 0;
  std::size_t patches = 0;
};

/// ok | unknown_isa | unsupported_isa | bad_patch_range
inline Status resolve_request(std::size_t set_size, const Options& options,
                              GridRequest& request) noexcept {
  const Status resolved = resolve_isa(options.isa, request.isa);
  if (resolved != Status::ok) {
    return resolved;
  }
  if (options.first_patch > set_size) {
    return Status::bad_patch_range;
  }
  const std::size_t rest = set_size - options.first_patch;
  constexpr auto kAll = static_cast<std::size_t>(-1);
  request.first_patch = options.first_patch;
  request.patches = options.patch_count == kAll ? rest : options.patch_count;
  return request.patches > rest ? Status::bad_patch_range : Status::ok;
}

} // namespace simdbezier::detail
