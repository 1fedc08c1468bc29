#include "src/output/output_plan.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>

#include "src/runtime/cache_sizes.hpp"
#include "src/runtime/sort.hpp"
#include "src/tables/sample_record.hpp"

namespace simdbezier::detail {
namespace {

/// One component of a staged vector: values `stride` apart.
template <typename T>
struct StagedColumn {
  T* first;
  std::ptrdiff_t stride;
  std::size_t plane;
};

} // namespace

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
OutputPlan<T>::OutputPlan(const OutputList<T>& out, Way way) noexcept : out_(out), way_(way) {
  // What is not written directly: everything where stores are to bypass the caches, records
  // otherwise.
  for (std::size_t g = 0; g < kVectorOutputs; ++g) {
    const bool stages = out_.wants(g) && (streaming() || out_.vectors[g]->stride != 1);
    first_plane_[g] = stages ? staged_planes_ : kNotStaged;
    staged_planes_ += stages ? dimension_of(*out_.vectors[g]) : 0;
  }
  if (staged_planes_ > 0) {
    add_streams();
  }
}

template <typename T>
std::size_t OutputPlan<T>::chunk_bytes() const noexcept {
  switch (way_) {
  case Way::memory: // two chunks, and half as much again, leave two fifths for all else
    return second_level_cache() / 5;
  case Way::memory_other: // two chunks, and half as much again, stay in the cache
    return first_level_cache() / 4;
  default: // what a kernel writes and a drain reads at once stays in a first-level cache
    return std::size_t{20} << 10;
  }
}

template <typename T>
void OutputPlan<T>::put_directly(const DirectRows& rows) noexcept {
  if (!staged()) {
    return;
  }
  const std::size_t record = stream_[0].members;
  const std::size_t line = 64 / sizeof(T);
  const bool vertex =
      record == staged_planes_ && (record % 3 == 0 || (rows.vertices && record == kVertexRecord));
  const bool known = record == 1 || record == 3 || vertex;
  const bool all = staged_planes_ == out_.vector_values();
  const bool anywhere = record == 1 && rows.streamed_anywhere;
  const bool whole_lines = rows.row % line == 0;
  const bool fills = rows.row >= rows.lanes; // a register
  const bool streams =
      anywhere ? rows.row > 0
               : fills && whole_lines && (record == 1 ? rows.streamed : rows.streamed_records);
  const bool stores = fills && rows.records && all;
  bool possible = known && (streaming() ? streams : stores);
  const auto place_in_line = [](const T* first) {
    return reinterpret_cast<std::uintptr_t>(first) % 64;
  };
  bool on_lines = true;
  for (std::size_t k = 0; possible && k < streams_; ++k) {
    const StreamShape<T>& shape = stream_[k];
    on_lines = on_lines && place_in_line(shape.first) == 0;
    const bool placed =
        anywhere ? !rows.same_place || place_in_line(shape.first) == place_in_line(stream_[0].first)
                 : on_lines;
    possible = shape.members == record && shape.stride == static_cast<std::ptrdiff_t>(record) &&
               (!streaming() || placed);
    for (std::size_t m = 1; m < record; ++m) {
      possible = possible && shape.plane[m] == shape.plane[0] + m;
    }
  }
  if (!possible) {
    return;
  }
  if (way_ == Way::memory_other && !(whole_lines && on_lines)) {
    way_ = Way::memory; // in staging of the size that it has where kernels cannot stream
    return;
  }
  record_ = record;
  write_directly();
}

template <typename T>
void OutputPlan<T>::find_planes(std::size_t sample,
                                Planes<T> (&planes)[kVectorOutputs]) const noexcept {
  for (std::size_t g = 0; g < out_.vector_count; ++g) {
    if (out_.wants(g) && !is_staged(g)) {
      const Vectors<T>& group = *out_.vectors[g];
      T* const first[3] = {group.x, group.y, group.z};
      for (std::size_t c = 0; c < dimension_of(group); ++c) {
        planes[g].component[c] = first[c] + static_cast<std::ptrdiff_t>(sample) * group.stride;
      }
    }
  }
}

template <typename T>
void OutputPlan<T>::write_directly() noexcept {
  staged_planes_ = 0;
  streams_ = 0;
  std::fill_n(first_plane_, kVectorOutputs, kNotStaged);
}

/// Members that lie side by side in one vertex become one stream.
template <typename T>
void OutputPlan<T>::add_streams() noexcept {
  streams_ = 0;
  StagedColumn<T> columns[kMostMembers];
  std::size_t count = 0;
  for (std::size_t g = 0; g < kVectorOutputs; ++g) {
    if (is_staged(g)) {
      const Vectors<T>& group = *out_.vectors[g];
      std::size_t plane = first_plane(g);
      for (T* const first : {group.x, group.y, group.z}) {
        if (first != nullptr) {
          columns[count++] = {first, group.stride, plane++};
        }
      }
    }
  }
  sort_range(columns, columns + count, [](const StagedColumn<T>& a, const StagedColumn<T>& b) {
    return std::less<>()(a.first, b.first);
  });
  for (std::size_t k = 0; k < count; ++k) {
    const StagedColumn<T>& member = columns[k];
    StreamShape<T>* const last = streams_ > 0 ? &stream_[streams_ - 1] : nullptr;
    const bool joins = last != nullptr && last->stride == member.stride &&
                       member.first == last->first + last->members &&
                       last->members < static_cast<std::size_t>(std::abs(member.stride));
    StreamShape<T>& shape = joins ? *last : stream_[streams_++];
    if (!joins) {
      shape.members = 0;
      shape.first = member.first;
      shape.stride = member.stride;
    }
    shape.plane[shape.members++] = member.plane;
  }
  for (std::size_t k = 0; k < streams_; ++k) {
    StreamShape<T>& shape = stream_[k];
    shape.streaming = streaming() && shape.stride == static_cast<std::ptrdiff_t>(shape.members) &&
                      shape.records_to_line(0) < kDrainStep<T>;
  }
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template struct StreamShape<T>;                                                                  \
  template class OutputPlan<T>;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier::detail
