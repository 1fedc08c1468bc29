// See src/output/output_plan.hpp.
#include "src/output/output_plan.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>

#include "src/runtime/dispatch.hpp"

namespace simdbezier::detail {
namespace {

/// One component of one group: `samples` values, `stride` apart.
template <typename T>
struct Member {
  T* first;
  std::ptrdiff_t stride;
  std::size_t plane;
};

template <typename T>
struct Members {
  Member<T> member[kMostMembers + kCurvatures];
  std::size_t count = 0;
};

struct Range {
  std::uintptr_t begin;
  std::uintptr_t end;
  [[nodiscard]] bool meets(const Range& other) const noexcept {
    return begin < other.end && other.begin < end;
  }
};

template <typename T>
Range range_of(const Member<T>& m, std::size_t samples) noexcept {
  const auto first = reinterpret_cast<std::uintptr_t>(m.first);
  const std::ptrdiff_t last =
      static_cast<std::ptrdiff_t>(samples - 1) * m.stride * static_cast<std::ptrdiff_t>(sizeof(T));
  const std::uintptr_t other = first + static_cast<std::uintptr_t>(last);
  return {std::min(first, other), std::max(first, other) + sizeof(T)};
}

/// Whether two members put values into the same place.
template <typename T>
bool collide(const Member<T>& a, const Member<T>& b, std::size_t samples) noexcept {
  if (!range_of(a, samples).meets(range_of(b, samples))) {
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

template <typename T>
std::size_t dimension_of(const Vectors<T>& group) noexcept {
  return group.z != nullptr ? 3 : group.y != nullptr ? 2 : 1;
}

/// Whether the members of records lie side by side, nearer to each other than the next record is.
template <typename T>
bool records_overlap(const Vectors<T>& group, std::size_t dimension) noexcept {
  const bool side_by_side =
      (dimension < 2 || group.y == group.x + 1) && (dimension < 3 || group.z == group.x + 2);
  const auto members = static_cast<std::ptrdiff_t>(dimension);
  return side_by_side && group.stride > -members && group.stride < members;
}

template <typename T>
Status check_group(const Vectors<T>& group, std::size_t samples, std::size_t dimension) noexcept {
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(T);
  if (group.x == nullptr || (group.y == nullptr) != (dimension < 2) ||
      (group.z == nullptr) != (dimension < 3)) {
    return Status::null_output;
  }
  if (group.stride == 0 || (samples > 1 && records_overlap(group, dimension))) {
    return Status::bad_stride;
  }
  const std::size_t stride = group.stride > 0
                                 ? static_cast<std::size_t>(group.stride)
                                 : std::size_t(0) - static_cast<std::size_t>(group.stride);
  return samples > kMost / stride ? Status::size_overflow : Status::ok;
}

template <typename T>
Status check_overlaps(const Members<T>& members, const SampleStatus* status, std::size_t samples,
                      const InputRange* inputs, std::size_t input_count) noexcept {
  const auto status_begin = reinterpret_cast<std::uintptr_t>(status);
  const Range status_range{status_begin, status == nullptr ? status_begin : status_begin + samples};
  const auto meets_input = [&](const Range& range) {
    return std::any_of(inputs, inputs + input_count, [&](const InputRange& input) {
      const auto begin = reinterpret_cast<std::uintptr_t>(input.begin);
      return input.begin != nullptr && range.meets({begin, begin + input.bytes});
    });
  };
  bool bad = meets_input(status_range);
  for (std::size_t i = 0; i < members.count; ++i) {
    const Range range = range_of(members.member[i], samples);
    bad = bad || range.meets(status_range) || meets_input(range);
    for (std::size_t j = 0; j < i; ++j) {
      bad = bad || collide(members.member[i], members.member[j], samples);
    }
  }
  return bad ? Status::overlapping_outputs : Status::ok;
}

} // namespace

template <typename T>
Status check_outputs(const Outputs<T>& out, std::size_t samples, std::size_t dimension, bool space,
                     const InputRange* inputs, std::size_t input_count) noexcept {
  if (!space && (out.normal.wanted() || out.curvature.wanted())) {
    return Status::bad_components;
  }
  Members<T> members;
  for (const Vectors<T>* group : OutputGroups<T>(out).group) {
    if (!group->wanted()) {
      continue;
    }
    const Status status = check_group(*group, samples, dimension);
    if (status != Status::ok) {
      return status;
    }
    for (T* const first : {group->x, group->y, group->z}) {
      if (first != nullptr) {
        members.member[members.count++] = {first, group->stride, 0};
      }
    }
  }
  for (T* const plane : CurvaturePlanes<T>(out.curvature).plane) {
    if (plane != nullptr) {
      if (samples > std::numeric_limits<std::ptrdiff_t>::max() / sizeof(T)) {
        return Status::size_overflow;
      }
      members.member[members.count++] = {plane, 1, 0};
    }
  }
  if (members.count == 0) {
    return Status::null_output;
  }
  return samples == 0 ? Status::ok
                      : check_overlaps(members, out.status, samples, inputs, input_count);
}

template <typename T>
WantedGroups wanted_groups(const Outputs<T>& out) noexcept {
  const OutputGroups<T> groups(out);
  WantedGroups wanted{};
  for (std::size_t g = 0; g < kGroups; ++g) {
    wanted.group[g] = groups.group[g]->wanted();
  }
  return wanted;
}

std::size_t vector_values(const WantedGroups& wanted, std::size_t dimension) noexcept {
  const auto groups = std::count(wanted.group, wanted.group + kGroups, true);
  return dimension * static_cast<std::size_t>(groups);
}

KernelChoice choose_kernels(const WantedGroups& wanted) noexcept {
  const bool p = wanted.group[kPositionGroup];
  const bool du = wanted.group[kDuGroup];
  const bool dv = wanted.group[kDvGroup];
  const bool n = wanted.group[kNormalGroup];
  KernelChoice choice;
  choice.first = p || du || dv || n;
  choice.second = wanted.group[kDuuGroup] || wanted.group[kDuvGroup] || wanted.group[kDvvGroup];
  if (p && !du && !dv) {
    choice.outputs = n ? kPositionNormal : kPosition;
  } else {
    choice.outputs = p && du && dv && !n ? kPositionDerivatives : kAnyOutputs;
  }
  return choice;
}

template <typename T>
std::size_t StreamShape<T>::records_to_line(std::size_t record) const noexcept {
  const T* const at = first + static_cast<std::ptrdiff_t>(record) * stride;
  for (std::size_t k = 0; k < kDrainStep<T>; ++k) {
    if (reinterpret_cast<std::uintptr_t>(at + static_cast<std::ptrdiff_t>(k) * stride) % 64 == 0) {
      return k;
    }
  }
  return kDrainStep<T>;
}

template <typename T>
OutputPlan<T>::OutputPlan(const Outputs<T>& out, std::size_t samples,
                          Destination destination) noexcept
    : out_(out), automatic_(destination == Destination::automatic) {
  const OutputGroups<T> groups(out);
  std::size_t components = 0;
  for (const Vectors<T>* group : groups.group) {
    if (group->wanted()) {
      dimension_ = dimension_of(*group);
      components += dimension_;
    }
  }
  components += components == 0 ? kCurvatures : 0;
  // Half of the cache: the consumer has other data, too.
  streaming_ = destination == Destination::memory ||
               (automatic_ && samples > last_level_cache() / 2 / sizeof(T) / components);
  stage();
}

template <typename T>
void OutputPlan<T>::arrange(const DirectRows& rows, int threads) noexcept {
  put_directly(rows);
  if (automatic_ && streaming_ && staged() && !staged_streaming_pays(threads)) {
    streaming_ = false;
    stage();
    put_directly(rows);
  }
}

/// What is not written directly: everything where stores are to bypass the caches, records
/// otherwise.
template <typename T>
void OutputPlan<T>::stage() noexcept {
  const OutputGroups<T> groups(out_);
  std::size_t staged = 0;
  for (std::size_t g = 0; g < kGroups; ++g) {
    const Vectors<T>& group = *groups.group[g];
    group_index_[g] = group.wanted() && (streaming_ || group.stride != 1) ? staged++ : kGroups;
  }
  staged_planes_ = dimension_ * staged;
  add_streams();
}

template <typename T>
void OutputPlan<T>::put_directly(const DirectRows& rows) noexcept {
  const WantedGroups wanted = wanted_groups(out_);
  const KernelChoice choice = choose_kernels(wanted);
  const std::size_t record = stream_[0].members;
  const bool lines = rows.streamed && rows.lanes * sizeof(T) == 64 && rows.row % rows.lanes == 0;
  const bool registers = rows.records && staged_planes_ == vector_values(wanted, dimension_);
  bool possible = staged() && rows.row >= rows.lanes && (streaming_ ? lines : registers) &&
                  !choice.second && choice.outputs != kAnyOutputs &&
                  (record == 1 || (rows.records && (record == 3 || record == staged_planes_)));
  for (std::size_t k = 0; possible && k < streams_; ++k) {
    const StreamShape<T>& shape = stream_[k];
    possible = shape.members == record && shape.stride == static_cast<std::ptrdiff_t>(record) &&
               (!streaming_ || reinterpret_cast<std::uintptr_t>(shape.first) % 64 == 0);
    for (std::size_t m = 1; m < record; ++m) {
      possible = possible && shape.plane[m] == shape.plane[0] + m;
    }
  }
  if (possible) {
    record_ = record;
    write_directly();
  }
}

template <typename T>
void OutputPlan<T>::write_directly() noexcept {
  staged_planes_ = 0;
  streams_ = 0;
  std::fill_n(group_index_, kGroups, static_cast<std::size_t>(kGroups));
}

/// Members that lie side by side in one vertex become one stream.
template <typename T>
void OutputPlan<T>::add_streams() noexcept {
  std::fill_n(stream_, streams_, StreamShape<T>{});
  streams_ = 0;
  Members<T> rest;
  const OutputGroups<T> groups(out_);
  for (std::size_t g = 0; g < kGroups; ++g) {
    if (is_staged(g)) {
      const Vectors<T>& group = *groups.group[g];
      std::size_t plane = dimension_ * staged_group(g);
      for (T* const first : {group.x, group.y, group.z}) {
        if (first != nullptr) {
          rest.member[rest.count++] = {first, group.stride, plane++};
        }
      }
    }
  }
  std::sort(rest.member, rest.member + rest.count,
            [](const Member<T>& a, const Member<T>& b) { return std::less<>()(a.first, b.first); });
  for (std::size_t k = 0; k < rest.count; ++k) {
    const Member<T>& member = rest.member[k];
    StreamShape<T>* const last = streams_ > 0 ? &stream_[streams_ - 1] : nullptr;
    const bool joins = last != nullptr && last->stride == member.stride &&
                       member.first == last->first + last->members &&
                       last->members < static_cast<std::size_t>(std::abs(member.stride));
    StreamShape<T>& shape = joins ? *last : stream_[streams_++];
    if (!joins) {
      shape.first = member.first;
      shape.stride = member.stride;
    }
    shape.plane[shape.members++] = member.plane;
  }
  for (std::size_t k = 0; k < streams_; ++k) {
    StreamShape<T>& shape = stream_[k];
    shape.streaming = streaming_ && shape.stride == static_cast<std::ptrdiff_t>(shape.members) &&
                      shape.records_to_line(0) < kDrainStep<T>;
  }
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template Status check_outputs(const Outputs<T>&, std::size_t, std::size_t, bool,                 \
                                const InputRange*, std::size_t) noexcept;                          \
  template WantedGroups wanted_groups(const Outputs<T>&) noexcept;                                 \
  template struct StreamShape<T>;                                                                  \
  template class OutputPlan<T>;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier::detail
