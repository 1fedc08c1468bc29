// The ways in which large calls write to memory; src/choice/measured_call.hpp chooses one of them.
#pragma once

#include <cstdint>

#include <simdbezier/options.hpp>

namespace simdbezier::detail {

/// How outputs get to the caller's memory. What is streamed and cannot be written directly fills
/// staging memory first. A large part of the second-level cache holds many patches, whose kernels
/// run as if they wrote to a cache. But where streaming stores and misses of the first-level cache
/// have buffers in common, both are faster if staging stays in that cache. Kernels that put rows
/// together to whole lines themselves need no copies, but take more arithmetic: that costs nothing
/// as long as memory is the limit, and much beside others who use the same core.
enum class Way : std::uint8_t {
  undecided,
  cache,       ///< by plain stores
  memory,      ///< by streaming stores, of kernels or else from staging in the second-level cache
  memory_other ///< likewise, from staging: in the second-level cache where kernels would turn rows
               ///< to lines, otherwise in the first-level one
};

/// The way of calls on single samples, which measure nothing: results in the order of samples
/// seldom fill whole lines, so that they bypass caches on demand only.
constexpr Way way_of_samples(Destination destination) noexcept {
  return destination == Destination::memory ? Way::memory : Way::cache;
}

} // namespace simdbezier::detail
