// A register of samples of different patches, without gathers.
//
// A patch's line holds, for each power of X, the powers of Y side by side: kQuad of them are the
// 128-bit lane of one sample. The samples of a register form kQuad groups; group g has the samples
// g, kQuad + g, 2 kQuad + g, …, one in each lane. Horner's rule in X runs on groups (X broadcast
// within lanes); transposing the groups within lanes then puts the samples, in their order, side by
// side for Horner's rule in Y. No permutation but those of the loads crosses lanes.
#pragma once

#include "kernels/scattered_block.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Horner in X for one group, all components.
template <std::size_t kGroup, Outcome kOutcome, typename V>
SIMDBEZIER_INLINE void evaluate_group(const ScalarOf<V>* coefficients, const std::uint32_t* patch,
                                      V all_x, Polynomials<kOutcome, V> q[3]) {
  using T = ScalarOf<V>;
  constexpr std::size_t kParts = kOrder / kQuad<V>; // of a row of powers of Y
  const V x = lane_broadcast<kGroup>(all_x);
  const T* from[kQuads<V>];
  for (std::size_t lane = 0; lane < kQuads<V>; ++lane) {
    from[lane] =
        coefficients + std::size_t{patch[lane * kQuad<V> + kGroup]} * detail::kCoefficients;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    V chunk[kParts][4];
    for (std::size_t line = 0; line < kParts; ++line) {
      load_quads<V>(from, chunk[line]);
      for (std::size_t lane = 0; lane < kQuads<V>; ++lane) {
        from[lane] += 4 * kQuad<V>;
      }
    }
    for (std::size_t part = 0; part < kParts; ++part) {
      V k[kOrder];
      for (std::size_t i = 0; i < kOrder; ++i) {
        const std::size_t at = i * kParts + part;
        k[i] = chunk[at / 4][at % 4];
      }
      q[c].set(part * kQuad<V> + kGroup, k, x);
    }
  }
}

template <Outcome kOutcome, typename V>
SIMDBEZIER_INLINE void groups_to_powers(Polynomials<kOutcome, V>& q) {
  for (std::size_t derivative = 0; derivative < kOutcome; ++derivative) {
    for (std::size_t l = 0; l < kOrder; l += kQuad<V>) {
      lane_transpose(q.power[derivative] + l);
    }
  }
}

/// patch: one index for each lane.
template <Scheme kScheme, Outcome kOutcome, bool kFull, typename V>
SIMDBEZIER_INLINE void evaluate_mixed(const Block<kFull, V>& block, const std::uint32_t* patch) {
  const auto& task = block.task;
  Polynomials<kOutcome, V> q[3];
  evaluate_group<0>(task.coefficients, patch, block.x, q);
  evaluate_group<1>(task.coefficients, patch, block.x, q);
  if constexpr (kQuad<V> == 4) {
    evaluate_group<2>(task.coefficients, patch, block.x, q);
    evaluate_group<3>(task.coefficients, patch, block.x, q);
  }
  Tangents<kOutcome, V> tangents;
  for (std::size_t c = 0; c < 3; ++c) {
    groups_to_powers(q[c]);
    V origin = block.x; // not used
    if constexpr (has_origins(kScheme)) {
      origin = gather_lanes<V>(task.origins + c * detail::kOriginsPerComponent, patch,
                               detail::kOriginBlock);
    }
    finish_component<kScheme>(block, q[c], c, origin, tangents);
  }
  finish_block<kScheme>(
      block, tangents, [&]() __attribute__((always_inline)) {
        return gather_lanes<V>(task.normal_floor, patch, 1);
      });
}

/// Asks for the lines of the samples that come `kAhead` samples later.
template <typename V>
SIMDBEZIER_INLINE void prefetch_mixed(const ScatteredTask<ScalarOf<V>>& task, std::size_t k) {
  using T = ScalarOf<V>;
  constexpr std::size_t kAhead = 48;
  constexpr std::size_t kLine = 64 / sizeof(T);
  if (task.patches_known < k + kAhead + kLanes<V>) {
    return;
  }
  const std::uint32_t* const patch = task.patch + k + kAhead;
  for (std::size_t i = 0; i < kLanes<V>; ++i) {
    const T* const from = task.coefficients + std::size_t{patch[i]} * detail::kCoefficients;
    for (std::size_t line = 0; line < detail::kCoefficients; line += kLine) {
      __builtin_prefetch(from + line);
    }
    if (task.out[detail::kNormalGroup].wanted()) {
      __builtin_prefetch(task.normal_floor + patch[i]);
    }
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
