// Calls of few samples, such as closest points and scripts make them one by one. To resolve, check,
// plan and deliver them as a large call takes ten times as long as to evaluate them.
//
// So what most of these calls are is recognised, and done at once on the caller's thread: patches
// of one shape in space, and vectors that certainly share no memory. All others, and all that is
// wrong, take the way of make_call().
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <simdbezier/options.hpp>
#include <simdbezier/patch_set.hpp>

#include "src/calls/sample_pieces.hpp"
#include "src/exact/normal_fallback.hpp"
#include "src/output/output_list.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/storage/patch_storage.hpp"

namespace simdbezier::detail {

template <typename T>
class FewSamples {
public:
  static constexpr std::size_t kMost = kMaxLanes;

  FewSamples(const PatchSet<T>& set, const Samples<T>& samples, const Outputs<T>& out,
             const Options& options) noexcept
      : storage_(set.storage()), samples_(samples), out_(out), options_(options) {}

  /// Evaluates the samples. False where it is none of these calls, and nothing is done.
  bool run() noexcept {
    Isa isa = Isa::automatic;
    if (!is_usual() || !list_vectors() || are_near_inputs() || !resolve_isa(options_.isa, isa)) {
      return false;
    }
    const DefaultFpEnvironment environment;
    evaluate(kernel_table<T>(isa));
    return true;
  }

private:
  /// One vector that is wanted.
  struct Group {
    std::size_t number;
    const Vectors<T>* vectors;
  };

  /// A range of values. It is not a MemoryRange, because an array of these is set to zero.
  struct Range {
    const T* first;
    std::size_t values;
    std::size_t stride; ///< of triples; 0: a plane

    [[nodiscard]] MemoryRange bytes() const noexcept { return {first, values * sizeof(T)}; }
    [[nodiscard]] MemoryRange triple() const noexcept { return {first, 3 * sizeof(T)}; }
    /// Whether the other one has triples of the same records, behind these.
    [[nodiscard]] bool is_before(const Range& other) const noexcept {
      const MemoryRange record{first, stride * sizeof(T)};
      return stride == other.stride && record.contains(other.triple()) &&
             !triple().meets(other.triple());
    }
  };

  [[nodiscard]] std::size_t count() const noexcept { return samples_.patch.size(); }

  [[nodiscard]] bool is_usual() const noexcept {
    if (storage_ == nullptr || storage_->places != nullptr || count() - 1 >= kMost ||
        samples_.u.size() != count() || samples_.v.size() != count() ||
        samples_.patch.data() == nullptr || samples_.u.data() == nullptr ||
        samples_.v.data() == nullptr || storage_->buckets[0].shape.components != 3 ||
        out_.first_component != 0 || out_.status.wanted() || out_.curvature.wanted() ||
        options_.destination == Destination::memory) { // which is to stream, however little
      return false;
    }
    std::uint32_t highest = 0;
    for (std::size_t k = 0; k < count(); ++k) {
      highest = std::max(highest, samples_.patch[k]);
    }
    return highest < storage_->count;
  }

  /// Lists the vectors that are wanted. False where one is not three planes or triples one after
  /// the other, or where two are not certainly apart.
  [[nodiscard]] bool list_vectors() noexcept {
    bool usual = true;
    for_numbers<kVectorOutputs>([&](std::size_t g) {
      const Vectors<T>& v = out_[static_cast<Output>(g)];
      if (v.wanted()) {
        groups_[group_count_++] = {g, &v};
        usual = usual && v.x != nullptr && v.y != nullptr && v.z != nullptr &&
                v.capacity >= count() && add_ranges(v);
      }
    });
    bool ascend = true; // as most do; then no two of them meet
    for (std::size_t i = 1; i < range_count_; ++i) {
      ascend = ascend && ranges_[i - 1].bytes().precedes(ranges_[i].bytes());
    }
    for (std::size_t i = 1; i < range_count_ && !ascend; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        usual = usual && (ranges_[i].is_before(ranges_[j]) || ranges_[j].is_before(ranges_[i]) ||
                          !ranges_[i].bytes().meets(ranges_[j].bytes()));
      }
    }
    return usual && group_count_ > 0;
  }
  [[nodiscard]] bool add_ranges(const Vectors<T>& v) noexcept {
    constexpr std::ptrdiff_t kMostStride = 1 << 20;
    if (v.y == v.x + 1 && v.z == v.x + 2 && v.stride >= 3 && v.stride < kMostStride) {
      const auto stride = static_cast<std::size_t>(v.stride);
      ranges_[range_count_++] = {v.x, (count() - 1) * stride + 3, stride};
      return true;
    }
    for (T* const plane : {v.x, v.y, v.z}) {
      ranges_[range_count_++] = {plane, count(), 0};
    }
    return v.stride == 1;
  }
  [[nodiscard]] bool are_near_inputs() const noexcept {
    const MemoryRange inputs[] = {samples_.patch, samples_.u, samples_.v};
    bool near = false;
    for (std::size_t k = 0; k < range_count_; ++k) {
      for (const MemoryRange& input : inputs) {
        near = near || ranges_[k].bytes().meets(input);
      }
    }
    return near;
  }

  /// Whole registers are evaluated: the samples behind the last one are on its patch, but not in
  /// the middle, which is an edge of cells from degree 6 on, and takes a sample's time again.
  void evaluate(const KernelTable<T>& table) const noexcept {
    const PatchStorage<T>& bucket = storage_->buckets[0];
    std::uint32_t patch[kMost];
    alignas(64) T u[kMost];
    alignas(64) T v[kMost];
    alignas(64) T values[kVectorOutputs][3][kMost];
    ScatteredTask<T> task; // written below: zeros would take as long as a sample
    set_half_centring(samples_.parameters, task);
    task.count = (count() + table.lanes - 1) / table.lanes * table.lanes;
    const T inside = task.shift + T(0.25) / task.scale;
    for (std::size_t k = 0; k < task.count; ++k) {
      const bool given = k < count();
      patch[k] = samples_.patch[given ? k : count() - 1];
      u[k] = given ? samples_.u[k] : inside;
      v[k] = given ? samples_.v[k] : inside;
    }
    static_cast<PatchArrays<T>&>(task) = bucket.arrays(0);
    task.common_floor = bucket.common_floor;
    task.patch = patch;
    task.u = u;
    task.v = v;
    task.resolve_normal = resolve_normal<T>;
    task.status = nullptr;
    task.first_component = 0;
    task.prefetch = false;
    for_numbers<kCurvatureKinds>([&](std::size_t c) { task.curvature[c] = nullptr; });
    task.watertight = options_.watertight;
    for (std::size_t k = 0; k < group_count_; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        task.out[groups_[k].number].component[c] = values[k][c];
      }
    }
    table.shapes->scattered(task);
    for (std::size_t k = 0; k < group_count_; ++k) {
      const Vectors<T>& to = *groups_[k].vectors;
      for (std::size_t n = 0; n < count(); ++n) {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(n) * to.stride;
        to.x[at] = values[k][0][n];
        to.y[at] = values[k][1][n];
        to.z[at] = values[k][2][n];
      }
    }
    note_executed(task.executed);
  }

  const SetStorage<T>* storage_;
  const Samples<T>& samples_;
  const Outputs<T>& out_;
  const Options& options_;
  std::size_t group_count_ = 0;
  std::size_t range_count_ = 0;
  Group groups_[kVectorOutputs];     ///< the first group_count_ of them are written
  Range ranges_[3 * kVectorOutputs]; ///< likewise
};

} // namespace simdbezier::detail
