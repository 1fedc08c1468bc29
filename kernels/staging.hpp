// Outputs as kernels see them: planes with unit stride. Groups with another stride are computed
// into a thread's own planes first and copied from there.
#pragma once

#include <cstddef>
#include <limits>

#include <simdbezier/evaluate.hpp>

#include "kernels/kernel_table.hpp"

namespace simdbezier::detail {

/// The vector groups of an Outputs, by Group.
template <typename T>
struct OutputGroups {
  const Vectors<T>* group[kGroups];
  explicit OutputGroups(const Outputs<T>& out) noexcept
      : group{&out.position, &out.du,  &out.dv,    &out.duu,
              &out.duv,      &out.dvv, &out.normal} {}
  [[nodiscard]] const Vectors<T>* const* begin() const noexcept { return group; }
  [[nodiscard]] const Vectors<T>* const* end() const noexcept { return group + kGroups; }
};

template <typename T>
class Staging {
public:
  /// plane_samples: how many samples one staged piece holds at the most.
  Staging(const Outputs<T>& out, std::size_t plane_samples) noexcept
      : group_(out), plane_samples_(plane_samples) {}

  [[nodiscard]] bool staged() const noexcept {
    for (const Vectors<T>* group : group_) {
      if (is_staged(*group)) {
        return true;
      }
    }
    return false;
  }

  /// T values of scratch that one thread needs.
  [[nodiscard]] std::size_t scratch_size() const noexcept {
    std::size_t groups = 0;
    for (const Vectors<T>* group : group_) {
      groups += is_staged(*group) ? 1 : 0;
    }
    return groups * 3 * plane_samples_;
  }

  /// Points a task at the samples that begin at `first`.
  template <typename Task>
  void bind(Task& task, std::size_t first, T* scratch) const noexcept {
    for (std::size_t g = 0; g < kGroups; ++g) {
      const Vectors<T>& group = *group_.group[g];
      T* const caller[3] = {group.x, group.y, group.z};
      for (std::size_t c = 0; c < 3; ++c) {
        if (is_staged(group)) {
          task.out[g].component[c] = scratch;
          scratch += plane_samples_;
        } else if (group.wanted()) {
          task.out[g].component[c] = caller[c] + first;
        }
      }
    }
  }

  /// Copies `count` staged samples to the caller's places.
  void flush(std::size_t first, std::size_t count, const T* scratch) const noexcept {
    for (const Vectors<T>* group : group_) {
      if (!is_staged(*group)) {
        continue;
      }
      for (std::size_t k = 0; k < count; ++k) {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(first + k) * group->stride;
        group->x[at] = scratch[k];
        group->y[at] = scratch[k + plane_samples_];
        group->z[at] = scratch[k + 2 * plane_samples_];
      }
      scratch += 3 * plane_samples_;
    }
  }

private:
  static bool is_staged(const Vectors<T>& group) noexcept {
    return group.wanted() && group.stride != 1;
  }

  OutputGroups<T> group_;
  std::size_t plane_samples_;
};

/// ok | null_output | bad_stride | size_overflow, for `samples` samples.
template <typename T>
[[nodiscard]] Status check_outputs(const Outputs<T>& out, std::size_t samples) noexcept {
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(T);
  bool any = false;
  for (const Vectors<T>* group : OutputGroups<T>(out)) {
    if (!group->wanted()) {
      continue;
    }
    any = true;
    if (group->x == nullptr || group->y == nullptr || group->z == nullptr) {
      return Status::null_output;
    }
    const bool triples = group->y == group->x + 1 && group->z == group->x + 2;
    if (group->stride == 0 || (samples > 1 && triples && group->stride > -3 && group->stride < 3)) {
      return Status::bad_stride;
    }
    const std::size_t stride = group->stride > 0
                                   ? static_cast<std::size_t>(group->stride)
                                   : std::size_t(0) - static_cast<std::size_t>(group->stride);
    if (samples > kMost / stride) {
      return Status::size_overflow;
    }
  }
  return any ? Status::ok : Status::null_output;
}

/// The kernels of one call: the narrowest that compute what is asked for.
struct KernelChoice {
  bool first = false; ///< position, du, dv, normal
  OutputSet outputs = kPosition;
  bool second = false; ///< duu, duv, dvv
};

template <typename T>
[[nodiscard]] KernelChoice choose_kernels(const Outputs<T>& out) noexcept {
  const bool p = out.position.wanted();
  const bool du = out.du.wanted();
  const bool dv = out.dv.wanted();
  const bool n = out.normal.wanted();
  KernelChoice choice;
  choice.first = p || du || dv || n;
  choice.second = out.duu.wanted() || out.duv.wanted() || out.dvv.wanted();
  if (p && !du && !dv) {
    choice.outputs = n ? kPositionNormal : kPosition;
  } else {
    choice.outputs = p && du && dv && !n ? kPositionDerivatives : kAnyOutputs;
  }
  return choice;
}

} // namespace simdbezier::detail
