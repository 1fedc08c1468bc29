// Scattered samples: chooses a strategy for every register of them.
#pragma once

#include "kernels/scattered/mixed_patches.hpp"
#include "kernels/scattered/patch_runs.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Returns the largest index, 0 where there is none. It is a kernel because only the wider
/// instruction sets have a maximum of unsigned integers.
inline std::uint32_t highest_index(const std::uint32_t* index, std::size_t count) {
  std::uint32_t highest = 0;
  for (std::size_t k = 0; k < count; ++k) {
    highest = highest > index[k] ? highest : index[k];
  }
  return highest;
}

/// Evaluates the last samples, fewer than a register, by way of a register of each array, whose
/// other lanes are the middle of the last patch. second says that evaluate() computes second
/// derivatives.
template <typename T>
SIMDBEZIER_KERNEL void evaluate_rest(const ScatteredTask<T>& task, std::size_t first, bool second,
                                     void (*evaluate)(const ScatteredTask<T>&)) {
  constexpr std::size_t kN = kLanes<vec<T>>;
  const std::size_t active = task.count - first;
  std::uint32_t patch[kN];
  alignas(64) T u[kN];
  alignas(64) T v[kN];
  SampleStatus status[kN];
  alignas(64) T value[kVectorOutputs][3][kN];
  for (std::size_t i = 0; i < kN; ++i) {
    const bool given = i < active;
    patch[i] = task.patch[given ? first + i : task.count - 1];
    u[i] = given ? task.u[first + i] : task.shift;
    v[i] = given ? task.v[first + i] : task.shift;
    status[i] = given && task.status != nullptr ? task.status[first + i] : SampleStatus::regular;
  }
  ScatteredTask<T> part = task;
  part.patch = patch;
  part.u = u;
  part.v = v;
  part.count = part.patches_known = kN;
  part.status = task.status == nullptr ? nullptr : status;
  const auto for_planes = [&](const auto& f) {
    constexpr OutputSelection kSecondOrder = detail::outputs_of_order(2);
    for (std::size_t g = 0; g < kVectorOutputs; ++g) {
      const bool is_second = (kSecondOrder.bits() >> g & 1) != 0;
      for (std::size_t c = 0; c < 3; ++c) {
        if (is_second == second && task.out[g].component[c] != nullptr) {
          f(part.out[g].component[c], task.out[g].component[c] + first, value[g][c]);
        }
      }
    }
  };
  for_planes([](T*& plane, T*, T* values) { plane = values; });
  evaluate(part);
  for_planes([&](T*&, T* to, const T* values) {
    for (std::size_t i = 0; i < active; ++i) {
      to[i] = values[i];
    }
  });
  for (std::size_t i = 0; task.status != nullptr && i < active; ++i) {
    task.status[first + i] = status[i];
  }
}

template <bool kOrigins, detail::OutputSet kOutputs, bool kPrefetch, typename T>
void evaluate_block(const ScatteredTask<T>& task);

/// Evaluates all samples. kPrefetch says that the set is not in a cache. Both cases have code of
/// their own: to prefetch lines that are in the cache costs a third of the speed, and to ask at run
/// time up to a tenth. Sets with origins are always prefetched.
template <bool kOrigins, detail::OutputSet kOutputs, bool kPrefetch, typename V>
SIMDBEZIER_PART void evaluate_samples(const ScatteredTask<ScalarOf<V>>& task) {
  constexpr std::size_t kWide = detail::depth(kOutputs) == 0 ? 2 : 1; // registers for a long run
  constexpr std::size_t kN = kLanes<V>;
  WaitingNormals<kOutputs, V> waiting;
  std::size_t k = 0;
  while (k + kN <= task.count) {
    const std::uint32_t* const patch = task.patch + k;
    if (!all_equal<kN>(patch, *patch)) {
      evaluate_mixed<kOrigins, kOutputs, kPrefetch>(Block<V>(task, k), patch, waiting);
      k += kN;
      continue;
    }
    if constexpr (kWide == 2) {
      if (k + 2 * kN <= task.count && all_equal<kN>(patch + kN, *patch)) {
        const Block<V> pair[2] = {{task, k}, {task, k + kN}};
        evaluate_run<kOrigins, kOutputs, 2>(pair, *patch, waiting);
        k += 2 * kN;
        continue;
      }
    }
    const Block<V> single[1] = {{task, k}};
    evaluate_run<kOrigins, kOutputs, 1>(single, *patch, waiting);
    k += kN;
  }
  waiting.take_root();
  waiting.store(task);
  if (k < task.count) {
    evaluate_rest(task, k, detail::depth(kOutputs) == 2,
                  evaluate_block<kOrigins, kOutputs, kPrefetch, ScalarOf<V>>);
  }
}

template <bool kOrigins, detail::OutputSet kOutputs, bool kPrefetch, typename T>
SIMDBEZIER_KERNEL void evaluate_block(const ScatteredTask<T>& task) {
  evaluate_samples<kOrigins, kOutputs, kPrefetch, vec<T>>(task);
}

template <bool kOrigins, detail::OutputSet kOutputs, typename T>
SIMDBEZIER_PART void evaluate_outputs(const ScatteredTask<T>& task) {
  if (kOrigins || task.prefetch) {
    evaluate_block<kOrigins, kOutputs, true>(task);
  } else {
    evaluate_block<kOrigins, kOutputs, kOrigins>(task);
  }
}

template <bool kOrigins, typename T>
SIMDBEZIER_PART void evaluate_wanted(const ScatteredTask<T>& task) {
  const auto wanted = [&](Output output) __attribute__((always_inline)) {
    return task.out[output_index(output)].wanted();
  };
  if (wanted(Output::normal)) {
    evaluate_outputs<kOrigins, detail::kAnyOutputs>(task);
  } else if (wanted(Output::du) || wanted(Output::dv)) {
    evaluate_outputs<kOrigins, detail::kPositionDerivatives>(task);
  } else if (wanted(Output::position)) {
    evaluate_outputs<kOrigins, detail::kPosition>(task);
  }
}

template <typename T>
SIMDBEZIER_KERNEL void scattered_kernel(ScatteredTask<T>& task) {
  task.executed = Isa::SIMDBEZIER_ISA;
  const auto wanted = [&](Output output) __attribute__((always_inline)) {
    return task.out[output_index(output)].wanted();
  };
  task.origins == nullptr ? evaluate_wanted<false>(task) : evaluate_wanted<true>(task);
  if (wanted(Output::duu) || wanted(Output::duv) || wanted(Output::dvv)) {
    evaluate_outputs<false, detail::kSecondDerivatives>(task);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
