// The second look at the normals of a register of samples that did not all pass the quick test.
#pragma once

#include <limits>

#include "kernels/simd/lanes.hpp"
#include "src/tables/kernel_table.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The normals of a register that are to be looked at: which lanes are samples, and which ones.
/// They are a row, or several.
struct UncertainNormals {
  std::size_t lane;    ///< first lane
  std::size_t columns; ///< lanes a row
  std::size_t active;  ///< of them in the grid
  std::size_t rows;
  std::size_t at;       ///< first sample
  std::size_t row_step; ///< samples from one row to the next
  std::size_t status_step;
  std::size_t value_step = 1; ///< values from one sample's normal to the next
};

/// Returns a floor with which every normal takes a second look.
template <typename V>
SIMDBEZIER_INLINE V no_floor() {
  return broadcast<V>(static_cast<ScalarOf<V>>(__builtin_inf()));
}
/// Returns the patch's floor where t lies in the patch's range, and infinity elsewhere: outside of
/// the patch no bound holds.
template <typename V>
SIMDBEZIER_INLINE V floor_inside(V t, V floor) {
  using T = ScalarOf<V>;
  // These are named, since clang warns of & between calls that give bool.
  const MaskOf<V> below = t <= broadcast<V>(T(0.5));
  const MaskOf<V> above = t >= broadcast<V>(T(-0.5));
  return select_where<V>(below & above, floor, no_floor<V>());
}

/// Resolves, lane by lane, the normals that did not pass. They are rare, so this is kept out of
/// line; vectors come by value, or the fast path would have to keep them in memory.
template <typename V>
SIMDBEZIER_RARE void resolve_normals(const detail::SampleTask<ScalarOf<V>>& task, std::size_t patch,
                                     UncertainNormals s, V x, V y, V squared, V floor) {
  using T = ScalarOf<V>;
  const V vectors[4] = {squared, floor, x, y};
  alignas(64) T lanes[4][kLanes<V>];
  for (int i = 0; i < 4; ++i) {
    store_vector(lanes[i], vectors[i]);
  }
  const detail::Planes<T>& normals = task.out[output_index(Output::normal)];
  for (std::size_t k = 0; k < s.rows * s.active; ++k) {
    const std::size_t i = s.lane + k / s.active * s.columns + k % s.active;
    const std::size_t at = s.at + k / s.active * s.row_step + k % s.active;
    if (lanes[0][i] > lanes[1][i]) {
      continue;
    }
    const detail::NormalQuery<T> query{
        task.shape, task.given.net(patch * task.shape->control_values()), lanes[2][i], lanes[3][i]};
    T normal[3];
    const SampleStatus status = task.resolve_normal(query, normal);
    for (int c = 0; normals.wanted() && c < 3; ++c) {
      normals.component[c][at * s.value_step] = normal[c];
    }
    for (T* const curvature : task.curvature) {
      if (curvature != nullptr && status != SampleStatus::regular) {
        curvature[at] = std::numeric_limits<T>::quiet_NaN();
      }
    }
    if (task.status != nullptr) {
      task.status[at * s.status_step] = status;
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
