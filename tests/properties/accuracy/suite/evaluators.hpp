// All evaluators that this build can judge.
#pragma once

#include "tests/properties/accuracy/judge/evaluator.hpp"

namespace simdbezier::tests {

/// This library on every instruction set of the machine, the scalar baselines, and an adapter for
/// each other library that was found when configuring.
template <typename T>
[[nodiscard]] Evaluators<T> all_evaluators();

} // namespace simdbezier::tests
