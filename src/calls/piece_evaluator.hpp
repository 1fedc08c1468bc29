// What the grid calls share: one thread's kernels on rows of consecutive patches.
#pragma once

#include <cstddef>
#include <span>

#include "src/calls/grid_plan.hpp"
#include "src/choice/kernel_choice.hpp"
#include "src/output/delivery.hpp"

namespace simdbezier::detail {

/// Patches [patch, patch + patches) of a set, all on rows [first_row, last_row) of one grid.
struct GridPiece {
  std::size_t patch;
  std::size_t patches;
  std::size_t first_row;
  std::size_t last_row;

  friend bool operator==(const GridPiece&, const GridPiece&) = default;
};

/// One thread's evaluator. Remembers the rows of the last pieces, which most often are those of the
/// next ones.
template <typename T>
class PieceEvaluator {
public:
  /// Bytes of scratch for pieces of up to `rows` rows.
  [[nodiscard]] static std::size_t scratch_bytes(std::size_t rows) noexcept;

  /// rows: the most in one piece. scratch: aligned to 64 bytes; null where none is needed.
  PieceEvaluator(const PatchKernels<T>& kernels, std::size_t rows, void* scratch) noexcept;

  /// The memory that a piece goes to: planes that begin with its first sample.
  struct Target {
    const Planes<T>* planes = nullptr;  ///< of every vector output
    SampleStatus* status = nullptr;     ///< may be null
    T* curvature[kCurvatureKinds] = {}; ///< may be null
    DrainQueue<T>* drain = nullptr;     ///< may be null
    bool streaming = false;             ///< see OutputPlan::put_directly()
    const Planes<T>* next = nullptr;    ///< with a drain: the planes of the piece after this one
    std::size_t record = 1;             ///< see GridTask

    /// The piece whose first sample has the caller's index `sample`; its planes are these.
    Target(const OutputPlan<T>& outputs, const Planes<T>* of_sample, std::size_t sample) noexcept
        : planes(of_sample), status(outputs.out().status_at(sample)),
          streaming(outputs.streaming() && !outputs.staged()), record(outputs.record()) {
      for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
        curvature[k] = outputs.out().curvature_at(k, sample);
      }
    }
    /// The piece that is delivered next.
    Target(const OutputPlan<T>& outputs, Delivery<T>& delivery, std::size_t sample) noexcept
        : Target(outputs, delivery.begin(sample), sample) {
      drain = delivery.queue();
      next = delivery.next();
    }
    /// The rest of the piece from one of its samples on, for patches that are no longer staged
    /// together; its planes are formed in `memory`.
    [[nodiscard]] Target from(std::size_t sample,
                              Planes<T> (&memory)[kVectorOutputs]) const noexcept {
      Target rest = *this;
      for (std::size_t g = 0; g < kVectorOutputs; ++g) {
        for (std::size_t c = 0; c < 3; ++c) {
          T* const plane = planes[g].component[c];
          memory[g].component[c] = plane == nullptr ? nullptr : plane + sample;
        }
      }
      for (T*& values : rest.curvature) {
        values = values == nullptr ? nullptr : values + sample;
      }
      rest.planes = memory;
      rest.status = status == nullptr ? nullptr : status + sample;
      rest.streaming = false;
      rest.next = nullptr;
      rest.record = 1;
      return rest;
    }
  };
  /// Evaluates a piece. next: the piece after this one on the same plan, as far as the caller
  /// knows; null otherwise.
  void run(const GridPlan<T>& plan, const GridPiece& piece, const Target& to,
           const GridPiece* next) noexcept;

  /// Whether kernels can take all patches of a call at once: they write outputs to their places, on
  /// few rows, and the patches have one shape.
  [[nodiscard]] static bool runs_at_once(const PatchKernels<T>& kernels,
                                         const OutputPlan<T>& outputs,
                                         const GridPlan<T>& plan) noexcept {
    return !outputs.staged() && kernels.set->places == nullptr && plan.nv() <= kInlineRows;
  }
  /// Evaluates the piece of such a call whose first sample has the caller's index `sample`, without
  /// an evaluator and a delivery, which a call on one patch would feel (a tenth of its time).
  /// Returns the instruction set that ran.
  static Isa run_at_once(const PatchKernels<T>& kernels, const GridPlan<T>& plan,
                         const GridPiece& piece, const OutputPlan<T>& outputs,
                         std::size_t sample) noexcept;

  /// The instruction set of the kernels that ran.
  [[nodiscard]] Isa executed() const noexcept { return executed_; }

private:
  static constexpr std::size_t kInlineRows = 128;

  /// A task is copied in large pieces by the kernels, so with streaming stores it is written one
  /// piece ahead (see src/tables/drain_queue.hpp).
  struct Prepared {
    GridTask<T> task; ///< written by fill()
    RowRun<T>* runs = nullptr;
    std::size_t run_count = 0;
    const GridPlan<T>* plan = nullptr; ///< of runs, with the three below
    std::uint32_t generation = 0;
    std::size_t first_row = 0;
    std::size_t last_row = 0;
    bool ahead = false; ///< the task is that of `piece`
    GridPiece piece{};

    void find_rows(const GridPlan<T>& where, const GridPiece& rows) noexcept;
  };

  /// Writes the task of a piece on rows that these runs describe. bucket, piece.patch: where the
  /// piece's patches are stored.
  static void fill(GridTask<T>& task, const PatchKernels<T>& kernels, const PatchStorage<T>& bucket,
                   const GridPlan<T>& plan, const GridPiece& piece, std::span<const RowRun<T>> runs,
                   const Target& to) noexcept;
  /// Runs a task that has been written.
  static void run_task(GridTask<T>& task, const PatchKernels<T>& kernels,
                       const Target& to) noexcept;
  void run_bucket(const PatchStorage<T>& bucket, const GridPlan<T>& plan, const GridPiece& piece,
                  const Target& to, const GridPiece* next) noexcept;
  void run_mixed(const GridPlan<T>& plan, const GridPiece& piece, const Target& to) noexcept;

  const PatchKernels<T>& kernels_;
  Isa executed_ = Isa::automatic;
  Prepared prepared_[2];
  std::size_t turn_ = 0;
  RowRun<T> inline_runs_[2][kInlineRows];
};

} // namespace simdbezier::detail
