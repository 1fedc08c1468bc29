// See src/output/output_list.hpp: what may be wrong with the memory of outputs.
#include <algorithm>
#include <cstdint>
#include <limits>

#include "src/output/output_list.hpp"
#include "src/runtime/both_types.hpp"
#include "src/tables/drain_queue.hpp"

namespace simdbezier::detail {
namespace {

/// One component of one output: values `stride` apart, which lie in a range.
template <typename T>
struct Column {
  T* first;
  std::ptrdiff_t stride;
  std::ptrdiff_t lowest; ///< bytes from `first` on, and behind the last ones
  std::ptrdiff_t highest;

  [[nodiscard]] MemoryRange range() const noexcept { return {first, lowest, highest}; }
};

template <typename T>
struct Columns {
  Column<T> column[kMostMembers + kCurvatureKinds]; ///< the first `count` of them are written
  std::size_t count = 0;

  /// Adds those columns of a group that are not null. They have the same extent.
  void add(T* const (&first)[3], std::ptrdiff_t stride, std::size_t samples) noexcept {
    if (samples == 0) {
      return; // and the stride may be anything
    }
    const std::ptrdiff_t last =
        static_cast<std::ptrdiff_t>(samples - 1) * stride * static_cast<std::ptrdiff_t>(sizeof(T));
    const std::ptrdiff_t lowest = std::min<std::ptrdiff_t>(last, 0);
    const std::ptrdiff_t highest = std::max<std::ptrdiff_t>(last, 0) + std::ptrdiff_t{sizeof(T)};
    for (T* const values : first) {
      if (values != nullptr) {
        column[count++] = {values, stride, lowest, highest};
      }
    }
  }
};

/// Whether two columns put values into the same place.
template <typename T>
bool collide(const Column<T>& a, const Column<T>& b) noexcept {
  if (!a.range().meets(b.range())) {
    return false;
  }
  if (a.stride != b.stride) {
    return true;
  }
  const auto bytes = static_cast<std::ptrdiff_t>(reinterpret_cast<std::uintptr_t>(b.first) -
                                                 reinterpret_cast<std::uintptr_t>(a.first));
  constexpr auto kSize = static_cast<std::ptrdiff_t>(sizeof(T));
  return bytes % kSize != 0 || bytes / kSize % a.stride == 0;
}

/// Whether the members of a record lie side by side, and the next record begins among them.
template <typename T>
bool records_overlap(const Vectors<T>& group, std::size_t dimension) noexcept {
  const bool side_by_side =
      (dimension < 2 || group.y == group.x + 1) && (dimension < 3 || group.z == group.x + 2);
  const auto members = static_cast<std::ptrdiff_t>(dimension);
  return side_by_side && group.stride > -members && group.stride < members;
}

template <typename T>
Status check_vectors(const Vectors<T>& group, std::size_t samples, std::size_t dimension) noexcept {
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(T);
  if (group.capacity == 0) { // there is no memory that could be looked at
    return samples == 0 ? Status::ok : Status::output_too_small;
  }
  if (const Status status = check_planes(group, dimension); !status) {
    return status;
  }
  if (group.stride == 0 || (samples > 1 && records_overlap(group, dimension))) {
    return Status::bad_stride;
  }
  const std::size_t stride = group.stride > 0
                                 ? static_cast<std::size_t>(group.stride)
                                 : std::size_t(0) - static_cast<std::size_t>(group.stride);
  std::size_t values = 0;
  if (__builtin_mul_overflow(samples, stride, &values) || values > kMost) {
    return Status::size_overflow;
  }
  return samples > group.capacity ? Status::output_too_small : Status::ok;
}

template <typename T>
Status check_values(const Values<T>& values, std::size_t samples) noexcept {
  if (samples > std::numeric_limits<std::ptrdiff_t>::max() / sizeof(T)) {
    return Status::size_overflow;
  }
  return samples > values.capacity ? Status::output_too_small : Status::ok;
}

template <typename T>
Status check_overlaps(const Columns<T>& columns, const MemoryRange& status,
                      std::span<const MemoryRange> inputs) noexcept {
  const auto meets_input = [&](const MemoryRange& range) {
    return std::any_of(inputs.begin(), inputs.end(),
                       [&](const MemoryRange& input) { return range.meets(input); });
  };
  bool bad = meets_input(status);
  // Most calls have neither statuses nor inputs that outputs could meet.
  const bool others = !status.empty() || !inputs.empty();
  for (std::size_t i = 0; others && i < columns.count; ++i) {
    const MemoryRange range = columns.column[i].range();
    bad = bad || range.meets(status) || meets_input(range);
  }
  // Most outputs lie one behind the other in memory. Then no two columns meet, and pairs need no
  // look.
  bool ascend = true;
  for (std::size_t i = 1; i < columns.count; ++i) {
    ascend = ascend && columns.column[i - 1].range().precedes(columns.column[i].range());
  }
  for (std::size_t i = 0; i < columns.count && !ascend; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      bad = bad || collide(columns.column[i], columns.column[j]);
    }
  }
  return bad ? Status::overlapping_outputs : Status::ok;
}

} // namespace

template <typename T>
Status check_outputs(const OutputList<T>& out, std::size_t samples, std::size_t dimension,
                     std::span<const MemoryRange> inputs) noexcept {
  Columns<T> columns;
  bool any = false;
  for (std::size_t g = 0; g < out.vector_count; ++g) {
    if (!out.wants(g)) {
      continue;
    }
    const Vectors<T>& group = *out.vectors[g];
    if (const Status status = check_vectors(group, samples, dimension); !status) {
      return status;
    }
    any = true;
    columns.add({group.x, group.y, group.z}, group.stride, samples);
  }
  for (std::size_t k = 0; out.wants_curvature() && k < out.curvature_count; ++k) {
    const Values<T>& values = *out.curvature[k];
    if (values.wanted()) {
      if (const Status status = check_values(values, samples); !status) {
        return status;
      }
      any = true;
      columns.add({values.first, nullptr, nullptr}, 1, samples);
    }
  }
  if (!any) {
    return Status::null_output;
  }
  if (samples == 0) {
    return Status::ok;
  }
  MemoryRange statuses;
  if (out.status != nullptr && out.status->wanted()) {
    if (const Status status = check_values(*out.status, samples); !status) {
      return status;
    }
    statuses = {out.status->first, samples * sizeof(SampleStatus)};
  }
  return check_overlaps(columns, statuses, inputs);
}

SIMDBEZIER_OF_BOTH_TYPES(check_outputs);

} // namespace simdbezier::detail
