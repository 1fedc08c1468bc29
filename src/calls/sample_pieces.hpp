// How single samples, of patches or of curves, go to the kernels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <simdbezier/options.hpp>
#include <simdbezier/patch_set.hpp>

#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// Checks single samples: ok | null_input | bad_patch_index; there are as many parameters as
/// indices.
template <typename T>
[[nodiscard]] Status check_samples(std::span<const std::uint32_t> index, bool parameters,
                                   std::size_t set_size, const KernelTable<T>& table) noexcept {
  if (index.empty()) {
    return Status::ok;
  }
  if (index.data() == nullptr || !parameters) {
    return Status::null_input;
  }
  const std::uint32_t highest = table.highest_index(index.data(), index.size());
  return highest < set_size ? Status::ok : Status::bad_patch_index;
}

/// Checks the parameters and indices of samples of patches: ok | null_input | bad_patch_index.
template <typename T>
[[nodiscard]] Status check_samples(const PatchSet<T>& set, const Samples<T>& samples,
                                   const KernelTable<T>& table) noexcept {
  const bool parameters = samples.u.data() != nullptr && samples.v.data() != nullptr;
  return check_samples(samples.patch, parameters, set.size(), table);
}

template <typename T>
[[nodiscard]] bool lengths_differ(const Samples<T>& samples) noexcept {
  return samples.u.size() != samples.patch.size() || samples.v.size() != samples.patch.size();
}

/// Samples that a kernel evaluates at a time: where outputs are staged, few enough for the
/// first-level cache, otherwise so many that the time to prepare a task does not count.
struct SamplePieces {
  std::size_t length;
  std::size_t count;

  SamplePieces(std::size_t samples, bool staged) noexcept
      : length(staged ? 512 : 2048), count(samples / length + (samples % length != 0 ? 1 : 0)) {}
};

/// Half-centred parameters are (t - shift) * scale.
template <typename Task>
void set_half_centring(Parameters parameters, Task& task) noexcept {
  const bool unit = parameters == Parameters::unit;
  task.shift = unit ? 0.5F : 0.0F;
  task.scale = unit ? 1.0F : 0.5F;
}

} // namespace simdbezier::detail
