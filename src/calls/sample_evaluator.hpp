// What the calls on single samples share: one thread's kernels on samples of any patches of a set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/calls/sample_pieces.hpp"
#include "src/choice/kernel_choice.hpp"
#include "src/exact/normal_fallback.hpp"
#include "src/runtime/batch.hpp"

namespace simdbezier::detail {

/// Samples that lie one after the other.
template <typename T>
struct SamplePiece {
  const std::uint32_t* patch;
  const T* u;
  const T* v;
  std::size_t count;
  Parameters parameters;
};

/// The memory that samples go to: unit-stride planes of every vector output, which begin with the
/// piece's first sample.
template <typename T>
struct SampleTarget {
  const Planes<T>* planes;
  SampleStatus* status = nullptr;     ///< may be null; `regular` beforehand
  T* curvature[kCurvatureKinds] = {}; ///< may be null
};

template <typename T>
class SampleEvaluator {
public:
  /// Scratch for pieces of up to `samples`: the indices of their patches in the set's buckets.
  [[nodiscard]] static std::size_t scratch_bytes(const SetStorage<T>& set,
                                                 std::size_t samples) noexcept {
    return set.places == nullptr ? 0 : whole_lines(samples * sizeof(std::uint32_t));
  }

  SampleEvaluator(const PatchKernels<T>& kernels, void* scratch) noexcept
      : kernels_(kernels), index_(static_cast<std::uint32_t*>(scratch)) {}

  /// Returns the instruction set of the kernels that ran.
  Isa run(const SamplePiece<T>& piece, const SampleTarget<T>& to) const noexcept {
    const SetStorage<T>& set = *kernels_.set;
    return set.places == nullptr ? run_bucket(set.buckets[0], piece.patch, piece, 0, to)
                                 : run_mixed(piece, to);
  }

private:
  /// Consecutive samples on patches of one shape go to a kernel together.
  Isa run_mixed(const SamplePiece<T>& piece, const SampleTarget<T>& to) const noexcept {
    Isa executed = Isa::automatic;
    const SetStorage<T>& set = *kernels_.set;
    for (std::size_t k = 0; k < piece.count;) {
      const std::uint32_t bucket = set.places[piece.patch[k]].bucket;
      std::size_t last = k;
      for (; last < piece.count; ++last) {
        const PatchPlace place = set.places[piece.patch[last]];
        if (place.bucket != bucket) {
          break;
        }
        index_[last] = static_cast<std::uint32_t>(place.index);
      }
      SamplePiece<T> part = piece;
      part.count = last - k;
      executed = run_bucket(set.buckets[bucket], index_ + k, part, k, to);
      k = last;
    }
    return executed;
  }

  /// Samples of one bucket, from sample `at` of the target on.
  Isa run_bucket(const PatchStorage<T>& patches, const std::uint32_t* patch,
                 const SamplePiece<T>& piece, std::size_t at,
                 const SampleTarget<T>& to) const noexcept {
    ScatteredTask<T> task{};
    static_cast<PatchArrays<T>&>(task) = patches.arrays(0);
    task.common_floor = patches.common_floor;
    task.patch = patch;
    task.u = piece.u + at;
    task.v = piece.v + at;
    set_half_centring(piece.parameters, task);
    task.count = piece.count;
    task.prefetch = pays_to_prefetch(patches, false);
    task.resolve_normal = resolve_normal<T>;
    task.watertight = kernels_.watertight;
    for (std::size_t g = 0; g < kVectorOutputs; ++g) {
      for (std::size_t c = 0; c < 3; ++c) {
        T* const plane = to.planes[g].component[c];
        task.out[g].component[c] = plane == nullptr ? nullptr : plane + at;
      }
    }
    for (std::size_t c = 0; c < kCurvatureKinds; ++c) {
      task.curvature[c] = to.curvature[c] == nullptr ? nullptr : to.curvature[c] + at;
    }
    task.first_component = kernels_.first_component;
    task.status = to.status == nullptr ? nullptr : to.status + at;
    kernels_.run(task);
    return task.executed;
  }

  const PatchKernels<T>& kernels_;
  std::uint32_t* index_;
};

} // namespace simdbezier::detail
