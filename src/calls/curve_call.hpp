// What the evaluate calls for curves share: checks of their outputs, and tasks.
#pragma once

#include <cmath>

#include <simdbezier/curves.hpp>

#include "src/calls/grid_plan.hpp"
#include "src/calls/grid_request.hpp"
#include "src/exact/tangent_fallback.hpp"
#include "src/output/delivery.hpp"
#include "src/runtime/batch.hpp"
#include "src/runtime/dispatch.hpp"
#include "src/tables/curve_table.hpp"

namespace simdbezier::detail {

/// Where the groups of curves travel among those of patches, whose plans and deliveries they use.
inline constexpr Group kCurveGroupOf[kCurveGroups] = {kPositionGroup, kDuGroup, kDuuGroup,
                                                      kNormalGroup};

template <typename T>
Outputs<T> as_outputs(const CurveOutputs<T>& out) noexcept {
  Outputs<T> outputs;
  outputs.position = out.position;
  outputs.du = out.d1;
  outputs.duu = out.d2;
  outputs.normal = out.tangent;
  outputs.curvature.gaussian = out.curvature; // for its checks
  outputs.status = out.status;
  return outputs;
}

template <typename T>
bool wants_vectors(const CurveOutputs<T>& out) noexcept {
  return out.position.wanted() || out.d1.wanted() || out.d2.wanted() || out.tangent.wanted();
}

/// How the vectors of a call are delivered; curvatures are always written directly. groups: those
/// of as_outputs(), alive as long as the plan.
template <typename T>
OutputPlan<T> plan_outputs(const CurveOutputs<T>& out, const Outputs<T>& groups,
                           std::size_t samples, Destination destination) noexcept {
  return {groups, samples, wants_vectors(out) ? destination : Destination::cache};
}

/// ok | bad_components | null_output | bad_stride | overlapping_outputs | size_overflow, for
/// `samples` samples of the components chosen among those of a set.
template <typename T>
[[nodiscard]] Status check_curve_outputs(const CurveOutputs<T>& out, std::size_t samples,
                                         int components, const Components& chosen,
                                         const InputRange* inputs,
                                         std::size_t input_count) noexcept {
  const bool bent = out.tangent.wanted() || out.curvature != nullptr;
  if (bent && (chosen.first != 0 || components < 2 || components > 3)) {
    return Status::bad_components;
  }
  return check_outputs(as_outputs(out), samples, chosen.dimension, true, inputs, input_count);
}

/// Fills what tasks of all kinds have in common, for curves from `first` on and samples from
/// `sample` on.
template <typename T>
void fill_arrays(CurveArrays<T>& task, const CurveStorage<T>& curves, std::size_t first,
                 const CurveOutputs<T>& out, std::size_t sample, const Planes<T>* planes,
                 std::size_t first_component) noexcept {
  const CurveShape& shape = curves.shape;
  task.shape = &shape;
  task.values = curves.values + first * shape.values();
  task.given = curves.given.from(first * shape.control_values());
  task.tangent_floor = curves.tangent_floor + first;
  for (std::size_t g = 0; g < kCurveGroups; ++g) {
    task.out[g] = planes[kCurveGroupOf[g]];
  }
  task.curvature = out.curvature == nullptr ? nullptr : out.curvature + sample;
  task.status = out.status == nullptr ? nullptr : out.status + sample;
  task.first_component = first_component;
  task.resolve_tangent = resolve_tangent<T>;
  task.prefetch = curves.count > second_level_cache() / (shape.values() * sizeof(T));
}

/// Whether kernels can write rows: three components of positions, nothing else.
template <typename T>
bool may_be_rows(const CurveShape& shape, const CurveOutputs<T>& out,
                 const KernelTable<T>& table) noexcept {
  const bool alone = !out.d1.wanted() && !out.d2.wanted() && !out.tangent.wanted() &&
                     out.curvature == nullptr && out.position.z != nullptr;
  return alone && !shape.rational && shape.cells() == 1 && table.lanes > 1;
}

/// x y z side by side, sample after sample.
template <typename T>
bool are_triples(const Vectors<T>& v) noexcept {
  return v.stride == 3 && v.y == v.x + 1 && v.z == v.x + 2;
}

/// A grid of one row: parameters are those of patches.
template <typename T>
Status build_plan(GridPlan<T>& plan, const CurveGrid<T>& grid, T* memory = nullptr) noexcept {
  constexpr T kRow = 0;
  return plan.build(Grid<T>{grid.n, 1, grid.t, &kRow, grid.parameters}, memory);
}

/// Curves [curve, curve + curves) on samples [first, last) of one plan.
struct CurvePiece {
  std::size_t curve;
  std::size_t curves;
  std::size_t first;
  std::size_t last;
};

/// What all threads of a call share.
template <typename T>
struct CurveCall {
  const CurveStorage<T>& curves;
  const KernelTable<T>& table;
  const CurveOutputs<T>& out;
  const OutputPlan<T>& outputs;
  std::size_t first_component;
  std::size_t chunk_samples; ///< of the longest piece
  bool rows = false;         ///< kernels write the outputs' own layout, not staged

  [[nodiscard]] std::size_t delivery_bytes() const noexcept {
    return whole_lines(
        Delivery<T>::scratch_bytes(outputs.staged_planes(), outputs.streaming(), chunk_samples));
  }

  /// `sample`: where the piece's first one goes.
  Isa run(const GridPlan<T>& plan, const CurvePiece& piece, std::size_t sample,
          Delivery<T>& delivery) const noexcept {
    CurveTask<T> task{};
    fill_arrays(task, curves, piece.curve, out, sample, delivery.begin(sample), first_component);
    task.curve_count = piece.curves;
    task.x = plan.x() + piece.first;
    task.n = piece.last - piece.first;
    task.rows = rows;
    if (rows && are_triples(out.position)) {
      task.triples = out.position.x + 3 * sample;
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
