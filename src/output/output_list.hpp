// The outputs of a call on patches or on curves, as far as checks and plans tell them apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <simdbezier/curves.hpp>
#include <simdbezier/outputs.hpp>

#include "src/output/memory_range.hpp"
#include "src/tables/curve_table.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// Calls f(0) … f(kCount - 1), without a loop, so that what is known of each number is known at
/// compile time: small calls feel loops.
template <std::size_t kCount, typename F>
constexpr void for_numbers(const F& f) noexcept {
  const auto call = [&]<std::size_t... k>(std::index_sequence<k...>) { (f(k), ...); };
  call(std::make_index_sequence<kCount>());
}

/// The components of a checked vector.
template <typename T>
[[nodiscard]] std::size_t dimension_of(const Vectors<T>& vectors) noexcept {
  return vectors.z != nullptr ? 3 : vectors.y != nullptr ? 2 : 1;
}

/// References to the caller's Outputs or CurveOutputs, which must live as long.
template <typename T>
struct OutputList {
  const Vectors<T>* vectors[kVectorOutputs]; ///< numbered as Output or as CurveOutput
  std::size_t vector_count;
  const Values<T>* curvature[kCurvatureKinds]; ///< in the order of the tasks
  std::size_t curvature_count;
  const Values<SampleStatus>* status; ///< may be null

  explicit OutputList(const Outputs<T>& out) noexcept
      : vector_count(kVectorOutputs), curvature_count(kCurvatureKinds), status(&out.status) {
    for_numbers<kVectorOutputs>([&](std::size_t k) { vectors[k] = &out[static_cast<Output>(k)]; });
    for_numbers<kCurvatureKinds>(
        [&](std::size_t k) { curvature[k] = &out.curvature[static_cast<Curvature>(k)]; });
    note_wishes();
  }
  explicit OutputList(const CurveOutputs<T>& out) noexcept
      : vector_count(kCurveVectorOutputs), curvature{&out.curvature}, curvature_count(1),
        status(&out.status) {
    for (std::size_t k = 0; k < kCurveVectorOutputs; ++k) {
      vectors[k] = &out[static_cast<CurveOutput>(k)];
    }
    note_wishes();
  }
  /// Some vectors alone, at most kVectorOutputs of them.
  OutputList(const Vectors<T>* first, std::size_t count) noexcept
      : vectors{}, vector_count(count), curvature{}, curvature_count(0), status(nullptr) {
    for (std::size_t k = 0; k < count; ++k) {
      vectors[k] = first + k;
    }
    note_wishes();
  }

  [[nodiscard]] bool wants(std::size_t vector) const noexcept {
    return (wanted_ >> vector & 1U) != 0;
  }
  /// Whether an output of patches is wanted, as OutputSelection has it.
  [[nodiscard]] bool holds(Output output) const noexcept {
    return output == Output::curvature ? wants_curvature_ : wants(output_index(output));
  }
  /// Whether an output of patches is wanted that is one of these.
  [[nodiscard]] bool holds_any(const OutputSelection& outputs) const noexcept {
    return (wanted_ & outputs.bits()) != 0 ||
           (wants_curvature_ && outputs.holds(Output::curvature));
  }
  [[nodiscard]] bool holds(CurveOutput output) const noexcept {
    return wants(output_index(output));
  }
  [[nodiscard]] const Vectors<T>& operator[](CurveOutput output) const noexcept {
    return *vectors[output_index(output)];
  }
  [[nodiscard]] bool wants_vectors() const noexcept { return wanted_ != 0; }
  /// The values of one sample in all vectors that are wanted.
  [[nodiscard]] std::size_t vector_values() const noexcept {
    std::size_t values = 0;
    for (std::size_t g = 0; g < vector_count; ++g) {
      values += wants(g) ? dimension_of(*vectors[g]) : 0;
    }
    return values;
  }
  [[nodiscard]] bool wants_curvature() const noexcept { return wants_curvature_; }
  /// The caller's statuses from a sample on; null where they are not wanted.
  [[nodiscard]] SampleStatus* status_at(std::size_t sample) const noexcept {
    return status->first == nullptr ? nullptr : status->first + sample;
  }
  [[nodiscard]] T* curvature_at(std::size_t which, std::size_t sample) const noexcept {
    T* const first = curvature[which]->first;
    return first == nullptr ? nullptr : first + sample;
  }

private:
  /// Notes what wanted() of every output says, without branches, since small calls feel them.
  void note_wishes() noexcept {
    static_assert(kTrusted == ~std::size_t(0));
    const auto bits = [](const auto* pointer) { return reinterpret_cast<std::uintptr_t>(pointer); };
    for (std::size_t k = 0; k < vector_count; ++k) {
      const Vectors<T>& v = *vectors[k];
      const bool wanted = (bits(v.x) | bits(v.y) | bits(v.z) | ~v.capacity) != 0;
      wanted_ |= static_cast<unsigned>(wanted) << k;
    }
    std::uintptr_t any = 0;
    for (std::size_t k = 0; k < curvature_count; ++k) {
      any |= bits(curvature[k]->first) | ~curvature[k]->capacity;
    }
    wants_curvature_ = any != 0;
  }

  unsigned wanted_ = 0; ///< a bit a vector
  bool wants_curvature_ = false;
};

/// ok | null_output | missing_y | missing_z | extra_y | extra_z: whether a vector has a plane for
/// each of `dimension` (1 to 3) components, and no other.
template <typename T>
[[nodiscard]] Status check_planes(const Vectors<T>& group, std::size_t dimension) noexcept {
  if (group.x == nullptr) {
    return Status::null_output;
  }
  if ((group.y == nullptr) != (dimension < 2)) {
    return dimension < 2 ? Status::extra_y : Status::missing_y;
  }
  if ((group.z == nullptr) != (dimension < 3)) {
    return dimension < 3 ? Status::extra_z : Status::missing_z;
  }
  return Status::ok;
}

/// As check_planes(), and bad_stride | output_too_small | overlapping_outputs | size_overflow, for
/// `samples` samples of vectors of `dimension` (1 to 3) components. Groups of different strides
/// must not share a range of memory at all.
template <typename T>
[[nodiscard]] Status check_outputs(const OutputList<T>& out, std::size_t samples,
                                   std::size_t dimension,
                                   std::span<const MemoryRange> inputs) noexcept;

} // namespace simdbezier::detail
