// An evaluator that was given by --evaluator, as the suite sees it.
#pragma once

#include <memory>

#include <tools/evaluator/evaluator_process.hpp>

#include "tests/properties/accuracy/judge/evaluator.hpp"

namespace simdbezier::tests {

using PluginProcess = std::shared_ptr<tools::EvaluatorProcess>;

/// Adds the evaluator where its file has the function for T.
template <typename T>
void add_plugin(const PluginProcess& process, Evaluators<T>& list);

} // namespace simdbezier::tests
