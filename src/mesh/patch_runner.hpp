// Grid kernels on small pieces of single patches: the part of a task that is about the set is
// written once.
#pragma once

#include <cstddef>

#include "src/calls/grid_plan.hpp"
#include "src/calls/kernel_choice.hpp"
#include "src/exact/normal_fallback.hpp"
#include "src/runtime/dispatch.hpp"

namespace simdbezier::detail {

/// Parameters of a piece: columns, and rows by runs.
template <typename T>
struct PieceParameters {
  const T* x; ///< half-centred, kMaxLanes more readable behind them
  std::size_t columns;
  const RowRun<T>* runs;
  std::size_t run_count;
  std::size_t rows; ///< of all runs
};

/// Where its samples go: rows one after the other, patches likewise.
template <typename T>
struct PieceTarget {
  Planes<T> position;
  Planes<T> normal;
  std::size_t record = 1; ///< values from one sample to the next, see GridTask
  DrainQueue<T>* drain = nullptr;
};

/// One thread's task.
template <typename T>
class PatchRunner {
public:
  explicit PatchRunner(const PatchKernels<T>& kernels) noexcept : kernels_(kernels) {
    task_.first_component = kernels.first_component;
    task_.resolve_normal = resolve_normal<T>;
    task_.watertight = kernels.watertight;
  }

  /// How many of the patches from `patch` on, at most `most`, one call takes.
  [[nodiscard]] std::size_t together(std::size_t patch, std::size_t most) const noexcept {
    const SetStorage<T>& set = *kernels_.set;
    most = std::min(most, set.count - patch);
    if (set.places == nullptr) {
      return most;
    }
    std::size_t count = 1;
    while (count < most && set.places[patch + count].bucket == set.places[patch].bucket &&
           set.places[patch + count].index == set.places[patch].index + count) {
      ++count;
    }
    return count;
  }

  /// Runs no kernel where neither positions nor normals are wanted: not all kernels accept a task
  /// without outputs.
  void run(std::size_t patch, std::size_t count, const PieceParameters<T>& piece,
           const PieceTarget<T>& to) noexcept {
    if (to.position.component[0] == nullptr && to.normal.component[0] == nullptr) {
      return;
    }
    const PatchPlace place = kernels_.set->place(patch);
    const PatchStorage<T>& bucket = kernels_.set->buckets[place.bucket];
    if (bucket_ != &bucket) {
      bucket_ = &bucket;
      task_.shape = &bucket.shape;
      task_.prefetch =
          bucket.count >
          second_level_cache() / ((bucket.shape.coefficients() + bucket.shape.edges()) * sizeof(T));
    }
    const NetShape& shape = bucket.shape;
    task_.coefficients = bucket.coefficients + place.index * shape.coefficients();
    task_.edges = bucket.edges + place.index * shape.edges();
    task_.given = bucket.given.from(place.index * shape.control_values());
    task_.origins =
        bucket.origins == nullptr ? nullptr : bucket.origins + place.index * shape.origins();
    task_.normal_floor = bucket.normal_floor + place.index * shape.floors();
    task_.patch_count = count;
    task_.x = piece.x;
    task_.nu = piece.columns;
    task_.runs = piece.runs;
    task_.run_count = piece.run_count;
    task_.out[kPositionGroup] = to.position;
    task_.out[kNormalGroup] = to.normal;
    task_.patch_step = piece.rows * piece.columns;
    task_.record = to.record;
    task_.drain = to.drain;
    kernels_.run(task_);
  }

  /// The instruction set of the kernels that ran.
  [[nodiscard]] Isa executed() const noexcept { return task_.executed; }

private:
  const PatchKernels<T>& kernels_;
  const PatchStorage<T>* bucket_ = nullptr;
  GridTask<T> task_{};
};

} // namespace simdbezier::detail
