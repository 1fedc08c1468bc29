// Consecutive samples of one patch: lanes are samples, and coefficients are broadcast.
#pragma once

#include "kernels/scattered/scattered_block.hpp"

namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE {

/// The normal floor of samples of one patch.
template <typename V>
struct FloorOfOne {
  const ScalarOf<V>& floor;
  SIMDBEZIER_PART V highest() const { return broadcast<V>(floor); }
  SIMDBEZIER_PART V each() const { return broadcast<V>(floor); }
};

/// Evaluates blocks of samples of one patch. kRegisters of them share every broadcast: with one of
/// them, loads would be the limit.
template <bool kOrigins, detail::OutputSet kOutputs, std::size_t kRegisters, typename V>
SIMDBEZIER_PART void evaluate_run(const Block<V> block[kRegisters], std::size_t patch,
                                  WaitingNormals<kOutputs, V>& waiting) {
  const auto& task = block[0].task;
  Tangents<kOutputs, V> tangents[kRegisters];
  waiting.take_root();
  Component<ScalarOf<V>> component(task, patch, 0);
  for (std::size_t c = 0; c < 3; ++c, component = component.next()) {
    Polynomials<kOutputs, V> q[kRegisters];
    for (std::size_t l = 0; l < kOrder; ++l) {
      V k[kOrder];
      matrix_column(component, l, k);
      for (std::size_t r = 0; r < kRegisters; ++r) {
        q[r].set(l, k, block[r].x);
      }
    }
    V origin = block[0].x; // not used
    if constexpr (kOrigins) {
      origin = broadcast<V>(component.origin()[0]);
    }
    for (std::size_t r = 0; r < kRegisters; ++r) {
      finish_component<kOrigins>(block[r], q[r], c, origin, tangents[r]);
    }
  }
  waiting.store(task);
  for (std::size_t r = 0; r < kRegisters; ++r) {
    finish_block<kOrigins>(block[r], tangents[r], FloorOfOne<V>{task.normal_floor[patch]}, waiting);
  }
}

} // namespace simdbezier::SIMDBEZIER_ISA_NAMESPACE
