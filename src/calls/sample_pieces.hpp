// How single samples, of patches or of curves, go to the kernels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/calls/call.hpp"

namespace simdbezier::detail {

/// The arrays of single samples of patches or of curves, whose numbers come first.
template <typename T>
class SampleArrays {
public:
  explicit SampleArrays(const Samples<T>& samples) noexcept
      : index_(samples.patch), parameters_{samples.u, samples.v} {}
  explicit SampleArrays(const CurveSamples<T>& samples) noexcept
      : index_(samples.curve), parameters_{samples.t, samples.t} {}

  [[nodiscard]] std::size_t count() const noexcept { return index_.size(); }
  [[nodiscard]] bool lengths_differ() const noexcept {
    return parameters_[0].size() != count() || parameters_[1].size() != count();
  }
  /// The memory that outputs may not overlap.
  [[nodiscard]] std::array<MemoryRange, 3> inputs() const noexcept {
    return {MemoryRange(index_), MemoryRange(parameters_[0]), MemoryRange(parameters_[1])};
  }
  /// ok | null_input | bad_patch_index; the lengths do not differ.
  [[nodiscard]] Status check(std::size_t set_size, const KernelTable<T>& table) const noexcept {
    if (count() == 0) {
      return Status::ok;
    }
    if (index_.data() == nullptr || parameters_[0].data() == nullptr ||
        parameters_[1].data() == nullptr) {
      return Status::null_input;
    }
    const std::uint32_t highest = table.highest_index(index_.data(), count());
    return highest < set_size ? Status::ok : Status::bad_patch_index;
  }

private:
  std::span<const std::uint32_t> index_;
  std::span<const T> parameters_[2];
};

/// The call on single samples. Work: made of what is given and what is resolved.
template <typename T, typename Arguments, typename Work>
class SamplesCall : public ArgumentsCall<T, Arguments> {
public:
  using ArgumentsCall<T, Arguments>::ArgumentsCall;

  Status check() noexcept {
    const SampleArrays<T> arrays(this->in_.where);
    if (arrays.lengths_differ()) {
      return Status::unequal_lengths;
    }
    const Status usable = this->check_given(arrays.count(), arrays.inputs());
    return usable ? arrays.check(this->in_.set.size(), *this->request_.table) : usable;
  }
  [[nodiscard]] bool empty() const noexcept {
    return SampleArrays<T>(this->in_.where).count() == 0;
  }
  [[nodiscard]] Work plan() const noexcept { return {this->in_, this->request_}; }
};

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

/// Calls use(bucket, first, last) for consecutive samples whose patches have one shape, once
/// index[k] is the place in its bucket of each of their patches.
template <typename T, typename Patch, typename Index, typename Use>
void for_buckets(const SetStorage<T>& set, const Patch* patch, Index* index, std::size_t count,
                 const Use& use) noexcept {
  for (std::size_t k = 0; k < count;) {
    const std::uint32_t bucket = set.place(patch[k]).bucket;
    std::size_t last = k;
    for (; last < count; ++last) {
      const PatchPlace place = set.place(patch[last]);
      if (place.bucket != bucket) {
        break;
      }
      index[last] = static_cast<Index>(place.index);
    }
    use(set.buckets[bucket], k, last);
    k = last;
  }
}

} // namespace simdbezier::detail
