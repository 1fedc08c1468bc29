// From a register of samples to the planes of a task.
#pragma once

#include "kernels/normal_lanes.hpp"
#include "kernels/shape_columns.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The first `active` lanes of a register go to consecutive samples from `at` on.
template <typename V>
struct SampleRange {
  std::size_t patch;
  std::size_t at;
  std::size_t active;
  V x; ///< half-centred, of the whole patch
  V y;

  SIMDBEZIER_INLINE void store(ScalarOf<V>* plane, V value) const {
    if (active == kLanes<V>) {
      store_vector(plane + at, value);
    } else {
      store_first(plane + at, value, active);
    }
  }
};

template <typename V, typename Task>
SIMDBEZIER_INLINE void store_normals(const Task& task, const SampleRange<V>& range,
                                     const SampleJet<V>& jet) {
  using T = ScalarOf<V>;
  V n[3];
  const V squared = cross_product(jet.du, jet.dv, n);
  const V half = broadcast<V>(T(0.5));
  const V minus_half = broadcast<V>(T(-0.5));
  const MaskOf<V> inside =
      (range.x <= half) & (range.x >= minus_half) & (range.y <= half) & (range.y >= minus_half);
  const V floor = select_where<V>(inside, broadcast<V>(task.normal_floor[range.patch]),
                                  broadcast<V>(static_cast<T>(__builtin_inf())));
  normalise(n, squared);
  for (std::size_t c = 0; c < 3; ++c) {
    range.store(task.out[detail::kNormalGroup].component[c], n[c]);
  }
  if (!all_of<V>(squared > floor)) {
    const Suspects row{0, kLanes<V>, range.active, 1, range.at, 0, 1};
    resolve_normals(task, range.patch, row, range.x, range.y, jet.du[0], jet.du[1], jet.du[2],
                    jet.dv[0], jet.dv[1], jet.dv[2], squared, floor);
  }
}

template <typename P, typename V, typename Task>
SIMDBEZIER_INLINE void store_group(const Task& task, detail::Group group,
                                   const SampleRange<V>& range, const V value[3]) {
  const auto& planes = task.out[group];
  for (std::size_t c = 0; c < 3; ++c) {
    if (P::kInSpace || planes.component[c] != nullptr) {
      range.store(planes.component[c], value[c]);
    }
  }
}
template <typename P, typename V, typename Task>
SIMDBEZIER_INLINE void store_if_wanted(const Task& task, detail::Group group,
                                       const SampleRange<V>& range, const V value[3]) {
  if (task.out[group].wanted()) {
    store_group<P>(task, group, range, value);
  }
}

template <typename V, typename Task>
SIMDBEZIER_INLINE void store_curvatures(const Task& task, const SampleRange<V>& range,
                                        const SampleJet<V>& jet) {
  bool wanted = false;
  for (std::size_t k = 0; k < detail::kCurvatures; ++k) {
    wanted = wanted || task.curvature[k] != nullptr;
  }
  if (!wanted) {
    return;
  }
  V curvature[detail::kCurvatures];
  curvatures(jet, curvature);
  for (std::size_t k = 0; k < detail::kCurvatures; ++k) {
    if (task.curvature[k] != nullptr) {
      range.store(task.curvature[k], curvature[k]);
    }
  }
}

/// All outputs that a task wants and a kernel of this plan computes. Without derivatives, positions
/// are wanted.
template <typename P, typename V, typename Task>
SIMDBEZIER_INLINE void store_sample(const Task& task, const SampleRange<V>& range,
                                    const SampleJet<V>& jet) {
  if constexpr (P::kDepth == 0) {
    store_group<P>(task, detail::kPositionGroup, range, jet.position);
  } else {
    store_if_wanted<P>(task, detail::kPositionGroup, range, jet.position);
    store_if_wanted<P>(task, detail::kDuGroup, range, jet.du);
    store_if_wanted<P>(task, detail::kDvGroup, range, jet.dv);
    if (P::kInSpace && task.out[detail::kNormalGroup].wanted()) {
      store_normals(task, range, jet);
    }
  }
  if constexpr (P::kDepth > 1) {
    store_if_wanted<P>(task, detail::kDuuGroup, range, jet.duu);
    store_if_wanted<P>(task, detail::kDuvGroup, range, jet.duv);
    store_if_wanted<P>(task, detail::kDvvGroup, range, jet.dvv);
    if constexpr (P::kInSpace) {
      store_curvatures(task, range, jet);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
