// Chooses the kernels that a call on patches runs. What they have inside for each kind of outputs,
// patches of any shape and scattered samples choose by the task: kernels/shape/shape_kernel.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "src/calls/call.hpp"
#include "src/calls/grid_plan.hpp"
#include "src/choice/line_costs.hpp"
#include "src/choice/measured_call.hpp"
#include "src/choice/row_strips.hpp"
#include "src/choice/strategies.hpp"
#include "src/output/output_plan.hpp"
#include "src/runtime/cache_sizes.hpp"
#include "src/storage/patch_storage.hpp"
#include "src/tables/kernel_table.hpp"
#include "src/tables/mesh_table.hpp"

namespace simdbezier::detail {

/// The kernels that are made for bicubic patches, by what they compute; those of any shape compute
/// every output.
enum class BicubicKernel : std::uint8_t { none, first_order, second_order };

/// The bicubic kernel that computes an output. There is no default, so that compilers warn of an
/// output without an answer.
constexpr BicubicKernel bicubic_kernel(Output output) noexcept {
  switch (output) {
  case Output::position:
  case Output::du:
  case Output::dv:
  case Output::normal:
  case Output::status: // written beside whatever else there is
    return BicubicKernel::first_order;
  case Output::duu:
  case Output::duv:
  case Output::dvv:
    return BicubicKernel::second_order;
  case Output::curvature:
    return BicubicKernel::none;
  }
  return BicubicKernel::none;
}
/// The outputs, status apart, that one of these kernels computes.
constexpr OutputSelection outputs_of(BicubicKernel kernel) noexcept {
  return outputs_where([kernel](Output output) {
    return output != Output::status && bicubic_kernel(output) == kernel;
  });
}

/// The narrowest kernels that compute what is asked for.
struct KernelChoice {
  bool any_shape = false; ///< bicubic patches take the kernels of any shape, too
  bool first = false;     ///< an output of BicubicKernel::first_order is wanted
  OutputSet outputs = kPosition;
  bool second = false; ///< an output of BicubicKernel::second_order is wanted

  /// Wishes: an OutputList of patches or an OutputSelection. compact: KernelTable::compact.
  template <typename Wishes>
  KernelChoice(const Wishes& out, const Components& components, bool compact) noexcept
      : any_shape(compact || out.holds_any(kForAnyShape) || !components.space()),
        first(out.holds_any(kFirstOrder)), second(out.holds_any(kSecondOrder)) {
    const bool p = out.holds(Output::position);
    const bool du = out.holds(Output::du);
    const bool dv = out.holds(Output::dv);
    const bool n = out.holds(Output::normal);
    if (p && !du && !dv) {
      outputs = n ? kPositionNormal : kPosition;
    } else {
      outputs = p && du && dv && !n ? kPositionDerivatives : kAnyOutputs;
    }
  }

private:
  static constexpr OutputSelection kForAnyShape = outputs_of(BicubicKernel::none);
  static constexpr OutputSelection kFirstOrder = outputs_of(BicubicKernel::first_order);
  static constexpr OutputSelection kSecondOrder = outputs_of(BicubicKernel::second_order);
};

/// Whether kernels are to ask for patches before their turn, because the second-level cache has no
/// room for what they read of all. edges: whether they read these as well, which single samples
/// seldom do.
template <typename T>
[[nodiscard]] bool pays_to_prefetch(const PatchStorage<T>& bucket, bool edges) noexcept {
  const NetShape& shape = bucket.shape;
  const std::size_t values = shape.coefficients() + (edges ? shape.edges() : 0);
  return bucket.count * values * sizeof(T) > second_level_cache(); // allocated: no overflow
}

/// Returns how many bytes of samples stay in the first-level cache, beside what kernels read, while
/// one tile follows the other.
[[nodiscard]] inline std::size_t cached_sample_bytes() noexcept {
  constexpr std::size_t kBeside = std::size_t{18} << 10;
  const std::size_t cache = first_level_cache();
  return cache - std::min(kBeside, cache / 8 * 5);
}

/// The kernels of one call.
template <typename T>
struct PatchKernels {
  const SetStorage<T>* set;
  const KernelTable<T>* table;
  KernelChoice choice;
  bool watertight;
  bool by_lines;                ///< as GridTask has it
  bool plain_to_memory = false; ///< likewise
  StrategySet allowed = allowed_strategies();
  std::size_t first_component;

  template <typename Wishes>
  PatchKernels(const SetStorage<T>& storage, const Request<T>& request, const Wishes& out,
               const Options& options) noexcept
      : set(&storage), table(request.table),
        choice(out, request.components, request.table->compact), watertight(options.watertight),
        by_lines(splits_slowly(*request.table)), first_component(request.components.first) {}

  /// Takes into account how much is written, and which way. What leaves the caches by plain stores
  /// does so in whole lines, because these are not read first.
  void expect_output(std::size_t bytes, Way way) noexcept {
    plain_to_memory = way == Way::cache && exceeds_caches(bytes);
    by_lines = by_lines || plain_to_memory;
  }

