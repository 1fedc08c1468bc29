// With what calls for scattered samples begin: checks, and how samples go to the kernels.
#pragma once

#include "src/calls/grid_request.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// The instruction set and the components of a call.
struct SampleRequest {
  Isa isa = Isa::automatic;
  Components components;
};

/// Of a set of patches or curves. Returns ok | unknown_isa | unsupported_isa | bad_components
template <typename Set>
Status resolve_request(const Set& set, const Options& options, SampleRequest& request) noexcept {
  const Status resolved = resolve_isa(options.isa, request.isa);
  if (resolved != Status::ok) {
    return resolved;
  }
  return request.components.choose(set.components(), options.first_component)
             ? Status::ok
             : Status::bad_components;
}

/// Returns ok | null_input | bad_patch_index.
template <typename T>
Status check_samples(const PatchSet<T>& set, const Samples<T>& samples,
                     const KernelTable<T>& table) noexcept {
  if (samples.count == 0) {
    return Status::ok;
  }
  if (samples.patch == nullptr || samples.u == nullptr || samples.v == nullptr) {
    return Status::null_input;
  }
  const std::uint32_t highest = table.highest_index(samples.patch, samples.count);
  return highest < set.size() ? Status::ok : Status::bad_patch_index;
}

/// Samples that a kernel evaluates at a time. Fewer where it stages its outputs, which then stay in
/// the first-level cache; otherwise so many that preparing a task does not show.
struct SamplePieces {
  std::size_t length;
  std::size_t count;

  SamplePieces(std::size_t samples, bool staged) noexcept
      : length(staged ? 512 : 2048), count(samples / length + (samples % length != 0 ? 1 : 0)) {}
};

/// Results in samples' order seldom fill lines one after the other: past the caches on demand only.
constexpr Destination sample_destination(Destination wanted) noexcept {
  return wanted == Destination::memory ? Destination::memory : Destination::cache;
}

/// Half-centred parameters are (t - shift) * scale.
template <typename Task>
void set_half_centring(Parameters parameters, Task& task) noexcept {
  const bool unit = parameters == Parameters::unit;
  task.shift = unit ? 0.5F : 0.0F;
  task.scale = unit ? 1.0F : 0.5F;
}

} // namespace simdbezier::detail
