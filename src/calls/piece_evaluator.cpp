#include "src/calls/piece_evaluator.hpp"

#include <algorithm>
#include <cmath>

#include "src/exact/normal_fallback.hpp"

namespace simdbezier::detail {
namespace {

template <typename T>
void prefill_status(const GridTask<T>& task, SampleStatus* status) noexcept {
  for (std::size_t r = 0; r < task.run_count; ++r) {
    const RowRun<T>& run = task.runs[r];
    for (std::size_t j = 0; j < run.rows; ++j, status += task.nu) {
      for (std::size_t i = 0; i < task.nu; ++i) {
        const bool finite = !std::isnan(task.x[i]) && !std::isnan(run.y[j]);
        status[i] = finite ? SampleStatus::regular : SampleStatus::non_finite;
      }
    }
  }
}

} // namespace

template <typename T>
std::size_t PieceEvaluator<T>::scratch_bytes(std::size_t rows) noexcept {
  return rows > kInlineRows ? 2 * rows * sizeof(RowRun<T>) : 0;
}

template <typename T>
PieceEvaluator<T>::PieceEvaluator(const PatchKernels<T>& kernels, std::size_t rows,
                                  void* scratch) noexcept
    : kernels_(kernels) {
  for (std::size_t k = 0; k < 2; ++k) {
    prepared_[k].runs =
        rows > kInlineRows ? static_cast<RowRun<T>*>(scratch) + k * rows : inline_runs_[k];
  }
}

template <typename T>
void PieceEvaluator<T>::Prepared::find_rows(const GridPlan<T>& where,
                                            const GridPiece& rows) noexcept {
  if (plan != &where || generation != where.generation() || first_row != rows.first_row ||
      last_row != rows.last_row) {
    plan = &where;
    generation = where.generation();
    first_row = rows.first_row;
    last_row = rows.last_row;
    run_count = where.fill_runs(first_row, last_row, runs);
    ahead = false;
  }
}

template <typename T>
void PieceEvaluator<T>::fill(GridTask<T>& task, const PatchKernels<T>& kernels,
                             const PatchStorage<T>& set, const GridPlan<T>& plan,
                             const GridPiece& piece, std::span<const RowRun<T>> runs,
                             const Target& to) noexcept {
  static_cast<PatchArrays<T>&>(task) = set.arrays(piece.patch);
  task.patch_count = piece.patches;
  task.x = plan.x();
  task.nu = plan.nu();
  task.runs = runs.data();
  task.run_count = runs.size();
  for (std::size_t g = 0; g < kVectorOutputs; ++g) {
    task.out[g] = to.planes[g];
  }
  std::copy_n(to.curvature, kCurvatureKinds, task.curvature);
  task.first_component = kernels.first_component;
  task.status = to.status;
  task.patch_step = (piece.last_row - piece.first_row) * plan.nu();
  task.resolve_normal = resolve_normal<T>;
  task.prefetch = pays_to_prefetch(set, true);
  task.streaming = to.streaming;
  task.by_lines = kernels.by_lines;
  task.plain_to_memory = kernels.plain_to_memory;
  task.cached_bytes = cached_sample_bytes();
  task.watertight = kernels.watertight;
  task.record = to.record;
  task.drain = to.drain;
  task.allowed = kernels.allowed;
}

template <typename T>
void PieceEvaluator<T>::run_task(GridTask<T>& task, const PatchKernels<T>& kernels,
                                 const Target& to) noexcept {
  if (to.status != nullptr) {
    for (std::size_t p = 0; p < task.patch_count; ++p) {
      prefill_status(task, to.status + p * task.patch_step);
    }
  }
  kernels.run(task);
}

template <typename T>
Isa PieceEvaluator<T>::run_at_once(const PatchKernels<T>& kernels, const GridPlan<T>& plan,
                                   const GridPiece& piece, const OutputPlan<T>& outputs,
                                   std::size_t sample) noexcept {
  RowRun<T> runs[kInlineRows];
  const std::size_t run_count = plan.fill_runs(piece.first_row, piece.last_row, runs);
  Planes<T> planes[kVectorOutputs];
  outputs.find_planes(sample, planes);
  const Target to(outputs, planes, sample);
  GridTask<T> task;
  fill(task, kernels, kernels.set->buckets[0], plan, piece, {runs, run_count}, to);
  run_task(task, kernels, to);
  if (outputs.streaming()) {
    kernels.table->fence();
  }
  return task.executed;
}

template <typename T>
void PieceEvaluator<T>::run(const GridPlan<T>& plan, const GridPiece& piece, const Target& to,
                            const GridPiece* next) noexcept {
  prepared_[turn_].find_rows(plan, piece);
  if (kernels_.set->places != nullptr) {
    run_mixed(plan, piece, to);
  } else {
    run_bucket(kernels_.set->buckets[0], plan, piece, to, next);
  }
}

/// Patches of one shape that are stored one after the other go to a kernel together.
template <typename T>
void PieceEvaluator<T>::run_mixed(const GridPlan<T>& plan, const GridPiece& piece,
                                  const Target& to) noexcept {
  const PatchPlace* const places = kernels_.set->places.get() + piece.patch;
  const std::size_t patch_samples = (piece.last_row - piece.first_row) * plan.nu();
  for (std::size_t k = 0; k < piece.patches;) {
    std::size_t last = k + 1;
    while (last < piece.patches && places[last].bucket == places[k].bucket &&
           places[last].index == places[k].index + (last - k)) {
      ++last;
    }
    Planes<T> planes[kVectorOutputs];
    const Target part = to.from(k * patch_samples, planes);
    run_bucket(kernels_.set->buckets[places[k].bucket], plan,
               {places[k].index, last - k, piece.first_row, piece.last_row}, part, nullptr);
    k = last;
  }
}

template <typename T>
void PieceEvaluator<T>::run_bucket(const PatchStorage<T>& bucket, const GridPlan<T>& plan,
                                   const GridPiece& piece, const Target& to,
                                   const GridPiece* next) noexcept {
  Prepared& now = prepared_[turn_];
  if (!now.ahead || !(now.piece == piece) || to.status != nullptr || kernels_.choice.any_shape) {
    fill(now.task, kernels_, bucket, plan, piece, {now.runs, now.run_count}, to);
  }
  now.ahead = false;
  if (to.drain != nullptr && to.next != nullptr && next != nullptr) {
    turn_ = 1 - turn_;
    Prepared& later = prepared_[turn_];
    later.find_rows(plan, *next);
    Target after = to;
    after.planes = to.next;
    fill(later.task, kernels_, bucket, plan, *next, {later.runs, later.run_count}, after);
    later.ahead = true;
    later.piece = *next;
  }
  run_task(now.task, kernels_, to);
  executed_ = now.task.executed;
}

template class PieceEvaluator<float>;
template class PieceEvaluator<double>;

} // namespace simdbezier::detail
