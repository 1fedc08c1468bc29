// Stores a register of samples in the planes of a task.
#pragma once

#include "kernels/poly/normal_lanes.hpp"
#include "kernels/shape/curvatures.hpp"
#include "kernels/shape/shape_columns.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

using detail::SampleTask;

/// The first `active` lanes of a register go to consecutive samples from `at` on.
template <typename V>
struct SampleRange {
  std::size_t patch;
  std::size_t at;
  std::size_t active;
  std::size_t first_plane; ///< of those of an output
  V x;                     ///< half-centred, of the whole patch
  V y;
  V floor; ///< |du x dv|^2 at or below it is for the second look; see patch_floor()

  SIMDBEZIER_PART void store(ScalarOf<V>* plane, V value) const {
    if (active == kLanes<V>) {
      store_vector(plane + at, value);
    } else {
      store_first(plane + at, value, active);
    }
  }
};

/// Returns the floor of all samples of a patch. Those of a rational one have floors of their own
/// above it.
template <typename P, typename V>
SIMDBEZIER_PART V patch_floor(const SampleTask<ScalarOf<V>>& task, std::size_t patch) {
  using T = ScalarOf<V>;
  return broadcast<V>(P::kWeighted ? kLeastSquare<T> : task.normal_floor[patch]);
}

/// Returns the floor of samples on rational patches, from the sizes of the patches' errors; see
/// ShapeFloor.
template <typename V>
SIMDBEZIER_PART V rational_floor(V patch_u, V patch_v, V floor, const SampleJet<V>& jet,
                                 V squared) {
  const V inverse2 = jet.inverse_weight * jet.inverse_weight;
  const V size_u = patch_u * inverse2;
  const V size_v = patch_v * inverse2;
  for (std::size_t c = 0; c < 3; ++c) {
    const V turned_u = size_u * jet.dv[c];
    const V turned_v = size_v * jet.du[c];
    floor = madd(turned_u, turned_u, madd(turned_v, turned_v, floor));
  }
  return select_where<V>(squared < no_floor<V>(), floor, no_floor<V>());
}

/// Returns what |du x dv|^2 of samples has to be above.
template <typename P, typename V>
SIMDBEZIER_PART V normal_floor(const SampleTask<ScalarOf<V>>& task, const SampleRange<V>& range,
                               const SampleJet<V>& jet, V squared) {
  if constexpr (P::kWeighted) {
    const ScalarOf<V>* const sizes = task.normal_floor + 2 * range.patch;
    return rational_floor(broadcast<V>(sizes[0]), broadcast<V>(sizes[1]), range.floor, jet,
                          squared);
  } else {
    return range.floor;
  }
}

/// Takes the second look at samples whose |du x dv|^2 is not above their floor.
template <typename P, typename V>
SIMDBEZIER_PART void look_again(const SampleTask<ScalarOf<V>>& task, const SampleRange<V>& range,
                                const SampleJet<V>& jet, V squared) {
  const V floor = normal_floor<P>(task, range, jet, squared);
  if (!all_of<V>(squared > floor)) {
    const UncertainNormals row{0, kLanes<V>, range.active, 1, range.at, 0, 1};
    resolve_normals(task, range.patch, row, range.x, range.y, squared, floor);
  }
}

/// Stores normals before any second look, and returns |du x dv|^2.
template <typename V>
SIMDBEZIER_PART V store_first_normals(const SampleTask<ScalarOf<V>>& task,
                                      const SampleRange<V>& range, const SampleJet<V>& jet) {
  V n[3];
  const V squared = cross_product(jet.du, jet.dv, n);
  normalise(n, squared);
  repeat<3>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
    range.store(task.out[output_index(Output::normal)].component[c], n[c]);
  });
  return squared;
}

template <typename P, typename V>
SIMDBEZIER_PART void store_normals(const SampleTask<ScalarOf<V>>& task, const SampleRange<V>& range,
                                   const SampleJet<V>& jet) {
  look_again<P>(task, range, jet, store_first_normals(task, range, jet));
}

template <typename P, typename V>
SIMDBEZIER_PART void store_group(const SampleTask<ScalarOf<V>>& task, Output output,
                                 const SampleRange<V>& range, const V value[3]) {
  repeat<P::Slots::kMost>([&](std::size_t c) SIMDBEZIER_INLINE_LAMBDA {
    ScalarOf<V>* const plane = task.out[output_index(output)].component[range.first_plane + c];
    if ((P::kKnown && P::kDepth == 0) || plane != nullptr) {
      range.store(plane, value[c]);
    }
  });
}

/// Registers of samples that are evaluated one behind the other before they are stored, so that
/// their roots and divisions are under way together.
inline constexpr std::size_t kTogether = 8;

