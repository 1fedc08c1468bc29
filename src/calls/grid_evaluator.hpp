// What the grid calls share: one thread's kernels on rows of consecutive patches.
#pragma once

#include <cstddef>

#include "src/calls/grid_plan.hpp"
#include "src/calls/grid_request.hpp"
#include "src/output/output_plan.hpp"
#include "src/storage/patch_storage.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::detail {

/// Patches [patch, patch + patches) of a set, all on rows [first_row, last_row) of one grid.
struct GridPiece {
  std::size_t patch;
  std::size_t patches;
  std::size_t first_row;
  std::size_t last_row;

  friend bool operator==(const GridPiece&, const GridPiece&) = default;
};

/// The kernels of one call.
template <typename T>
struct GridKernels {
  const SetStorage<T>* set;
  const KernelTable<T>* table;
  KernelChoice choice;
  bool watertight;
  std::size_t first_component;
  bool any_shape; ///< bicubic patches take the kernels of any shape, too

  GridKernels(const SetStorage<T>& storage, const KernelTable<T>& kernels,
              const WantedGroups& wanted, bool curvature, const Components& components,
              bool watertight_edges) noexcept
      : set(&storage), table(&kernels), choice(choose_kernels(wanted)),
        watertight(watertight_edges), first_component(components.first),
        any_shape(curvature || !components.space) {}

  /// What they put where it belongs by themselves, on grids of `nu` columns or more: all of it
  /// where all patches are bicubic, and evaluated as such. streamed: past the caches, too.
  [[nodiscard]] DirectRows direct_rows(std::size_t nu, bool streamed) const noexcept {
    const bool bicubic = !any_shape && set->places == nullptr && set->buckets[0].shape.is_bicubic();
    return {.row = bicubic ? nu : 0,
            .lanes = table->lanes,
            .streamed = streamed,
            .records = table->puts_records};
  }
};

/// One thread's evaluator. Remembers the rows of the last piece, which most often are those of the
/// next one.
template <typename T>
class GridEvaluator {
public:
  /// Bytes of scratch for pieces of up to `rows` rows.
  [[nodiscard]] static std::size_t scratch_bytes(std::size_t rows) noexcept;

  /// rows: the most in one piece. scratch: aligned to 64 bytes; null where none is needed.
  GridEvaluator(const GridKernels<T>& kernels, std::size_t rows, void* scratch) noexcept;

  /// Where a piece goes: planes that begin with its first sample.
  struct Target {
    const Planes<T>* planes = nullptr; ///< kGroups
    SampleStatus* status = nullptr;    ///< may be null
    T* curvature[kCurvatures] = {};    ///< may be null
    DrainQueue<T>* drain = nullptr;    ///< may be null
    bool streaming = false;            ///< see OutputPlan::arrange()
    const Planes<T>* next = nullptr;   ///< with a drain: the planes of the piece after this one
    std::size_t record = 1;            ///< see GridTask

    /// The caller's curvatures from a sample on.
    void set_curvature(const Curvatures<T>& out, std::size_t sample) noexcept {
      const CurvaturePlanes<T> from(out);
      for (std::size_t k = 0; k < kCurvatures; ++k) {
        curvature[k] = from.plane[k] == nullptr ? nullptr : from.plane[k] + sample;
      }
    }
  };
  void run(const GridPlan<T>& plan, const GridPiece& piece, const Target& to) noexcept;

  /// Of the kernels that ran.
  [[nodiscard]] Isa executed() const noexcept { return executed_; }

private:
  static constexpr std::size_t kInlineRows = 128;

  /// bucket, piece.patch: where the piece's patches are stored.
  void fill(GridTask<T>& task, const PatchStorage<T>& bucket, const GridPlan<T>& plan,
            const GridPiece& piece, const Target& to) const noexcept;
  void run_bucket(const PatchStorage<T>& bucket, const GridPlan<T>& plan, const GridPiece& piece,
                  const Target& to) noexcept;
  void run_mixed(const GridPlan<T>& plan, const GridPiece& piece, const Target& to) noexcept;

  const GridKernels<T>& kernels_;
  RowRun<T>* runs_;
  std::size_t run_count_ = 0;
  const GridPlan<T>* plan_ = nullptr; ///< of runs_, with the three below
  std::uint32_t generation_ = 0;
  std::size_t first_row_ = 0;
  std::size_t last_row_ = 0;
  Isa executed_ = Isa::automatic;
  // A task is copied in large pieces by the kernels, so with streaming stores it is written one
  // piece ahead, as a guess (see src/tables/drain_queue.hpp).
  GridTask<T> task_[2] = {};
  std::size_t turn_ = 0;
  bool guessed_ = false;
  GridPiece guess_{};
  RowRun<T> inline_runs_[kInlineRows];
};

} // namespace simdbezier::detail
