// A register of samples of different patches, without gathers.
//
// A patch's line holds, for each power of X, the powers of Y side by side: kQuad of them are the
// 128-bit lane of one sample. The samples of a register form kQuad groups; group g has the samples
// g, kQuad + g, 2 kQuad + g, …, one in each lane. Horner's rule in X runs on groups (X broadcast
// within lanes); transposing the groups within lanes then puts the samples, in their order, side by
// side for the rows in Y. No permutation but those of the loads crosses lanes.
#pragma once

#include "kernels/scattered/scattered_block.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// Asks for the samples that come `kAhead` samples after those of a block, or for nothing.
template <bool kPrefetch, detail::OutputSet kOutputs, typename V>
class Ahead {
public:
  SIMDBEZIER_PART Ahead(const ScatteredTask<ScalarOf<V>>&, std::size_t, const std::uint32_t*) {}
  template <std::size_t kGroup>
  SIMDBEZIER_PART void ask() const {}
};

template <detail::OutputSet kOutputs, typename V>
class Ahead<true, kOutputs, V> {
public:
  using T = ScalarOf<V>;

  SIMDBEZIER_PART Ahead(const ScatteredTask<T>& task, std::size_t first, const std::uint32_t* patch)
      : coefficients_(task.coefficients),
        floors_(kOutputs == detail::kAnyOutputs && !(task.common_floor < kInfinity)
                    ? task.normal_floor
                    : nullptr),
        patch_(first + kAhead + kLanes<V> <= task.patches_known ? patch + kAhead : patch) {}

  /// Asks for the lines of kQuads patches. A few at a time: while more lines are under way than
  /// the processor can keep track of, nothing else is done.
  template <std::size_t kGroup>
  SIMDBEZIER_PART void ask() const {
    for (std::size_t i = kGroup * kQuads<V>; i < (kGroup + 1) * kQuads<V>; ++i) {
      const T* const from = coefficients_ + std::size_t{patch_[i]} * detail::kCoefficients;
      for (std::size_t value = 0; value < detail::kCoefficients; value += kLine) {
        if constexpr (kOutputs == detail::kPosition) { // measured: docs/experiments.md
          prefetch_operand(from + value);
        } else {
          prefetch_line(from + value);
        }
      }
      if (floors_ != nullptr) {
        prefetch_line(floors_ + patch_[i]);
      }
    }
  }

private:
  static constexpr std::size_t kAhead = 48;
  static constexpr std::size_t kLine = 64 / sizeof(T);
  static constexpr T kInfinity = static_cast<T>(__builtin_inf());

  const T* coefficients_;
  const T* floors_; ///< null where no block is going to read them
  const std::uint32_t* patch_;
};

/// Runs Horner's rule in X for one group, all components.
template <std::size_t kGroup, detail::OutputSet kOutputs, typename V>
SIMDBEZIER_PART void evaluate_group(const ScalarOf<V>* coefficients, const std::uint32_t* patch,
                                    V all_x, Polynomials<kOutputs, V> q[3]) {
  using T = ScalarOf<V>;
  constexpr std::size_t kParts = kOrder / kQuad<V>; // of a row of powers of Y
  const V x = broadcast_in_groups<kQuad<V>, kGroup>(all_x);
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

template <detail::OutputSet kOutputs, typename V>
SIMDBEZIER_PART void groups_to_powers(Polynomials<kOutputs, V>& q) {
  for (std::size_t derivative = 0; derivative < kPolynomials<kOutputs>; ++derivative) {
    for (std::size_t l = 0; l < kOrder; l += kQuad<V>) {
      lane_transpose(q.power[derivative] + l);
    }
  }
}

/// Normal floors of samples of any patches. To read those of the lanes is one more access to memory
/// each, for values that seldom matter.
template <typename V>
struct FloorsOfMany {
  const ScatteredTask<ScalarOf<V>>& task;
  const std::uint32_t* patch;
  SIMDBEZIER_PART V highest() const { return broadcast<V>(task.common_floor); }
  SIMDBEZIER_PART V each() const { return gather_lanes<V>(task.normal_floor, patch, 1); }
};

/// Evaluates a block of samples of any patches. patch has one index for each lane. kPrefetch says
/// that the lines of later samples are asked for.
template <bool kOrigins, detail::OutputSet kOutputs, bool kPrefetch, typename V>
SIMDBEZIER_PART void evaluate_mixed(const Block<V>& block, const std::uint32_t* patch,
                                    WaitingNormals<kOutputs, V>& waiting) {
  const auto& task = block.task;
  waiting.take_root();
  Polynomials<kOutputs, V> q[3];
  const Ahead<kPrefetch, kOutputs, V> ahead(task, block.first, patch);
  ahead.template ask<0>();
  evaluate_group<0>(task.coefficients, patch, block.x, q);
  ahead.template ask<1>();
  evaluate_group<1>(task.coefficients, patch, block.x, q);
  if constexpr (kQuad<V> == 4) {
    ahead.template ask<2>();
    evaluate_group<2>(task.coefficients, patch, block.x, q);
    ahead.template ask<3>();
    evaluate_group<3>(task.coefficients, patch, block.x, q);
  }
  Tangents<kOutputs, V> tangents;
  for (std::size_t c = 0; c < 3; ++c) {
    groups_to_powers(q[c]);
    V origin = block.x; // not used
    if constexpr (kOrigins) {
      origin = gather_lanes<V>(task.origins + c * detail::kOriginsPerComponent, patch,
                               detail::kOriginBlock);
    }
    finish_component<kOrigins>(block, q[c], c, origin, tangents);
  }
  waiting.store(task);
  finish_block<kOrigins>(block, tangents, FloorsOfMany<V>{task, patch}, waiting);
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
