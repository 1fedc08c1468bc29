// What the calls on curves share: how outputs are delivered, and pieces of work as tasks.
#pragma once

#include <algorithm>
#include <cmath>

#include <simdbezier/curves.hpp>

#include "src/calls/call.hpp"
#include "src/calls/grid_plan.hpp"
#include "src/exact/tangent_fallback.hpp"
#include "src/output/delivery.hpp"
#include "src/runtime/cache_sizes.hpp"
#include "src/storage/curve_storage.hpp"
#include "src/tables/curve_table.hpp"

namespace simdbezier::detail {

/// How the vectors of a call are delivered; curvatures are always written directly.
template <typename T>
[[nodiscard]] OutputPlan<T> plan_outputs(const OutputList<T>& out, Way way) noexcept {
  return {out, out.wants_vectors() ? way : Way::cache};
}

/// Fills in what tasks of all kinds have in common, for curves from `first` on and samples from
/// `sample` on.
template <typename T>
void fill_arrays(CurveArrays<T>& task, const CurveStorage<T>& curves, std::size_t first,
                 const OutputList<T>& out, std::size_t sample, const Planes<T>* planes,
                 std::size_t first_component) noexcept {
  const CurveShape& shape = curves.shape;
  task.shape = &shape;
  task.values = curves.values + first * shape.values();
  task.given = curves.given.from(first * shape.control_values());
  task.tangent_floor = curves.tangent_floor + first;
  std::copy_n(planes, kCurveVectorOutputs, task.out);
  task.curvature = out.curvature_at(0, sample);
  task.status = out.status_at(sample);
  task.first_component = first_component;
  task.resolve_tangent = resolve_tangent<T>;
  task.prefetch = curves.count > second_level_cache() / (shape.values() * sizeof(T));
}

/// x y z side by side, sample after sample.
template <typename T>
[[nodiscard]] bool are_triples(const Vectors<T>& v) noexcept {
  return v.stride == 3 && v.y == v.x + 1 && v.z == v.x + 2;
}

/// Curves [curve, curve + curves) on samples [first, last) of one plan.
struct CurvePiece {
  std::size_t curve;
  std::size_t curves;
  std::size_t first;
  std::size_t last;
};

/// Samples of a piece of a call on `samples` where outputs are staged: curves are short, and a
/// piece of fewer than two of the kernels' blocks (kernels/curve/curve_blocks.hpp) costs more than
/// it gains by staying in the first-level cache.
template <typename T>
[[nodiscard]] std::size_t staged_samples(const OutputPlan<T>& outputs,
                                         std::size_t samples) noexcept {
  constexpr std::size_t kLeast = 512;
  return std::max(std::min(Delivery<T>::chunk_samples(outputs), samples), kLeast);
}

/// The kernels of one call on grids, and what all of its threads share.
template <typename T>
struct CurveKernels {
  const CurveStorage<T>& curves;
  const KernelTable<T>& table;
  std::size_t first_component;
  std::size_t chunk_samples; ///< of the longest piece
  bool rows = false;         ///< kernels write the outputs' own layout, not staged

  [[nodiscard]] std::size_t delivery_bytes(const OutputPlan<T>& outputs) const noexcept {
    return whole_lines(
        Delivery<T>::scratch_bytes(outputs.staged_planes(), outputs.streaming(), chunk_samples));
  }

  /// `sample`: where the piece's first one goes.
  Isa run(const GridPlan<T>& plan, const CurvePiece& piece, std::size_t sample,
          const OutputPlan<T>& outputs, Delivery<T>& delivery) const noexcept {
    CurveTask<T> task{};
    fill_arrays(task, curves, piece.curve, outputs.out(), sample, delivery.begin(sample),
                first_component);
    task.curve_count = piece.curves;
    task.x = plan.x() + piece.first;
    task.n = piece.last - piece.first;
    task.rows = rows;
    const Vectors<T>& position = outputs.out()[CurveOutput::position];
    if (rows && are_triples(position)) {
      task.triples = position.x + 3 * sample;
    }
    task.streaming = outputs.streaming() && !outputs.staged();
    task.drain = delivery.queue();
    if (task.status != nullptr) {
      for (std::size_t k = 0; k < task.curve_count * task.n; ++k) {
        task.status[k] =
            std::isnan(task.x[k % task.n]) ? SampleStatus::non_finite : SampleStatus::regular;
      }
    }
    table.curves->grid(task);
    delivery.end(task.curve_count * task.n);
    return task.executed;
  }
};

} // namespace simdbezier::detail