  /// What kernels write to its final place by themselves, on grids of `nu` columns or more: all of
  /// it where one kernel knows all outputs, and all patches are bicubic.
  [[nodiscard]] DirectRows direct_rows(std::size_t nu) const noexcept {
    const bool bicubic =
        !choice.any_shape && set->places == nullptr && set->buckets[0].shape.is_bicubic();
    const bool one_pass = !choice.second && choice.outputs != kAnyOutputs;
    return {.row = bicubic && one_pass ? nu : 0,
            .lanes = table->lanes,
            .records = table->puts_records && watertight && has_no_origins() &&
                       allowed.has(GridStrategy::records)};
  }
  /// Likewise on one grid for all patches, past the caches as well.
  [[nodiscard]] DirectRows direct_rows(const GridPlan<T>& plan) const noexcept {
    DirectRows rows = direct_rows(plan.nu());
    // Kernels stream whole lines, of one register or, where that pays, of two.
    const bool lines = table->lanes * sizeof(T) == 64;
    rows.streamed = lines || streams_pairs();
    rows.streamed_anywhere = allowed.has(GridStrategy::streamed_order) && turns_rows(plan);
    rows.same_place = choice.outputs == kPositionNormal;
    rows.streamed_records = rows.records && lines;
    return rows;
  }

  void run(GridTask<T>& task) const noexcept {
    if (choice.any_shape || !task.shape->is_bicubic()) {
      run(table->shapes->grid, kAnyOutputs, task);
      return;
    }
    if (choice.first) {
      run(table->grid[choice.outputs], choice.outputs, task);
    }
    if (choice.second) {
      run(table->grid[kSecondDerivatives], kSecondDerivatives, task);
    }
  }

  /// Whether there is a kernel for edges between patches of this shape.
  [[nodiscard]] bool has_edges(const NetShape& shape) const noexcept {
    return !choice.any_shape && watertight && shape.is_bicubic();
  }
  void run(EdgeTask<T>& task) const noexcept { table->meshes->edges(task); }

  void run(ScatteredTask<T>& task) const noexcept { table->shapes->scattered(task); }

private:
  [[nodiscard]] bool has_no_origins() const noexcept { return set->buckets[0].origins == nullptr; }

  /// Whether kernels can turn registers to where lines are, of one register or two.
  [[nodiscard]] bool makes_lines(std::size_t registers) const noexcept {
    return has_no_origins() && !table->compact && registers * table->lanes * sizeof(T) == 64;
  }
  [[nodiscard]] bool streams_pairs() const noexcept {
    return allowed.has(GridStrategy::streamed_rows) && makes_lines(2) &&
           choice.outputs != kPositionNormal;
  }

  /// Whether grids are streamed row by row, wherever rows begin. Others are faster by way of
  /// staging (docs/experiments.md, To memory): nearly all of a patch's time goes to preparing it,
  /// or the last registers of rows are too empty.
  [[nodiscard]] bool turns_rows(const GridPlan<T>& plan) const noexcept {
    const std::size_t nu = plan.nu();
    const std::size_t lanes = table->lanes;
    const std::size_t idle = (lanes - nu % lanes) % lanes; // of the last register
    const bool line = makes_lines(1);                      // each register; otherwise two of them
    if ((!line && !makes_lines(2)) || nu > kMostStreamedRegisters * lanes) {
      return false;
    }
    if (choice.outputs == kPositionNormal) {
      const bool single = nu > lanes && nu % lanes == 1; // a column, of which lanes are rows
      const bool filled =
          idle == 0 ? nu >= 16 : 2 * nu >= 3 * lanes && 10 * idle <= 3 * (nu + idle);
      return line && (single || filled);
    }
    // Two registers are one tile, and of a line each the column behind them.
    const bool position = choice.outputs == kPosition;
    const std::size_t shortest = lanes < 16 ? 40 / sizeof(T) : 9;
    const std::size_t widest = line ? 2 * lanes + 1 : 2 * lanes - 1;
    if (idle != 0 && nu >= shortest && nu <= widest) {
      return true;
    }
    const std::size_t least = position ? 2 * lanes + lanes / 2 : 2 * lanes - 1;
    return line ? nu >= least : idle != 0 && nu >= 3 * lanes;
  }

  void run(void (*kernel)(GridTask<T>&), OutputSet outputs, GridTask<T>& task) const noexcept {
    const std::size_t most = strip_rows(task, outputs, table->lanes * sizeof(T));
    const bool strips = allowed.has(GridStrategy::strips) && most <= kMostStripRows;
    if (strips && fills_strips(task, most)) [[unlikely]] {
      in_strips(task, most, kernel);
      task.taken.add(GridStrategy::strips);
    } else {
      kernel(task);
    }
    note_strategies(task.taken);
  }
};

} // namespace simdbezier::detail