/// Stores values of several registers in one plane. step is the distance from one value to the
/// next.
template <typename V>
SIMDBEZIER_PART void store_values(ScalarOf<V>* plane, const SampleRange<V>* range, const V* value,
                                  std::size_t step, std::size_t count) {
  const std::size_t active = range[0].active; // of all of them
  if (plane == nullptr) {
    return;
  }
  for (std::size_t i = 0; active == kLanes<V> && i < count; ++i) {
    store_vector(plane + range[i].at, value[i * step]);
  }
  for (std::size_t i = 0; active < kLanes<V> && i < count; ++i) {
    store_first(plane + range[i].at, value[i * step], active);
  }
}

/// Stores the curvatures of one register of samples in the planes that are wanted.
template <typename V>
SIMDBEZIER_PART void store_curvature(ScalarOf<V>* const* plane, bool all_whole,
                                     const SampleRange<V>& range, const V* curvature) {
  if (all_whole) { // nothing has to be asked
    const std::size_t at = range.at;
    repeat<kCurvatureKinds>(
        [&](std::size_t k) SIMDBEZIER_INLINE_LAMBDA { store_vector(plane[k] + at, curvature[k]); });
    return;
  }
  for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
    if (plane[k] != nullptr) {
      range.store(plane[k], curvature[k]);
    }
  }
}

/// Stores curvatures. They become nan afterwards where a sample has no normal, or only a limit of
/// one.
template <typename P, typename V>
SIMDBEZIER_PART void store_curvatures(const SampleTask<ScalarOf<V>>& task,
                                      const SampleRange<V>* range, const SampleJet<V>* jet,
                                      std::size_t count) {
  CurvatureFrame<V> frame[kTogether];
  V n[3];
  MaskOf<V> all_regular(true);
  for (std::size_t i = 0; i < count; ++i) {
    frame[i].find(jet[i]);
    const V squared = cross_product(jet[i].du, jet[i].dv, n);
    const MaskOf<V> regular = squared > normal_floor<P>(task, range[i], jet[i], squared);
    all_regular = all_regular & regular;
  }
  ScalarOf<V>* const plane[kCurvatureKinds] = {task.curvature[0], task.curvature[1],
                                               task.curvature[2], task.curvature[3]};
  bool all_whole = range[0].active == kLanes<V>;
  for (ScalarOf<V>* const each : plane) {
    all_whole = all_whole && each != nullptr;
  }
  for (std::size_t i = 0; i < count; ++i) {
    V curvature[kCurvatureKinds];
    curvatures(jet[i], frame[i], curvature);
    store_curvature(plane, all_whole, range[i], curvature);
  }
  for (std::size_t i = 0; i < count && !all_of<V>(all_regular); ++i) {
    look_again<P>(task, range[i], jet[i], cross_product(jet[i].du, jet[i].dv, n));
  }
}

template <typename T>
SIMDBEZIER_PART bool wants_curvatures(const SampleTask<T>& task) {
  bool wanted = false;
  for (std::size_t k = 0; k < kCurvatureKinds; ++k) {
    wanted = wanted || task.curvature[k] != nullptr;
  }
  return wanted;
}

/// Stores all outputs of order 0 and 1 that a task wants and a kernel of this plan computes.
template <typename P, typename V>
SIMDBEZIER_PART void store_sample(const SampleTask<ScalarOf<V>>& task, const SampleRange<V>& range,
                                  const SampleJet<V>& jet) {
  store_group<P>(task, Output::position, range, jet.position);
  if constexpr (P::kDepth > 0) {
    store_group<P>(task, Output::du, range, jet.du);
    store_group<P>(task, Output::dv, range, jet.dv);
    if (!P::kSingle && task.out[output_index(Output::normal)].wanted()) {
      store_normals<P>(task, range, jet);
    }
  }
}

/// Stores all outputs of at most kTogether registers of the same columns, from memory. It is a
/// function for all degrees.
template <typename P, typename V>
SIMDBEZIER_KERNEL void store_jets(const SampleTask<ScalarOf<V>>& task, const SampleRange<V>* range,
                                  const SampleJet<V>* jet, std::size_t count) {
  constexpr V(SampleJet<V>::*kMember[])[3] = {&SampleJet<V>::position, &SampleJet<V>::du,
                                              &SampleJet<V>::dv,       &SampleJet<V>::duu,
                                              &SampleJet<V>::duv,      &SampleJet<V>::dvv};
  constexpr std::size_t kMembers[] = {1, 3, 6}; // in the order of Output
  for (std::size_t g = 0; g < kMembers[P::kDepth]; ++g) {
    for (std::size_t c = 0; task.out[g].wanted() && c < 3; ++c) {
      store_values(task.out[g].component[c], range, jet[0].*kMember[g] + c,
                   sizeof(SampleJet<V>) / sizeof(V), count);
    }
  }
  if constexpr (P::kDepth > 0) {
    for (std::size_t i = 0; task.out[output_index(Output::normal)].wanted() && i < count; ++i) {
      store_normals<P>(task, range[i], jet[i]);
    }
  }
  if constexpr (P::kDepth > 1) {
    if (wants_curvatures(task)) {
      store_curvatures<P>(task, range, jet, count);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
