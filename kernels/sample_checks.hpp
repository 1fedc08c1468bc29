// The check with which every call for scattered samples begins.
#pragma once

#include <simdbezier/evaluate.hpp>

#include "kernels/kernel_table.hpp"

namespace simdbezier::detail {

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

} // namespace simdbezier::detail
