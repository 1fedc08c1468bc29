// Scattered samples: chooses a strategy for every register of them.
#pragma once

#include "kernels/scattered/mixed_patches.hpp"
#include "kernels/scattered/patch_runs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// 0 where there is none. Here because vectors of unsigned integers have a maximum in the wider
/// instruction sets only.
inline std::uint32_t highest_index(const std::uint32_t* index, std::size_t count) {
  std::uint32_t highest = 0;
  for (std::size_t k = 0; k < count; ++k) {
    highest = highest > index[k] ? highest : index[k];
  }
  return highest;
}

/// The last samples, fewer than a register: the register is filled with copies of the last one.
template <bool kOrigins, Outcome kOutcome, typename V>
__attribute__((noinline)) void evaluate_rest(const ScatteredTask<ScalarOf<V>>& task,
                                             std::size_t first) {
  using T = ScalarOf<V>;
  const std::size_t active = task.count - first;
  alignas(64) T u[kLanes<V>];
  alignas(64) T v[kLanes<V>];
  std::uint32_t patch[kLanes<V>];
  for (std::size_t i = 0; i < kLanes<V>; ++i) {
    const std::size_t from = first + (i < active ? i : active - 1);
    u[i] = task.u[from];
    v[i] = task.v[from];
    patch[i] = task.patch[from];
  }
  WaitingNormals<kOutcome, V> none;
  evaluate_mixed<kOrigins, kOutcome, false>(Block<false, V>(task, first, active, u, v), patch,
                                            none);
}

/// kPrefetch: the set is not in a cache. Code of its own for each: asking for lines that are there
/// costs a third of the speed, and the question whether to ask, up to a tenth.
template <bool kOrigins, Outcome kOutcome, bool kPrefetch, typename V>
SIMDBEZIER_INLINE void evaluate_samples(const ScatteredTask<ScalarOf<V>>& task) {
  constexpr std::size_t kWide = kOutcome == kPositions ? 2 : 1; // registers for a long run
  constexpr std::size_t kN = kLanes<V>;
  const auto block = [&](std::size_t k) __attribute__((always_inline)) {
    return Block<true, V>(task, k, kN, task.u + k, task.v + k);
  };
  WaitingNormals<kOutcome, V> waiting;
  std::size_t k = 0;
  while (k + kN <= task.count) {
    const std::uint32_t* const patch = task.patch + k;
    if (!all_equal<kN>(patch, *patch)) {
      evaluate_mixed<kOrigins, kOutcome, kPrefetch>(block(k), patch, waiting);
      k += kN;
      continue;
    }
    if constexpr (kWide == 2) {
      if (k + 2 * kN <= task.count && all_equal<kN>(patch + kN, *patch)) {
        const Block<true, V> pair[2] = {block(k), block(k + kN)};
        evaluate_run<kOrigins, kOutcome, 2>(pair, *patch, waiting);
        k += 2 * kN;
        continue;
      }
    }
    const Block<true, V> single[1] = {block(k)};
    evaluate_run<kOrigins, kOutcome, 1>(single, *patch, waiting);
    k += kN;
  }
  waiting.take_root();
  waiting.store(task);
  if (k < task.count) {
    evaluate_rest<kOrigins, kOutcome, V>(task, k);
  }
}

template <bool kOrigins, Outcome kOutcome, bool kPrefetch, typename T>
__attribute__((noinline)) void evaluate_block(const ScatteredTask<T>& task) {
  if constexpr (kIsScalar<vec<T>>) {
    for (std::size_t k = 0; k < task.count; ++k) {
      evaluate_sample<kOutcome == kSecondOrder>(task, k);
    }
  } else {
    evaluate_samples<kOrigins, kOutcome, kPrefetch, vec<T>>(task);
  }
}

template <bool kOrigins, Outcome kOutcome, typename T>
SIMDBEZIER_INLINE void evaluate_outcome(const ScatteredTask<T>& task) {
  if (task.prefetch && !kIsScalar<vec<T>>) {
    evaluate_block<kOrigins, kOutcome, true>(task);
  } else {
    evaluate_block<kOrigins, kOutcome, false>(task);
  }
}

template <bool kOrigins, typename T>
SIMDBEZIER_INLINE void evaluate_wanted(const ScatteredTask<T>& task) {
  const auto wanted = [&](detail::Group group) __attribute__((always_inline)) {
    return task.out[group].wanted();
  };
  if (wanted(detail::kNormalGroup)) {
    evaluate_outcome<kOrigins, kNormals>(task);
  } else if (wanted(detail::kDuGroup) || wanted(detail::kDvGroup)) {
    evaluate_outcome<kOrigins, kFirstOrder>(task);
  } else if (wanted(detail::kPositionGroup)) {
    evaluate_outcome<kOrigins, kPositions>(task);
  }
}

template <typename T>
void scattered_kernel(ScatteredTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  const auto wanted = [&](detail::Group group) __attribute__((always_inline)) {
    return task.out[group].wanted();
  };
  task.origins == nullptr ? evaluate_wanted<false>(task) : evaluate_wanted<true>(task);
  if (wanted(detail::kDuuGroup) || wanted(detail::kDuvGroup) || wanted(detail::kDvvGroup)) {
    evaluate_outcome<false, kSecondOrder>(task);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
